use super::phase_function::PhaseFunction;
use core::f32::consts::PI;
use light_math::float;

/// Scattering by droplets of thin haze: `(1/2 + 9/2 ((1 + cos)/2)^8) / (4 pi)`.
///
/// # Source
/// `[Nishita1987]`, after a fit to Mie's theory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MieHazy;

/// Scattering by droplets of dense haze: `(1/2 + 33/2 ((1 + cos)/2)^32) / (4 pi)`.
///
/// # Source
/// `[Nishita1987]`, after a fit to Mie's theory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MieMurky;

impl PhaseFunction for MieHazy {
    #[inline]
    fn value(&self, cos_theta: f32) -> f32 {
        lobe(squared_times(cos_theta, 3), 8.0)
    }

    #[inline]
    fn sample_cos(&self, u: f32) -> f32 {
        sample_lobe(u, 8.0)
    }
}

impl PhaseFunction for MieMurky {
    #[inline]
    fn value(&self, cos_theta: f32) -> f32 {
        lobe(squared_times(cos_theta, 5), 32.0)
    }

    #[inline]
    fn sample_cos(&self, u: f32) -> f32 {
        sample_lobe(u, 32.0)
    }
}

/// `(1 + cos)/2` to the power `2^times`.
fn squared_times(cos_theta: f32, times: u32) -> f32 {
    (0..times).fold(0.5 + 0.5 * cos_theta, |x, _| x * x)
}

/// Half isotropic, half the forward peak `(n + 1) ((1 + cos)/2)^n`; both halves are normalised.
fn lobe(peak: f32, exponent: f32) -> f32 {
    (0.5 + 0.5 * (exponent + 1.0) * peak) / (4.0 * PI)
}

/// Chooses one of the two halves by `u`, then inverts it.
fn sample_lobe(u: f32, exponent: f32) -> f32 {
    if u < 0.5 {
        1.0 - 4.0 * u
    } else {
        2.0 * float::powf(2.0 * u - 1.0, 1.0 / (exponent + 1.0)) - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_of_the_mixture_follow_the_value() {
        for (f, n) in [(&MieHazy as &dyn PhaseFunction, 8.0), (&MieMurky, 32.0)] {
            let mut below = 0;
            let samples = 100_000;
            for i in 0..samples {
                let cos_theta = f.sample_cos((i as f32 + 0.5) / samples as f32);
                assert!((-1.0..=1.0).contains(&cos_theta), "a cosine");
                below += i32::from(cos_theta < 0.5);
            }
            // Closed form of the mass below cos = 1/2.
            let expected = 0.5 * 0.75 + 0.5 * float::powf(0.75, n + 1.0);
            let share = below as f32 / samples as f32;
            assert!(
                (share - expected).abs() < 1e-4,
                "{share} against {expected}"
            );
        }
    }
}
