use core::f32::consts::TAU;
use core::f64::consts::PI;

use light_bounds::{EmissionLobe, InfiniteBounds, LightBounds, LightExtent};
use light_math::{Aabb, glam::Vec3};

use crate::real3::{Real3, cross, length, normalize, real3, sub, vec3};

/// A light whose exact contribution is a line of code: the ground truth for samplers.
#[derive(Clone, Copy, Debug)]
pub enum Emitter {
    /// A triangle that emits `radiance` on its counter-clockwise side, or on both.
    Triangle {
        /// The corners.
        corners: [Vec3; 3],
        /// Radiance, in W·m⁻²·sr⁻¹.
        radiance: f32,
        /// Whether the clockwise side emits too.
        two_sided: bool,
    },
    /// An isotropic point light of `intensity`.
    Point {
        /// Position.
        position: Vec3,
        /// Radiant intensity, in W·sr⁻¹.
        intensity: f32,
    },
    /// A spot light with a smooth falloff between two cones.
    Spot {
        /// Position.
        position: Vec3,
        /// Axis, a unit vector.
        axis: Vec3,
        /// Radiant intensity inside of the inner cone, in W·sr⁻¹.
        intensity: f32,
        /// Cosine of the inner cone's half angle.
        cos_start: f32,
        /// Cosine of the outer cone's half angle, at most `cos_start`.
        cos_end: f32,
    },
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
        let point = |position, w, intensity, cos_theta_o, cos_theta_e| {
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_point(position),
                w,
                phi: (4.0 * PI) as f32 * intensity,
                cos_theta_o,
                cos_theta_e,
                two_sided: false,
            })
        };
        match *self {
            Self::Triangle {
                corners,
                radiance,
                two_sided,
            } => LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_points(corners),
                w: vec3(self.normal()).normalize_or(Vec3::Z),
                phi: (PI * self.area() * f64::from(radiance)) as f32,
                cos_theta_o: 1.0,
                cos_theta_e: 0.0,
                two_sided,
            }),
            Self::Point {
                position,
                intensity,
            } => point(position, Vec3::Z, intensity, -1.0, 0.0),
            Self::Spot {
                position,
                axis,
                intensity,
                cos_start,
                cos_end,
            } => {
                let band = f64::from(cos_end).acos() - f64::from(cos_start).acos();
                point(position, axis, intensity, cos_start, band.cos() as f32)
            }
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
                    // Next to nothing: the stray light must not depend on it.
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
                Self::Triangle {
                    two_sided: true, ..
                },
            ) => 2.0 * bounds.phi,
            (LightExtent::Bounded(bounds), _) => bounds.phi,
        }
    }

    /// The unit normal of a triangle; zero for one without area and for other lights.
    pub(crate) fn normal(&self) -> Real3 {
        normalize(self.doubled_area())
    }

    pub(crate) fn area(&self) -> f64 {
        0.5 * length(self.doubled_area())
    }

    fn doubled_area(&self) -> Real3 {
        match *self {
            Self::Triangle { corners, .. } => {
                let [a, b, c] = corners.map(real3);
                cross(sub(b, a), sub(c, a))
            }
            _ => [0.0; 3],
        }
    }
}
