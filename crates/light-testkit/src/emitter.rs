use core::f32::consts::TAU;
use core::f64::consts::PI;

use light_bounds::{EmissionLobe, InfiniteBounds, LightBounds, LightExtent};
use light_math::{Aabb, glam::Vec3};
use light_sets::SetLight;

/// A light whose exact contribution is a line of code: the ground truth for samplers.
#[derive(Clone, Copy, Debug)]
pub enum Emitter {
    /// A triangle, point or spot as measured light sets hold them.
    Set(SetLight),
    /// A point with a beam and a little stray light all around, known by its lobe.
    Lantern {
        /// Position.
        position: Vec3,
        /// Axis of the beam, a unit vector.
        axis: Vec3,
        /// Radiant intensity of the beam, in W·sr⁻¹.
        beam: f32,
        /// Radiant intensity elsewhere, in W·sr⁻¹.
        stray: f32,
        /// Cosine of the beam's half angle.
        cos_beam: f32,
    },
    /// The same radiance from everywhere.
    Sky {
        /// Radiance, in W·m⁻²·sr⁻¹.
        radiance: f32,
    },
    /// Light from a single direction.
    Sun {
        /// The unit vector toward it.
        wi: Vec3,
        /// Irradiance on a plane that faces it, in W·m⁻².
        irradiance: f32,
    },
}

impl Emitter {
    /// Cosines below this count as zero: bounds in `f32` cannot distinguish them.
    pub const GRAZING: f64 = 1e-5;

    /// The extent for samplers.
    #[must_use]
    pub fn extent(&self) -> LightExtent {
        match *self {
            Self::Set(light) => LightExtent::Bounded(light.bounds()),
            Self::Lantern {
                position,
                axis,
                beam,
                stray,
                cos_beam: c,
            } => {
                let power = TAU * ((1.0 - c) * beam + (1.0 + c) * stray);
                let along = 0.5 * TAU * (1.0 - c * c) * (beam - stray);
                let lobe = EmissionLobe {
                    power,
                    mean: axis * (along / power.max(f32::MIN_POSITIVE)),
                    // Nearly 0: the pmf of the stray light must not come from the spread.
                    spread: 1e-3,
                };
                let bounds = LightBounds {
                    bounds: Aabb::from_point(position),
                    w: Vec3::Z,
                    phi: power,
                    cos_theta_o: -1.0,
                    cos_theta_e: 0.0,
                    two_sided: false,
                };
                LightExtent::Lobe(bounds, lobe)
            }
            Self::Sky { radiance } => LightExtent::Infinite(InfiniteBounds::uniform(radiance)),
            Self::Sun { wi, irradiance } => {
                LightExtent::Infinite(InfiniteBounds::distant(irradiance, wi))
            }
        }
    }

    /// Emitted power in W; of a light at infinity the power that passes a disk of radius one.
    #[must_use]
    pub fn power(&self) -> f32 {
        match (self.extent(), self) {
            (LightExtent::Infinite(bounds), _) => PI as f32 * bounds.fluence,
            (LightExtent::Lobe(_, lobe), _) => lobe.power,
            (
                LightExtent::Bounded(bounds),
                Self::Set(SetLight::Triangle {
                    two_sided: true, ..
                }),
            ) => 2.0 * bounds.phi,
            (LightExtent::Bounded(bounds), _) => bounds.phi,
        }
    }
}
