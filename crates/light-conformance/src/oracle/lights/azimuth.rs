use glam::DVec3;

/// The angle around z as a part of a turn, in [0, 1).
pub(super) fn azimuth(v: DVec3) -> f64 {
    (f64::atan2(v.y, v.x) / std::f64::consts::TAU).rem_euclid(1.0)
}
