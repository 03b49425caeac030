use light_math::glam::{Mat3, Quat, Vec3};

/// A frame that receivers are moved into: that of an object that was turned, scaled alike on all
/// axes, and moved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// The axes of the frame, unit vectors outside of it.
    axes: Mat3,
    /// One over the scale; negative if the object is mirrored.
    inv_scale: f32,
    /// A point outside of the frame, and the same point in it.
    outside: Vec3,
    inside: Vec3,
}

impl Frame {
    /// The frame in which `outside` is at `inside`, and lengths are multiplied by `inv_scale`.
    #[inline(always)]
    pub(crate) fn new(rotation: Quat, inv_scale: f32, outside: Vec3, inside: Vec3) -> Self {
        Self {
            axes: Mat3::from_quat(rotation),
            inv_scale,
            outside,
            inside,
        }
    }

    /// A point, relative to which round-off is a share of the distance.
    #[inline(always)]
    pub(crate) fn point(&self, p: Vec3) -> Vec3 {
        self.inside + self.vector(p - self.outside)
    }

    /// A difference of two points.
    #[inline(always)]
    pub(crate) fn vector(&self, v: Vec3) -> Vec3 {
        self.turned(v) * self.inv_scale
    }

    /// A direction, which keeps its length.
    #[inline(always)]
    pub(crate) fn direction(&self, v: Vec3) -> Vec3 {
        self.turned(v) * 1.0f32.copysign(self.inv_scale)
    }

    #[inline(always)]
    fn turned(&self, v: Vec3) -> Vec3 {
        let Mat3 {
            x_axis,
            y_axis,
            z_axis,
        } = self.axes;
        Vec3::new(x_axis.dot(v), y_axis.dot(v), z_axis.dot(v))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_moved_out_comes_back() {
        let turn = Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), 2.0);
        for scale in [1.0, 0.25, -3.0] {
            let inside = Vec3::new(1.0, 2.0, 3.0);
            let out = |x: Vec3| turn * (x * scale) + Vec3::splat(5.0);
            let frame = Frame::new(turn, 1.0 / scale, out(inside), inside);
            let x = Vec3::new(-4.0, 0.5, 7.0);
            assert!(frame.point(out(x)).distance(x) < 1e-5, "a point, {scale}");
            let v = out(x) - out(inside);
            assert!(frame.vector(v).distance(x - inside) < 1e-5, "{scale}");
            let d = turn * (Vec3::Y * f32::signum(scale));
            assert!(frame.direction(d).distance(Vec3::Y) < 1e-6, "{scale}");
        }
    }
}
