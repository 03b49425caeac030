use glam::Vec3;

/// An axis-aligned box, in scene units; empty while `min > max` on some axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Aabb {
    /// Lower corner.
    pub min: Vec3,
    /// Upper corner.
    pub max: Vec3,
}

impl Aabb {
    /// The box that holds nothing and is neutral under [`union`](Self::union).
    pub const EMPTY: Self = Self {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    /// The smallest box that holds `a` and `b`.
    #[must_use]
    pub fn new(a: Vec3, b: Vec3) -> Self {
        Self {
            min: a.min(b),
            max: a.max(b),
        }
    }

    /// The box of one point.
    #[must_use]
    pub const fn from_point(p: Vec3) -> Self {
        Self { min: p, max: p }
    }

    /// The smallest box that holds all `points`; [`EMPTY`](Self::EMPTY) when there are none.
    #[must_use]
    pub fn from_points(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::extend)
    }

    /// The smallest box that holds `self` and `p`.
    #[must_use]
    pub fn extend(self, p: Vec3) -> Self {
        Self {
            min: self.min.min(p),
            max: self.max.max(p),
        }
    }

    /// The smallest box that holds both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Whether the box holds no point at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Whether both corners are finite numbers.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// Whether `p` lies in the closed box.
    #[must_use]
    pub fn contains(&self, p: Vec3) -> bool {
        self.min.cmple(p).all() && p.cmple(self.max).all()
    }

    /// Whether every point of `other` lies in `self`; the empty box lies in every box.
    #[must_use]
    pub fn contains_box(&self, other: &Self) -> bool {
        other.is_empty() || (self.contains(other.min) && self.contains(other.max))
    }

    /// The midpoint, computed so that boxes near the ends of the float range do not overflow.
    #[must_use]
    pub fn center(&self) -> Vec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// The vector from the lower to the upper corner.
    #[must_use]
    pub fn diagonal(&self) -> Vec3 {
        self.max - self.min
    }

    /// Centre and radius of the sphere through the corners; radius 0 for the empty box.
    #[must_use]
    pub fn bounding_sphere(&self) -> (Vec3, f32) {
        if self.is_empty() {
            return (Vec3::ZERO, 0.0);
        }
        let center = self.center();
        (center, center.distance(self.max))
    }
}

impl Default for Aabb {
    fn default() -> Self {
        Self::EMPTY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_is_neutral_and_holds_nothing() {
        let b = Aabb::new(Vec3::new(1.0, -1.0, 0.0), Vec3::new(0.0, 2.0, 3.0));
        assert_eq!(Aabb::EMPTY.union(b), b, "neutral");
        assert!(Aabb::EMPTY.is_empty() && !b.is_empty(), "emptiness");
        assert!(!Aabb::EMPTY.contains(Vec3::ZERO), "holds nothing");
        assert!(b.contains_box(&Aabb::EMPTY), "lies in every box");
        assert_eq!(Aabb::EMPTY.bounding_sphere(), (Vec3::ZERO, 0.0), "a point");
        assert_eq!(Aabb::default(), Aabb::EMPTY, "the default");
        assert_eq!(Aabb::from_points([]), Aabb::EMPTY, "no points");
        let corners = [b.max, b.center(), b.min];
        assert_eq!(Aabb::from_points(corners), b, "its corners");
    }

    #[test]
    fn measures() {
        let b = Aabb::new(Vec3::ZERO, Vec3::new(1.0, 2.0, 2.0));
        assert_eq!(
            b.bounding_sphere(),
            (Vec3::new(0.5, 1.0, 1.0), 1.5),
            "half of the diagonal 3"
        );
        assert!(b.contains(b.min) && b.contains(b.max), "closed");
    }

    #[test]
    fn nan_makes_a_box_neither_finite_nor_full() {
        let b = Aabb {
            min: Vec3::NAN,
            max: Vec3::ONE,
        };
        assert!(!b.is_finite() && b.is_empty(), "NaN fails the guards");
    }
}
