use lights::glam::Vec3;

/// The reflectance of a smooth boundary for unpolarised light that arrives with
/// cosine `cos_i` (negative from behind), where `eta` is the index of refraction behind the
/// boundary over that in front.
///
/// # Source
/// `[PBRT4]`, section 9.5.1.
#[inline]
#[must_use]
pub(super) fn dielectric(cos_i: f32, eta: f32) -> f32 {
    let (cos_i, eta) = if cos_i < 0.0 {
        (-cos_i, 1.0 / eta)
    } else {
        (cos_i, eta)
    };
    let sin_t_squared = (1.0 - cos_i * cos_i) / (eta * eta);
    if sin_t_squared >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin_t_squared).max(0.0).sqrt();
    let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}

/// The reflectance of a metal for unpolarised light, with refraction index `eta` and absorption
/// `k` per channel.
///
/// # Source
/// `[PBRT4]`, section 9.5.2, in real arithmetic.
#[inline]
#[must_use]
pub(super) fn conductor(cos_i: f32, eta: Vec3, k: Vec3) -> Vec3 {
    let cos_squared = cos_i * cos_i;
    let sin_squared = 1.0 - cos_squared;
    let difference = eta * eta - k * k - sin_squared;
    let sum = (difference * difference + 4.0 * eta * eta * k * k).map(f32::sqrt);
    let a = (0.5 * (sum + difference)).max(Vec3::ZERO).map(f32::sqrt);
    let t1 = sum + cos_squared;
    let t2 = 2.0 * cos_i * a;
    let perpendicular = (t1 - t2) / (t1 + t2);
    let t3 = cos_squared * sum + sin_squared * sin_squared;
    let t4 = t2 * sin_squared;
    let parallel = perpendicular * (t3 - t4) / (t3 + t4);
    0.5 * (parallel + perpendicular)
}

/// Schlick's approximation of a reflectance: `f0` at normal incidence, `f90` at grazing incidence.
///
/// # Source
/// `[GLTF]`, appendix B.
#[inline]
#[must_use]
pub(super) fn schlick(cos_i: f32, f0: Vec3, f90: f32) -> Vec3 {
    let dark = (1.0 - cos_i).max(0.0);
    let squared = dark * dark;
    f0 + (Vec3::splat(f90) - f0) * (squared * squared * dark)
}

/// The direction in which light that arrives from `wi` is refracted by a boundary with normal `n`,
/// and the ratio of the index behind `wi`'s boundary over that in front of it; `None` where all of
/// it is reflected.
///
/// # Source
/// `[PBRT4]`, section 9.3.2.
#[inline]
#[must_use]
pub(super) fn refract(wi: Vec3, n: Vec3, eta: f32) -> Option<(Vec3, f32)> {
    let cos_i = n.dot(wi);
    let (cos_i, eta, n) = if cos_i < 0.0 {
        (-cos_i, 1.0 / eta, -n)
    } else {
        (cos_i, eta, n)
    };
    let sin_t_squared = (1.0 - cos_i * cos_i).max(0.0) / (eta * eta);
    if sin_t_squared >= 1.0 {
        return None;
    }
    let cos_t = (1.0 - sin_t_squared).sqrt();
    Some((-wi / eta + n * (cos_i / eta - cos_t), eta))
}

/// The internal reflectance of a boundary of the given `eta` for diffuse light.
///
/// # Source
/// `[Weidlich2007]`; what leaves is what enters over `eta^2`, as a diffuse field stays diffuse in
/// equilibrium.
#[must_use]
pub(super) fn diffuse_internal_reflectance(eta: f32) -> f32 {
    const STEPS: u8 = 16;
    // The integral over the cosine, from outside, where there is no kink.
    let steps = (0..STEPS).map(|i| (f32::from(i) + 0.5) / f32::from(STEPS));
    let weighted = steps.map(|cos| 2.0 * cos * dielectric(cos, eta));
    let outside = weighted.sum::<f32>() / f32::from(STEPS);
    1.0 - (1.0 - outside) / (eta * eta)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glass_reflects_four_percent_head_on_and_all_at_the_edge() {
        assert!(
            (dielectric(1.0, 1.5) - 0.04).abs() < 1e-6,
            "((1.5 - 1) / (1.5 + 1))^2"
        );
        assert!(
            (dielectric(-1.0, 1.5) - 0.04).abs() < 1e-6,
            "from behind alike"
        );
        assert!(dielectric(1e-4, 1.5) > 0.99, "grazing");
        assert_eq!(dielectric(-0.5, 1.5), 1.0, "total internal reflection");
        assert!(dielectric(0.3, 1.0) < 1e-9, "no boundary at all");
    }

    #[test]
    fn a_metal_without_absorption_is_glass() {
        for cos in [0.1, 0.5, 0.9] {
            let metal = conductor(cos, Vec3::splat(1.5), Vec3::ZERO);
            assert!(
                (metal.x - dielectric(cos, 1.5)).abs() < 1e-5,
                "at cosine {cos}"
            );
        }
        let gold = conductor(
            1.0,
            Vec3::new(0.143, 0.375, 1.442),
            Vec3::new(3.983, 2.386, 1.603),
        );
        assert!(gold.x > 0.9 && gold.z < 0.5, "gold is yellow: {gold}");
    }

    #[test]
    fn refraction_obeys_snell_both_ways() {
        let wi = Vec3::new(0.6, 0.0, 0.8);
        let (wt, eta) = refract(wi, Vec3::Z, 1.5).expect("refracted");
        assert!(
            (wt.x + 0.4).abs() < 1e-6 && wt.z < 0.0,
            "sine over 1.5: {wt}"
        );
        assert_eq!(eta, 1.5, "into the glass");
        let (back, eta) = refract(wt, Vec3::Z, 1.5).expect("refracted");
        assert!(back.distance(wi) < 1e-6, "the same way back");
        assert!((eta - 1.0 / 1.5).abs() < 1e-6, "out of the glass");
        assert_eq!(
            refract(Vec3::new(0.9, 0.0, -0.435_889_9), Vec3::Z, 1.5),
            None,
            "total"
        );
    }

    #[test]
    fn diffuse_light_stays_inside_as_the_literature_says() {
        let kept = diffuse_internal_reflectance(1.5);
        assert!((kept - 0.596).abs() < 2e-3, "{kept} for glass");
    }
}
