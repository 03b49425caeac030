use light_math::float;
use light_math::glam::{Mat3, Quat, Vec3};

use crate::importance::context_receiver::ContextReceiver;
use crate::importance::frame::Frame;
use crate::instances::placed_receiver::PlacedReceiver;
use crate::instances::placement::{Placement, RIGID_TOLERANCE};
use crate::instances::prototype::LightPrototype;

/// Round-off of coordinates: of a light that is placed, and of a receiver that is moved into the
/// frame of a prototype, as a share of the coordinates.
const ROUND_OFF: f32 = 1e-6;

/// Where a prototype is placed, as queries need it: 32 bytes, two on a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct PlacedFrame {
    /// The rotation as a unit quaternion whose largest component is above 0, and left out.
    rotation: [f32; 3],
    /// Where the middle of the prototype's lights is placed.
    pub(crate) center: Vec3,
    /// One over the scale; negative if the prototype is mirrored.
    inv_scale: f32,
    /// The prototype, and in the highest bits which component of the rotation is left out.
    prototype: u32,
}

const _: () = assert!(size_of::<PlacedFrame>() == 32, "as documented");

/// From which bit on a frame says which component of its rotation is left out.
const LEFT_OUT: u32 = 30;

impl PlacedFrame {
    /// How many prototypes can be placed.
    pub(crate) const PROTOTYPES: usize = 1 << LEFT_OUT;

    pub(crate) fn new(placement: &Placement, prototype: &LightPrototype) -> Self {
        let &Placement {
            rotation,
            scale,
            translation,
            ..
        } = placement;
        let inside = prototype.center;
        let (left_out, others) = without_largest(rotation);
        Self {
            rotation: others,
            center: translation + rotation * (inside * scale),
            inv_scale: 1.0 / scale,
            prototype: placement.prototype | left_out << LEFT_OUT,
        }
    }

    /// Which prototype it is.
    #[inline(always)]
    pub(crate) const fn prototype(&self) -> usize {
        (self.prototype & ((1 << LEFT_OUT) - 1)) as usize
    }

    #[inline(always)]
    fn rotation(&self) -> Quat {
        with_largest(self.prototype >> LEFT_OUT, self.rotation)
    }

    /// The axes of the prototype, as they are placed: unit vectors.
    pub(crate) fn axes(&self) -> Mat3 {
        Mat3::from_quat(self.rotation())
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
        let frame = Frame::new(self.rotation(), self.inv_scale, self.center, inside);
        let receiver = receiver.in_frame(&frame);
        let away = norm(receiver.position() - inside);
        // The translation has coordinates of at most those of the centre, and the root of 3 times
        // the way from one to the other.
        let size = size(prototype);
        let coordinates = 2.0 * (norm(self.center) * self.inv_scale.abs() + size);
        let error = error(coordinates, size) + (RIGID_TOLERANCE + ROUND_OFF) * away;
        PlacedReceiver::new(receiver, error, away + prototype.half_width)
    }
}

/// The place of the largest component of a unit quaternion, and the others of the one that is the
/// same rotation and has it above 0.
fn without_largest(rotation: Quat) -> (u32, [f32; 3]) {
    let [x, y, z, w] = rotation.normalize().to_array();
    let all = [
        (0, x, [y, z, w]),
        (1, y, [x, z, w]),
        (2, z, [x, y, w]),
        (3, w, [x, y, z]),
    ];
    let larger = |a: &(u32, f32, _), b: &(u32, f32, _)| a.1.abs().total_cmp(&b.1.abs());
    let (place, largest, others) = all.into_iter().max_by(larger).unwrap_or(all[3]);
    (place, others.map(|other| other * 1.0f32.copysign(largest)))
}

/// The rotation without whose component at `place` only the others are left. That one is at least
/// half, so that its square, which is what they leave of 1, is known well.
#[inline(always)]
fn with_largest(place: u32, [a, b, c]: [f32; 3]) -> Quat {
    let largest = float::sqrt(1.0 - (a * a + b * b + c * c));
    match place {
        0 => Quat::from_xyzw(largest, a, b, c),
        1 => Quat::from_xyzw(a, largest, b, c),
        2 => Quat::from_xyzw(a, b, largest, c),
        _ => Quat::from_xyzw(a, b, c, largest),
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
