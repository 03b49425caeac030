use light_bounds::LightExtent;
use light_math::Aabb;
use light_math::glam::{Mat3, Vec3};

use crate::build::group_extent::group_extent;
use crate::build::lights::phi;
use crate::instances::part::Part;
use crate::instances::placed_frame::PlacedFrame;
use crate::instances::placement::Placement;
use crate::instances::prototype::LightPrototype;
use crate::node::moments::Moments;

/// A placed part of a prototype, or one light of it, as a leaf of the upper tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedGroup {
    /// With the peak intensity as a share of [`whole`](Self::whole).
    moments: Moments,
    /// The power of its lights.
    power: f64,
    /// The power of all lights of the part.
    whole: f64,
}

impl PlacedGroup {
    pub(crate) const DARK: Self = Self {
        moments: Moments::NOTHING,
        power: 0.0,
        whole: 0.0,
    };

    /// The lights of a part of `prototype` as `placement` places them, which `frame` is made of.
    pub(crate) fn new(
        prototype: &LightPrototype,
        part: &Part,
        frame: &PlacedFrame,
        placement: &Placement,
    ) -> Self {
        let inner = &part.moments;
        let power = f64::from(part.power) * f64::from(placement.power);
        if !(inner.power > 0.0 && power > 0.0) {
            return Self::DARK;
        }
        let turned = Turned::new(prototype, frame, placement);
        Self {
            moments: turned.moments(inner, turned.whole_box(part)),
            power,
            whole: power,
        }
    }

    /// `light`, one of those of a part of `prototype` that are together as this says.
    pub(crate) fn of_light(
        &self,
        prototype: &LightPrototype,
        part: &Part,
        frame: &PlacedFrame,
        placement: &Placement,
        light: &LightExtent,
    ) -> Self {
        let power = f64::from(phi(light)) * f64::from(placement.power);
        if !(self.power > 0.0 && power > 0.0) {
            return Self::DARK;
        }
        let inner = Moments::of_light(light, 1.0 / f64::from(part.power));
        let turned = Turned::new(prototype, frame, placement);
        let Aabb { min, max } = turned.box_of(&inner.bounds);
        let all = self.bounds();
        let bounds = Aabb {
            min: min.clamp(all.min, all.max),
            max: max.clamp(all.min, all.max),
        };
        Self {
            moments: turned.moments(&inner, bounds),
            power,
            whole: self.power,
        }
    }

    /// With its peak intensity as a share of a power, of which `inv_power` is one over.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
    pub(crate) fn moments(&self, inv_power: f64) -> Moments {
        let Self { moments, whole, .. } = *self;
        if !(moments.power > 0.0) {
            return Moments::NOTHING;
        }
        let share = (f64::from(moments.power) * whole * inv_power) as f32;
        Moments {
            power: share.clamp(f32::MIN_POSITIVE, f32::MAX),
            ..moments
        }
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

/// The lights of a prototype where they are placed.
pub(crate) struct Turned<'a> {
    prototype: &'a LightPrototype,
    center: Vec3,
    axes: Mat3,
    scale: f32,
    /// How far they may be from where they are computed to be.
    error: f32,
}

impl<'a> Turned<'a> {
    pub(crate) fn new(
        prototype: &'a LightPrototype,
        frame: &PlacedFrame,
        placement: &Placement,
    ) -> Self {
        Self {
            prototype,
            center: frame.center,
            axes: frame.axes(),
            scale: frame.scale(),
            error: frame.error(placement, prototype),
        }
    }

    /// A point of the prototype.
    pub(crate) fn place(&self, x: Vec3) -> Vec3 {
        self.center + self.axes * ((x - self.prototype.center) * self.scale)
    }

    /// An emission axis of the prototype.
    pub(crate) fn axis(&self, w: Vec3) -> Vec3 {
        self.axes * w * 1.0f32.copysign(self.scale)
    }

    /// Moments of some lights, which are in the box `bounds` where they are placed.
    fn moments(&self, inner: &Moments, bounds: Aabb) -> Moments {
        let mut moments = Moments {
            bounds,
            mean: self.place(inner.mean).clamp(bounds.min, bounds.max),
            axis: self.axis(inner.axis),
            line: self.axis(inner.line),
            ..*inner
        };
        // Depth and covariance stay shares of the squared width, which turning changes.
        let width = moments.width().max(f32::MIN_POSITIVE);
        let relative_width = (inner.width() * self.scale.abs() / width).min(1.0);
        moments.depth_var *= relative_width * relative_width;
        moments.covariance = inner.covariance.turned(self.axes, relative_width);
        moments
    }

    /// A box around a turned box, without the error.
    fn turned(&self, inner: &Aabb) -> Aabb {
        let half = 0.5 * self.scale.abs() * inner.diagonal();
        let Mat3 {
            x_axis,
            y_axis,
            z_axis,
        } = self.axes;
        let half = x_axis.abs() * half.x + y_axis.abs() * half.y + z_axis.abs() * half.z;
        let center = self.place(inner.center());
        Aabb {
            min: center - half,
            max: center + half,
        }
    }

    /// A box around the lights that are in the box `inner` of the prototype.
    fn box_of(&self, inner: &Aabb) -> Aabb {
        let Aabb { min, max } = self.turned(inner);
        Aabb {
            min: min - self.error,
            max: max + self.error,
        }
    }

    /// A box around all lights of a part: the turned box of all, and those of the root's children,
    /// what is in both.
    fn whole_box(&self, part: &Part) -> Aabb {
        let whole = self.turned(&part.moments.bounds);
        let parts = part.child_boxes(self.prototype.view().nodes());
        let parts = parts.map(|inner| self.turned(&inner));
        let parts = parts.fold(Aabb::EMPTY, Aabb::union);
        Aabb {
            min: whole.min.max(parts.min) - self.error,
            max: whole.max.min(parts.max) + self.error,
        }
    }
}

/// A power as a float, which is above 0 if the power is.
#[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
pub(crate) fn positive_float(power: f64) -> f32 {
    if power > 0.0 {
        (power as f32).clamp(f32::MIN_POSITIVE, f32::MAX)
    } else {
        0.0
    }
}
