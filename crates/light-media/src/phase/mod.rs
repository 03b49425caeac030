//! Phase functions: the distribution of scattered directions.

mod asymmetry;
mod deflection;
mod henyey_greenstein;
mod isotropic;
mod mie;
mod phase_function;
mod rayleigh;
mod schlick;

pub use asymmetry::AsymmetryError;
pub use deflection::Deflection;
pub use henyey_greenstein::HenyeyGreenstein;
pub use isotropic::Isotropic;
pub use mie::{MieHazy, MieMurky};
pub use phase_function::{PhaseFunction, PhaseSample};
pub use rayleigh::Rayleigh;
pub use schlick::Schlick;

use core::f32::consts::TAU;
use light_math::glam::{Vec2, Vec3};
use light_math::{Frame, float};

/// The phase functions of this crate as one enum.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Phase {
    /// The same in all directions.
    Isotropic(Isotropic),
    /// Scattering by molecules.
    Rayleigh(Rayleigh),
    /// The usual choice, with one asymmetry parameter.
    HenyeyGreenstein(HenyeyGreenstein),
    /// A rational approximation of Henyey-Greenstein.
    Schlick(Schlick),
    /// Small droplets, thin haze.
    MieHazy(MieHazy),
    /// Small droplets, dense haze.
    MieMurky(MieMurky),
}

impl Default for Phase {
    /// Isotropic.
    fn default() -> Self {
        Self::Isotropic(Isotropic)
    }
}

impl Phase {
    /// Samples a direction: `wo` points back along the path that arrived, the result points onward.
    /// `u` in `[0, 1)^2`.
    #[must_use]
    pub fn sample(&self, wo: Vec3, u: Vec2) -> PhaseSample {
        let deflection = self.sample_deflection(u.x);
        let Deflection {
            cos_theta,
            sin_theta,
        } = deflection;
        let (sin_phi, cos_phi) = float::sin_cos(TAU * u.y);
        let local = Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta);
        PhaseSample {
            wi: Frame::from_z(-wo).from_local(local),
            pdf: self.value_at(deflection),
        }
    }

    /// The value, and density, for a pair of unit directions that both point away from the event.
    #[must_use]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.value_at(Deflection::between(wo, wi))
    }
}

impl PhaseFunction for Phase {
    fn value(&self, cos_theta: f32) -> f32 {
        match self {
            Self::Isotropic(f) => f.value(cos_theta),
            Self::Rayleigh(f) => f.value(cos_theta),
            Self::HenyeyGreenstein(f) => f.value(cos_theta),
            Self::Schlick(f) => f.value(cos_theta),
            Self::MieHazy(f) => f.value(cos_theta),
            Self::MieMurky(f) => f.value(cos_theta),
        }
    }

    fn sample_cos(&self, u: f32) -> f32 {
        match self {
            Self::Isotropic(f) => f.sample_cos(u),
            Self::Rayleigh(f) => f.sample_cos(u),
            Self::HenyeyGreenstein(f) => f.sample_cos(u),
            Self::Schlick(f) => f.sample_cos(u),
            Self::MieHazy(f) => f.sample_cos(u),
            Self::MieMurky(f) => f.sample_cos(u),
        }
    }

    fn value_at(&self, deflection: Deflection) -> f32 {
        match self {
            Self::HenyeyGreenstein(f) => f.value_at(deflection),
            Self::Schlick(f) => f.value_at(deflection),
            other => other.value(deflection.cos_theta),
        }
    }

    fn sample_deflection(&self, u: f32) -> Deflection {
        match self {
            Self::HenyeyGreenstein(f) => f.sample_deflection(u),
            Self::Schlick(f) => f.sample_deflection(u),
            other => Deflection::from_cos(other.sample_cos(u)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kolmogorov and Smirnov's test of the angles to a peak, straight on where `k` is positive and
    /// as wide as `1 - |k|`, and the densities of the directions. `below` is the share of the
    /// cosines that are less than that of the peak by at most its argument.
    pub(super) fn check_peak(phase: Phase, k: f32, below: impl Fn(f64) -> f64) {
        let mut rng = light_testkit::Rng::new(3);
        let wo: Vec3 = rng.direction();
        let peak = -wo.as_dvec3().normalize() * f64::from(k.signum());
        let n = 20_000;
        let mut shares = alloc::vec::Vec::new();
        for _ in 0..n {
            let sample = phase.sample(wo, Vec2::new(rng.f32(), rng.f32()));
            let chord = sample.wi.as_dvec3().normalize() - peak;
            shares.push(below(0.5 * chord.length_squared()));
            let queried = phase.pdf(wo, sample.wi);
            // A direction is rounded by 1e-7.
            let margin = 1e-5 + 3e-7 / (1.0 - f64::from(k).abs());
            let error = f64::from(queried / sample.pdf - 1.0).abs();
            assert!(error < margin, "{k}: {queried}, {}", sample.pdf);
        }
        shares.sort_by(f64::total_cmp);
        let distance = (0..n).map(|i| (shares[i] - (i as f64 + 0.5) / n as f64).abs());
        // Chance alone exceeds it once in a million.
        let limit = 2.7 / (n as f64).sqrt();
        let distance = distance.fold(0.0, f64::max);
        assert!(distance < limit, "{k}: {distance}, above {limit}");
    }

    fn all() -> [Phase; 10] {
        let hg = |g| Phase::HenyeyGreenstein(HenyeyGreenstein::new(g).expect("in range"));
        let schlick = |g| Phase::Schlick(Schlick::from_asymmetry(g).expect("in range"));
        [
            Phase::Isotropic(Isotropic),
            Phase::Rayleigh(Rayleigh),
            Phase::MieHazy(MieHazy),
            Phase::MieMurky(MieMurky),
            hg(0.0),
            hg(0.85),
            hg(-0.5),
            hg(1e-4),
            schlick(0.7),
            schlick(-0.9),
        ]
    }

    /// `TAU` times the integral of the phase function from -1 to `to`, by the midpoint rule.
    fn cumulative(f: &Phase, to: f64) -> f64 {
        let n = 20_000;
        let h = (to + 1.0) / f64::from(n);
        (0..n)
            .map(|i| f64::from(f.value((-1.0 + (f64::from(i) + 0.5) * h) as f32)))
            .sum::<f64>()
            * h
            * core::f64::consts::TAU
    }

    #[test]
    fn every_phase_function_integrates_to_one() {
        for f in all() {
            let total = cumulative(&f, 1.0);
            assert!((total - 1.0).abs() < 2e-4, "{f:?} integrates to {total}");
        }
    }

    #[test]
    fn samples_follow_the_value() {
        // Sampling is by inversion: the mass between the ends of any range of u is the range's
        // length.
        for f in all() {
            let marks: [f32; 5] = [0.0, 0.1, 0.37, 0.9, float::ONE_MINUS_EPSILON];
            if matches!(f, Phase::MieHazy(_) | Phase::MieMurky(_)) {
                continue; // sampled as a mixture: checked in its own file
            }
            let masses = marks.map(|u| cumulative(&f, f64::from(f.sample_cos(u))));
            for i in 1..marks.len() {
                let mass = (masses[i] - masses[i - 1]).abs();
                let expected = f64::from(marks[i] - marks[i - 1]);
                assert!(
                    (mass - expected).abs() < 1e-3,
                    "{f:?} between u {} and {}: {mass}",
                    marks[i - 1],
                    marks[i]
                );
            }
        }
    }

    #[test]
    fn directions_are_unit_and_carry_their_density() {
        let wo = Vec3::new(0.48, -0.6, 0.64);
        for f in all() {
            for u in [
                Vec2::ZERO,
                Vec2::new(0.3, 0.8),
                Vec2::splat(float::ONE_MINUS_EPSILON),
            ] {
                let s = f.sample(wo, u);
                assert!((s.wi.length() - 1.0).abs() < 1e-5, "{f:?}: unit");
                let queried = f.pdf(wo, s.wi);
                assert!(
                    s.pdf > 0.0 && (s.pdf - queried).abs() <= 1e-3 * s.pdf,
                    "{f:?}: {} against {queried}",
                    s.pdf
                );
            }
        }
    }

    #[test]
    fn samples_pass_chi_squared_over_the_sphere() {
        let wo = Vec3::new(0.48, -0.6, 0.64);
        for f in all() {
            let outcome = light_testkit::DensityTest::default()
                .sphere(|rng| Some(f.sample(wo, rng.vec2()).wi), |wi| f.pdf(wo, wi));
            assert_eq!(outcome.fault(), None, "{f:?}: {outcome:?}");
        }
    }
}
