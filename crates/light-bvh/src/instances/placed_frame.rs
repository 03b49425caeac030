use light_math::glam::{Mat3, Quat, Vec3};

use crate::importance::context_receiver::ContextReceiver;
use crate::importance::frame::Frame;
use crate::instances::placed_receiver::PlacedReceiver;
use crate::instances::placement::{Placement, RIGID_TOLERANCE};
use crate::instances::prototype::LightPrototype;

/// Round-off of coordinates: of a light that is placed, and of a receiver that is moved into the
/// frame of a prototype, as a share of the coordinates.
const ROUND_OFF: f32 = 1e-6;

/// Where a prototype is placed, as queries need it: 48 bytes, on two cache lines at most.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
pub(crate) struct PlacedFrame {
    rotation: Quat,
    /// Where the middle of the prototype's lights is placed.
    pub(crate) center: Vec3,
    /// One over the scale; negative if the prototype is mirrored.
    inv_scale: f32,
    pub(crate) prototype: u32,
    /// Which placement it is.
    pub(crate) placement: u32,
    /// How far placed lights may be from where they are computed to be, in lengths of the
    /// prototype.
    error: f32,
}

const _: () = assert!(size_of::<PlacedFrame>() == 48, "as documented");

impl PlacedFrame {
    pub(crate) fn new(index: u32, placement: &Placement, prototype: &LightPrototype) -> Self {
        let &Placement {
            rotation,
            scale,
            translation,
            ..
        } = placement;
        let inside = prototype.center;
        let center = translation + rotation * (inside * scale);
        let inv_scale = 1.0 / scale;
        let coordinates = (norm(center) + norm(translation)) * inv_scale.abs();
        Self {
            rotation,
            center,
            inv_scale,
            prototype: placement.prototype,
            placement: index,
            error: error(coordinates, size(prototype)),
        }
    }

    /// The axes of the prototype, as they are placed: unit vectors.
    pub(crate) fn axes(&self) -> Mat3 {
        Mat3::from_quat(self.rotation)
    }

    /// The factor of lengths; negative if the prototype is mirrored.
    pub(crate) fn scale(&self) -> f32 {
        1.0 / self.inv_scale
    }

    /// How far the lights of `placement`, which this is the frame of, may be from where they are
    /// computed to be. Where lengths of the prototype overflow, those of the scene need not.
    pub(crate) fn error(&self, placement: &Placement, prototype: &LightPrototype) -> f32 {
        let coordinates = norm(self.center) + norm(placement.translation);
        error(coordinates, size(prototype) * placement.scale.abs())
    }

    /// A receiver in the frame of the prototype.
    #[inline(always)]
    pub(crate) fn receiver(
        &self,
        receiver: &ContextReceiver,
        prototype: &LightPrototype,
    ) -> PlacedReceiver {
        let inside = prototype.center;
        let frame = Frame::new(self.rotation, self.inv_scale, self.center, inside);
        let receiver = receiver.in_frame(&frame);
        let away = norm(receiver.position() - inside);
        let error = self.error + (RIGID_TOLERANCE + ROUND_OFF) * away;
        PlacedReceiver::new(receiver, error, away + prototype.half_width)
    }
}

/// The error of lights at coordinates of this sum, in a prototype of this size.
fn error(coordinates: f32, size: f32) -> f32 {
    ROUND_OFF * coordinates + (RIGID_TOLERANCE + ROUND_OFF) * size
}

/// How far from its origin lights of a prototype may be.
fn size(prototype: &LightPrototype) -> f32 {
    norm(prototype.center) + prototype.half_width
}

/// The sum of the coordinates' magnitudes, not below the length.
#[inline(always)]
fn norm(v: Vec3) -> f32 {
    v.abs().element_sum()
}
