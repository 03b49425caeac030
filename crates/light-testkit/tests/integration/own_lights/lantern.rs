use alloc::sync::Arc;

use light_bounds::{EmissionLobe, LightBounds, LightExtent};
use light_math::Frame;
use light_math::glam::{Vec2, Vec3};
use light_math::warp::uniform_cone;
use light_sources::*;
use light_testkit::Emitter;

/// A beam and a little stray light all around: the own light of [`Emitter::Lantern`].
pub(crate) struct Lantern {
    position: Vec3,
    axis: Vec3,
    beam: f32,
    stray: f32,
    cos_beam: f32,
    extent: (LightBounds, EmissionLobe),
}

impl Lantern {
    /// The light of a [`Emitter::Lantern`]; `None` for another emitter.
    pub(crate) fn own(emitter: &Emitter) -> Option<OwnLight<Rgb>> {
        let (
            &Emitter::Lantern {
                position,
                axis,
                beam,
                stray,
                cos_beam,
            },
            LightExtent::Lobe(bounds, lobe),
        ) = (emitter, emitter.extent())
        else {
            return None;
        };
        Some(OwnLight::Delta(Arc::new(Self {
            position,
            axis,
            beam,
            stray,
            cos_beam,
            extent: (bounds, lobe),
        })))
    }

    fn is_in_beam(&self, w: Vec3) -> bool {
        w.dot(self.axis) > self.cos_beam
    }

    /// The share of its power that the beam has.
    fn beam_share(&self) -> f32 {
        let [beam, stray] = [
            (1.0 - self.cos_beam) * self.beam,
            (1.0 + self.cos_beam) * self.stray,
        ];
        beam / (beam + stray)
    }
}

impl PointSource for Lantern {
    type Color = Rgb;

    fn position(&self) -> Vec3 {
        self.position
    }

    fn intensity(&self, w: Vec3, (): &()) -> Vec3 {
        Vec3::splat(if self.is_in_beam(w) {
            self.beam
        } else {
            self.stray
        })
    }

    fn power(&self, (): &()) -> Vec3 {
        Vec3::splat(self.extent.1.power)
    }

    fn sample_direction(&self, u1: Vec2, u2: Vec2, (): &()) -> Option<DirectionSample<Vec3>> {
        let (axis, one_minus_cos) = if u2.x < self.beam_share() {
            (self.axis, 1.0 - self.cos_beam)
        } else {
            (-self.axis, 1.0 + self.cos_beam)
        };
        let w = Frame::from_z(axis).from_local(uniform_cone::sample(u1, one_minus_cos));
        let pdf = self.direction_pdf(w);
        let intensity = self.intensity(w, &());
        Some(DirectionSample { w, intensity, pdf })
    }

    fn direction_pdf(&self, w: Vec3) -> f32 {
        if self.is_in_beam(w) {
            self.beam_share() * uniform_cone::pdf(1.0 - self.cos_beam)
        } else {
            (1.0 - self.beam_share()) * uniform_cone::pdf(1.0 + self.cos_beam)
        }
    }

    fn point_bounds(&self) -> LightBounds {
        self.extent.0
    }

    fn lobe(&self) -> Option<EmissionLobe> {
        Some(self.extent.1)
    }

    fn surroundings(&self) -> MediumInterface {
        MediumInterface::default()
    }
}
