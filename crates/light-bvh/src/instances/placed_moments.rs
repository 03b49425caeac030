use alloc::vec::Vec;

use light_bounds::LightExtent;
use light_math::Aabb;
use light_math::glam::{Mat3, Vec3};

use crate::build::group_extent::group_extent;
use crate::build::lights::LeafMoments;
use crate::instances::placed_frame::PlacedFrame;
use crate::instances::placement::Placement;
use crate::instances::prototype::LightPrototype;
use crate::node::moments::Moments;
use crate::simd::prefetch;

/// A placed prototype as a leaf of the upper tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedGroup {
    /// With the peak intensity as a share of the prototype's power.
    moments: Moments,
    /// The power of its lights.
    power: f64,
}

impl PlacedGroup {
    /// The lights of `prototype` as `placement` places them, which `frame` is made of.
    pub(crate) fn new(
        prototype: &LightPrototype,
        frame: &PlacedFrame,
        placement: &Placement,
    ) -> Self {
        let inner = &prototype.moments;
        let power = f64::from(prototype.tree().power()) * f64::from(placement.power);
        if !(inner.power > 0.0 && power > 0.0) {
            return Self {
                moments: Moments::NOTHING,
                power: 0.0,
            };
        }
        let scale = frame.scale();
        let axes = frame.axes();
        let place = |x: Vec3| frame.center + axes * ((x - prototype.center) * scale);
        let error = frame.error(placement, prototype);
        let bounds = bounds(prototype, scale.abs(), error, axes, place);
        let mut moments = Moments {
            bounds,
            mean: place(inner.mean).clamp(bounds.min, bounds.max),
            axis: axes * inner.axis * 1.0f32.copysign(scale),
            ..*inner
        };
        // Depth and covariance stay shares of the squared width, which turning changes.
        let relative_width = inner.width() * scale.abs() / moments.width().max(f32::MIN_POSITIVE);
        let relative_width = relative_width.min(1.0);
        moments.depth_var *= relative_width * relative_width;
        moments.covariance = inner.covariance.turned(axes, relative_width);
        Self { moments, power }
    }

    /// The box of all its lights; empty if none is on.
    pub(crate) const fn bounds(&self) -> &Aabb {
        &self.moments.bounds
    }

    pub(crate) const fn power(&self) -> f64 {
        self.power
    }

    /// What the builder reads of the group to place it among others, as if it were one light:
    /// centre, power, and axis.
    pub(crate) fn extent(&self) -> LightExtent {
        let is_lit = self.moments.power > 0.0;
        let power = if is_lit { Some(self.power) } else { None };
        group_extent(self.moments.mean, self.moments.axis, power)
    }
}

/// The box of the placed lights of `prototype`, larger by `error`.
///
/// A turned box of all lights, and the turned boxes of the root's children: what is in both.
fn bounds(
    prototype: &LightPrototype,
    scale: f32,
    error: f32,
    axes: Mat3,
    place: impl Fn(Vec3) -> Vec3,
) -> Aabb {
    let turned = |inner: Aabb| {
        let half = 0.5 * scale * inner.diagonal();
        let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis].map(Vec3::abs);
        let half = x * half.x + y * half.y + z * half.z;
        let center = place(inner.center());
        Aabb {
            min: center - half,
            max: center + half,
        }
    };
    let whole = turned(prototype.moments.bounds);
    let parts = prototype.child_boxes().map(turned);
    let parts = parts.fold(Aabb::EMPTY, Aabb::union);
    Aabb {
        min: whole.min.max(parts.min) - error,
        max: whole.max.min(parts.max) + error,
    }
}

/// All placed prototypes.
pub(crate) struct PlacedGroups(pub(crate) Vec<PlacedGroup>);

impl PlacedGroups {
    /// The same as leaves of the upper tree, where all together have the power `power`.
    pub(crate) fn leaves(&self, power: f64) -> PlacedLeaves<'_> {
        PlacedLeaves {
            groups: &self.0,
            inv_power: if power > 0.0 { 1.0 / power } else { 0.0 },
        }
    }
}

/// The leaves of the upper tree.
pub(crate) struct PlacedLeaves<'a> {
    groups: &'a [PlacedGroup],
    /// One over the power of all of them, 0 if they have none.
    inv_power: f64,
}

impl LeafMoments for PlacedLeaves<'_> {
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
    fn moments(&self, placement: u32) -> Moments {
        let PlacedGroup { moments, power } = self.groups[placement as usize];
        if !(moments.power > 0.0) {
            return Moments::NOTHING;
        }
        let share = (f64::from(moments.power) * power * self.inv_power) as f32;
        Moments {
            power: share.clamp(f32::MIN_POSITIVE, f32::MAX),
            ..moments
        }
    }

    #[inline]
    fn prefetch(&self, placement: u32) {
        prefetch::<1, _>(self.groups, placement);
    }
}
