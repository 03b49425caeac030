use core::f32::consts::{PI, TAU};

use crate::color::ColorModel;
use crate::glam::{Vec2, Vec3};
use crate::light_power::LightPower;
use crate::medium_interface::MediumInterface;
use crate::point_source::{DirectionSample, PointSource};
use crate::rigid_transform::RigidTransform;
use crate::scaled_emission::ScaledEmission;
use crate::spot_desc::{SpotLightDesc, SpotLightError};
use light_bounds::LightBounds;
use light_math::Aabb;
use light_math::float::{cos, one_minus_rounded_down, safe_sqrt, sin, sin_cos};
use light_math::warp::{smoothstep, uniform_cone};

/// A point light that emits into a cone with a smooth rim.
///
/// The intensity is that of the description up to the angle of the falloff's start, 0 from the rim
/// on, and in between a smooth step in the cosine of the angle.
///
/// # Source
/// `[PBRT4]`, section 12.2.1. Cosines are held as their distance from 1, so that narrow cones keep
/// their digits.
#[derive(Clone, Debug)]
pub struct SpotLight<C: ColorModel> {
    transform: RigidTransform,
    /// 1 minus the cosine of the angle where the falloff starts.
    start: f32,
    /// 1 minus the cosine of the angle of the rim.
    end: f32,
    cos_theta_o: f32,
    cos_theta_e: f32,
    intensity: ScaledEmission<C>,
    media: MediumInterface,
}

impl<C: ColorModel> SpotLight<C> {
    /// The light that `desc` describes.
    ///
    /// # Errors
    /// When a field of `desc` is invalid.
    pub fn new(desc: SpotLightDesc<C>) -> Result<Self, SpotLightError> {
        let transform = RigidTransform::new(desc.transform)?;
        let end = one_minus_cos(desc.angle);
        let has_density = (1.0 / solid_angle(0.0, end)).is_finite();
        if !(has_density && desc.angle > 0.0 && desc.angle <= PI) {
            return Err(SpotLightError::Angle);
        }
        if !(desc.falloff_start >= 0.0 && desc.falloff_start <= desc.angle) {
            return Err(SpotLightError::FalloffStart);
        }
        let start = one_minus_cos(desc.falloff_start);
        let intensity = C::flux(&desc.emission);
        let power = intensity * solid_angle(start, end);
        let scale = desc.amount.scale(intensity, power)?;
        Ok(Self {
            transform,
            start,
            end,
            cos_theta_o: cos_rounded_down(desc.falloff_start),
            cos_theta_e: cos_rounded_down(desc.angle - desc.falloff_start),
            // The bounds are those of an isotropic light.
            intensity: ScaledEmission::new(desc.emission, scale)?.with_solid_angle(4.0 * PI)?,
            media: desc.media,
        })
    }

    /// From light space to the scene: the light emits along +z.
    #[must_use]
    pub const fn transform(&self) -> &RigidTransform {
        &self.transform
    }

    /// 1 minus the cosine of the angle where the falloff starts, and of that of the rim.
    #[must_use]
    pub const fn one_minus_cosines(&self) -> [f32; 2] {
        [self.start, self.end]
    }

    /// The relative intensity in the direction `w` away from the light, in `[0, 1]`.
    fn falloff(&self, w: Vec3) -> f32 {
        let w = self.transform.inverse_vector(w);
        // 1 - z cancels near the axis.
        let x = if w.z > 0.0 {
            (w.x * w.x + w.y * w.y) / (1.0 + w.z)
        } else {
            1.0 - w.z
        };
        if x <= self.start {
            1.0
        } else if x >= self.end {
            0.0
        } else {
            let t = (self.end - x) / (self.end - self.start);
            t * t * (3.0 - 2.0 * t)
        }
    }

    /// The solid angle that has the same power at full intensity.
    fn solid_angle(&self) -> f32 {
        solid_angle(self.start, self.end)
    }
}

impl<C: ColorModel> SpotLight<C> {
    pub(crate) fn light_power(&self) -> LightPower<'_, C> {
        LightPower::of_emission(&self.intensity, self.solid_angle())
    }
}

impl<C: ColorModel> PointSource for SpotLight<C> {
    type Color = C;

    fn position(&self) -> Vec3 {
        self.transform.origin()
    }

    fn intensity(&self, w: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.intensity.at(wavelengths) * self.falloff(w)
    }

    fn power(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        self.light_power().at(wavelengths)
    }

    /// In proportion to the intensity, so that each ray carries the same power: `u2.x` chooses
    /// between the core and the falloff, `u1` the direction in it.
    fn sample_direction(
        &self,
        u1: Vec2,
        u2: Vec2,
        wavelengths: &C::Wavelengths,
    ) -> Option<DirectionSample<C::Radiance>> {
        let band = self.end - self.start;
        let core_share = self.start / (self.start + 0.5 * band);
        let w = if u2.x < core_share {
            uniform_cone::sample(u1, self.start)
        } else {
            let x = self.end - band * smoothstep::sample(u1.x, 0.0, 1.0);
            let sin_theta = safe_sqrt(x * (2.0 - x));
            let (sin_phi, cos_phi) = sin_cos(TAU * u1.y);
            Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, 1.0 - x)
        };
        let w = self.transform.vector(w);
        let falloff = self.falloff(w);
        (falloff > 0.0).then(|| DirectionSample {
            w,
            intensity: self.intensity.at(wavelengths) * falloff,
            pdf: falloff / self.solid_angle(),
        })
    }

    fn direction_pdf(&self, w: Vec3) -> f32 {
        self.falloff(w) / self.solid_angle()
    }

    /// The power is that of an isotropic light: of two spots that light a point equally, the wide
    /// one must not be chosen more often.
    fn point_bounds(&self) -> LightBounds {
        LightBounds {
            bounds: Aabb::from_point(self.transform.origin()),
            w: self.transform.axis(),
            phi: 4.0 * PI * self.intensity.maximum(),
            cos_theta_o: self.cos_theta_o,
            cos_theta_e: self.cos_theta_e,
            two_sided: false,
        }
    }

    fn surroundings(&self) -> MediumInterface {
        self.media
    }
}

/// The solid angle that has the same power as a spot at full intensity, from 1 minus the cosines.
fn solid_angle(start: f32, end: f32) -> f32 {
    PI * (start + end)
}

fn one_minus_cos(angle: f32) -> f32 {
    let half = sin(0.5 * angle);
    2.0 * half * half
}

/// The cosine, rounded down for narrow angles: a cosine rounded up would exclude a part of the
/// cone.
fn cos_rounded_down(angle: f32) -> f32 {
    const NARROW: f32 = 1e-3;
    if angle < NARROW {
        one_minus_rounded_down(one_minus_cos(angle))
    } else {
        cos(angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amount::IntensityAmount;
    use crate::glam::Affine3A;
    use crate::light::Light;
    use crate::rgb::Rgb;
    use crate::scaled_emission::EmissionError;
    use light_bounds::{LightExtent, LightSampleContext};

    fn spot(angle: f32, falloff_start: f32) -> Result<SpotLight<Rgb>, SpotLightError> {
        SpotLight::new(SpotLightDesc {
            transform: Affine3A::IDENTITY,
            angle,
            falloff_start,
            emission: Vec3::ONE,
            amount: IntensityAmount::Radiometric(2.0),
            media: MediumInterface::default(),
        })
    }

    #[test]
    fn refuses_nonsense_by_field() {
        assert_eq!(
            spot(0.3, 0.4).err(),
            Some(SpotLightError::FalloffStart),
            "reversed"
        );
        for angle in [0.0, -1.0, 4.0, f32::NAN] {
            assert_eq!(
                spot(angle, 0.0).err(),
                Some(SpotLightError::Angle),
                "{angle}"
            );
        }
        assert!(spot(0.3, 0.3).is_ok(), "a hard rim");
        let bright = |intensity| {
            let amount = IntensityAmount::Radiometric(intensity);
            let desc = SpotLightDesc::<Rgb>::new(Affine3A::IDENTITY, 1e-3, Vec3::ONE, amount);
            SpotLight::new(desc).err()
        };
        let expected = SpotLightError::Emission(EmissionError::Power);
        assert_eq!(bright(1e38), Some(expected), "samplers refuse its bounds");
        assert_eq!(bright(2e37), None, "2.5e38 W");
    }

    #[test]
    fn every_ray_carries_the_same_power() -> Result<(), SpotLightError> {
        for (angle, start) in [(1e-3, 5e-4), (0.5, 0.0), (0.5, 0.5), (3.0, 1.0)] {
            let spot = spot(angle, start)?;
            let phi = spot.phi(&()).x;
            let mut rays = 0;
            for i in 0..64u8 {
                let u = Vec2::new(f32::from(i) / 64.0, f32::from(i % 8) / 8.0);
                let Some(sample) = spot.sample_le(u, Vec2::new(u.y, 0.0), &()) else {
                    continue;
                };
                rays += 1;
                let power = sample.l.x / (sample.pdf.pos * sample.pdf.dir);
                assert!(
                    (power / phi - 1.0).abs() < 1e-6,
                    "{angle} {start}: {power}, {phi}"
                );
            }
            assert!(rays >= 60, "{angle} {start}: {rays} rays of 64");
        }
        Ok(())
    }

    #[test]
    fn narrow_cones_keep_their_digits() -> Result<(), SpotLightError> {
        // pi I theta^2 / 2 for the core alone of a cone of 1e-4 that falls off at once.
        let phi = spot(1e-4, 0.0)?.phi(&()).x;
        assert!((phi / (PI * 2.0 * 0.5e-8) - 1.0).abs() < 1e-6, "{phi}");
        Ok(())
    }

    /// The bounds of spots as narrow as cosines cannot resolve hold every direction in which they
    /// shine.
    #[test]
    fn the_bounds_of_narrow_cones_hold_them() -> Result<(), SpotLightError> {
        let angle = |cos_theta: f32| (2.0 * (1.0 - f64::from(cos_theta))).sqrt();
        for i in 0..400u16 {
            let rim = 1e-7 * 1.03f32.powi(i32::from(i));
            for start in [0.0, 0.3 * rim, rim] {
                let spot = spot(rim, start)?;
                let LightExtent::Bounded(bounds) = spot.extent() else {
                    panic!("a spot has bounds");
                };
                let held = angle(bounds.cos_theta_o) + angle(bounds.cos_theta_e);
                let is_narrow = rim < 1e-3;
                assert!(
                    !is_narrow || held >= f64::from(rim) * (1.0 - 1e-6),
                    "{start} {rim}: {held}"
                );
                for u in (0..32u8).map(|i| Vec2::new(f32::from(i) / 32.0, f32::from(i % 8) / 8.0)) {
                    let Some(ray) = spot.sample_le(u, Vec2::new(u.y, 0.0), &()) else {
                        continue;
                    };
                    let ctx = LightSampleContext::medium(ray.ray.direction * 3.0);
                    let importance = bounds.importance(&ctx);
                    assert!(importance > 0.0, "{start} {rim}: {:?}", ray.ray);
                }
            }
        }
        Ok(())
    }
}
