use crate::glam::Vec3;

/// Which sides of a surface emit. The front is the side to which the geometric normal points: for a
/// triangle the one from which its vertices run counter-clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Sides {
    /// The front alone.
    #[default]
    Front,
    /// The back alone.
    Back,
    /// Front and back.
    Both,
}

impl Sides {
    /// The number of sides that emit, 1 or 2.
    #[must_use]
    pub const fn count(self) -> f32 {
        match self {
            Self::Front | Self::Back => 1.0,
            Self::Both => 2.0,
        }
    }

    /// Whether a surface with normal `n` emits toward `w`.
    #[must_use]
    pub fn emit_toward(self, n: Vec3, w: Vec3) -> bool {
        match self {
            Self::Front => n.dot(w) > 0.0,
            Self::Back => n.dot(w) < 0.0,
            Self::Both => true,
        }
    }

    /// The normal on the side that emits, for the geometric normal `n`; `n` itself when both do.
    #[must_use]
    pub fn emitting_normal(self, n: Vec3) -> Vec3 {
        match self {
            Self::Front | Self::Both => n,
            Self::Back => -n,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_side_emits_to_its_own() {
        let (n, up, down) = (Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.6, 0.0, -0.8));
        for (sides, count, to, normal) in [
            (Sides::Front, 1.0, [true, false], n),
            (Sides::Back, 1.0, [false, true], -n),
            (Sides::Both, 2.0, [true, true], n),
        ] {
            assert_eq!(sides.count(), count, "{sides:?}");
            let emits = [up, down].map(|w| sides.emit_toward(n, w));
            assert_eq!(emits, to, "{sides:?}");
            assert_eq!(sides.emitting_normal(n), normal, "{sides:?}");
        }
        let along = Vec3::X;
        assert!(!Sides::Front.emit_toward(n, along), "not along the surface");
        assert!(!Sides::Back.emit_toward(n, along), "not along the surface");
    }
}
