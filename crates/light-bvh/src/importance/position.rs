use light_math::glam::Vec3;

/// Coordinates are clamped to this on either side, so that no difference of two overflows.
pub(crate) const FAR: f32 = 1e36;

/// Whether `p` is beyond ±1e36 on any axis. Queries clamp such a point, and directions from it mean
/// nothing.
#[inline(always)]
pub(crate) fn is_far(p: Vec3) -> bool {
    near(p) != p
}

#[cfg_attr(target_os = "none", inline(never))]
#[cfg_attr(not(target_os = "none"), inline(always))]
pub(crate) fn near(p: Vec3) -> Vec3 {
    p.clamp(Vec3::splat(-FAR), Vec3::splat(FAR))
}
