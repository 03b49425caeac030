/// The kind of a light by how its light arrives, which decides how MIS treats it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LightType {
    /// All light comes from one point, which no ray hits: no multiple importance sampling.
    DeltaPosition,
    /// All light comes from one direction, which no ray has by chance.
    DeltaDirection,
    /// Light leaves a surface that rays can hit.
    Area,
    /// Light arrives from infinitely far away, for rays that leave the scene.
    Infinite,
}

impl LightType {
    /// Whether the light is a Dirac, so that only [`sample_li`](crate::Light::sample_li) can find
    /// it.
    #[must_use]
    pub const fn is_delta(self) -> bool {
        matches!(self, Self::DeltaPosition | Self::DeltaDirection)
    }

    /// Whether rays that leave the scene find the light.
    #[must_use]
    pub const fn is_infinite(self) -> bool {
        matches!(self, Self::Infinite)
    }
}

#[cfg(test)]
mod tests {
    use super::LightType::{Area, DeltaDirection, DeltaPosition, Infinite};

    #[test]
    fn each_type_is_dirac_or_infinite_or_a_surface() {
        for (light_type, expected) in [
            (DeltaPosition, [true, false]),
            (DeltaDirection, [true, false]),
            (Area, [false, false]),
            (Infinite, [false, true]),
        ] {
            let found = [light_type.is_delta(), light_type.is_infinite()];
            assert_eq!(found, expected, "{light_type:?}");
        }
    }
}
