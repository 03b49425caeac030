/// The kind of a light by how its light arrives, which decides how MIS treats it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LightType {
    /// All light comes from one point, which no ray hits, or from a surface that rays do not meet: no
    /// multiple importance sampling.
    DeltaPosition,
    /// All light comes from one direction, which no ray has by chance.
    DeltaDirection,
    /// Light leaves a surface that rays can hit.
    Area,
    /// Light arrives from infinitely far away, for rays that leave the scene.
    Infinite,
}

impl LightType {
    /// Whether only [`sample_li`](crate::Light::sample_li) can find the light: a Dirac, or a surface
    /// that rays do not meet.
    #[must_use]
    pub const fn is_delta(self) -> bool {
        matches!(self, Self::DeltaPosition | Self::DeltaDirection)
    }

    /// Whether light arrives from infinitely far away: in one direction or, for rays that leave the
    /// scene, in many.
    #[must_use]
    pub const fn is_infinite(self) -> bool {
        matches!(self, Self::DeltaDirection | Self::Infinite)
    }
}

#[cfg(test)]
mod tests {
    use super::LightType::{Area, DeltaDirection, DeltaPosition, Infinite};

    #[test]
    fn each_type_is_a_dirac_or_not_and_near_or_not() {
        for (light_type, expected) in [
            (DeltaPosition, [true, false]),
            (DeltaDirection, [true, true]),
            (Area, [false, false]),
            (Infinite, [false, true]),
        ] {
            let found = [light_type.is_delta(), light_type.is_infinite()];
            assert_eq!(found, expected, "{light_type:?}");
        }
    }
}
