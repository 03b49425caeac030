/// How bright a light at a point is, as the user states it; the emission then gives the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum IntensityAmount {
    /// The intensity is this times the emission, in W/sr.
    Radiometric(f32),
}

/// How bright a light from one direction is, as the user states it; the emission then gives the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum IrradianceAmount {
    /// The irradiance of a plane that faces the light is this times the emission, in W m^-2.
    Radiometric(f32),
}

/// How bright a surface or a sky is, as the user states it; the emission then gives the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RadianceAmount {
    /// The radiance is this times the emission, in W m^-2 sr^-1.
    Radiometric(f32),
}

impl Default for IntensityAmount {
    fn default() -> Self {
        Self::Radiometric(1.0)
    }
}

impl Default for IrradianceAmount {
    fn default() -> Self {
        Self::Radiometric(1.0)
    }
}

impl Default for RadianceAmount {
    fn default() -> Self {
        Self::Radiometric(1.0)
    }
}
