use glam::Vec3;

/// An orthonormal, right-handed coordinate frame: the unit vectors `x`, `y`, `z` in the outer
/// space.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Frame {
    /// First axis.
    pub x: Vec3,
    /// Second axis.
    pub y: Vec3,
    /// Third axis, by convention the normal.
    pub z: Vec3,
}

impl Frame {
    /// A frame around the unit vector `z`, continuous except where `z.z` changes sign.
    ///
    /// # Source
    /// `[Duff2017]`, listing 3.
    #[must_use]
    pub fn from_z(z: Vec3) -> Self {
        let sign = 1.0f32.copysign(z.z);
        let a = -1.0 / (sign + z.z);
        let b = z.x * z.y * a;
        Self {
            x: Vec3::new(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x),
            y: Vec3::new(b, sign + z.y * z.y * a, -z.y),
            z,
        }
    }

    /// The frame with the given perpendicular unit vectors as first and third axis.
    #[must_use]
    pub fn from_xz(x: Vec3, z: Vec3) -> Self {
        Self {
            x,
            y: z.cross(x),
            z,
        }
    }

    /// The outer-space vector `v` in this frame's coordinates.
    #[must_use]
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.x), v.dot(self.y), v.dot(self.z))
    }

    /// The vector `v` of this frame in outer-space coordinates.
    #[must_use]
    pub fn from_local(&self, v: Vec3) -> Vec3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn from_z_is_orthonormal_and_right_handed() {
        let axes = [
            Vec3::X,
            Vec3::NEG_Y,
            Vec3::Z,
            Vec3::NEG_Z,
            Vec3::new(0.6, 0.0, -0.8),
            Vec3::new(1e-4, 1e-4, -1.0).normalize(),
        ];
        for z in axes {
            let f = Frame::from_z(z);
            assert!(
                f.x.is_normalized() && f.y.is_normalized(),
                "unit axes for {z}"
            );
            assert!(f.x.cross(f.y).distance(z) < 1e-6, "right-handed for {z}");
            let v = Vec3::new(0.3, -0.2, 0.9);
            assert!(
                f.from_local(f.to_local(v)).distance(v) < 1e-6,
                "round trip for {z}"
            );
        }
    }

    #[test]
    fn from_xz_keeps_both_axes() {
        let frame = Frame::from_z(Vec3::new(0.6, 0.0, -0.8));
        let same = Frame::from_xz(frame.x, frame.z);
        assert_eq!((same.x, same.z), (frame.x, frame.z), "as they were");
        assert!(same.y.distance(frame.y) < 1e-6, "right-handed");
    }
}
