use crate::glam::{Affine3A, Mat3A, Vec3, Vec3A};

/// The path of the canal: from the origin toward -z, then a circular bend to the right.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    /// Radius of the bend along the middle of the canal.
    pub(super) radius: f32,
}

/// A side of the canal, seen along its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bank {
    Left,
    Right,
}

impl Bank {
    pub(super) const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// -1 on the left, 1 on the right.
    pub(super) const fn sign(self) -> f32 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
        }
    }
}

impl Course {
    /// The frame `along` metres down the middle and `across` metres to the right of it: x to the
    /// right, y up, z back along the canal.
    pub(super) fn at(&self, along: f32, across: f32) -> Affine3A {
        let (sin, cos) = (along / self.radius).sin_cos();
        let right = Vec3::new(cos, 0.0, sin);
        let back = Vec3::new(-sin, 0.0, cos);
        let center = Vec3::X * self.radius;
        let axes = Mat3A::from_cols(right.into(), Vec3A::Y, back.into());
        let origin = center - right * (self.radius - across);
        Affine3A {
            matrix3: axes,
            translation: origin.into(),
        }
    }

    /// A frame on a bank, `away` metres from the middle, that faces the water: z toward it, y up, x
    /// to the right of who looks from the water.
    pub(super) fn facing_water(&self, bank: Bank, along: f32, away: f32) -> Affine3A {
        let at = self.at(along, bank.sign() * away);
        let to_water = at.matrix3.x_axis * -bank.sign();
        let axes = Mat3A::from_cols(Vec3A::Y.cross(to_water), Vec3A::Y, to_water);
        Affine3A {
            matrix3: axes,
            translation: at.translation,
        }
    }

    /// How far down the middle one comes by going `distance` at `away` metres from it on a bank.
    pub(super) fn along(&self, bank: Bank, away: f32, distance: f32) -> f32 {
        distance * self.radius / (self.radius - bank.sign() * away)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_straight_ahead_and_bends_right() {
        let course = Course { radius: 100.0 };
        let start = course.at(0.0, 3.0);
        assert_eq!(Vec3::from(start.translation), Vec3::X * 3.0, "to the right");
        assert_eq!(Vec3::from(start.matrix3.z_axis), Vec3::Z, "z is back");
        let ahead = course.at(30.0, 0.0);
        assert!(ahead.translation.z < -29.0, "down -z");
        assert!(ahead.translation.x > 4.0, "to the right");
        for bank in Bank::BOTH {
            let front = course.facing_water(bank, 30.0, 12.0);
            let middle = front.transform_point3(Vec3::Z * 12.0);
            let off = middle.distance(ahead.translation.into());
            assert!(off < 1e-4, "z leads to the middle of the water");
            assert!(front.matrix3.determinant() > 0.99, "right-handed");
        }
    }
}
