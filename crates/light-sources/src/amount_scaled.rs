use crate::amount::{IntensityAmount, IrradianceAmount, RadianceAmount, SurfaceAmount};
use light_math::spectrum::photometric::{Candela, Lumen, Lux, Nit, Watt};

impl IntensityAmount {
    /// So many times the amount, in the same unit.
    #[must_use]
    pub const fn scaled(self, factor: f32) -> Self {
        match self {
            Self::Radiometric(scale) => Self::Radiometric(scale * factor),
            Self::LuminousIntensity(Candela(n)) => Self::LuminousIntensity(Candela(n * factor)),
            Self::LuminousPower(Lumen(n)) => Self::LuminousPower(Lumen(n * factor)),
            Self::RadiantPower(Watt(n)) => Self::RadiantPower(Watt(n * factor)),
        }
    }
}

impl IrradianceAmount {
    /// So many times the amount, in the same unit.
    #[must_use]
    pub const fn scaled(self, factor: f32) -> Self {
        match self {
            Self::Radiometric(scale) => Self::Radiometric(scale * factor),
            Self::Illuminance(Lux(n)) => Self::Illuminance(Lux(n * factor)),
        }
    }
}

impl RadianceAmount {
    /// So many times the amount, in the same unit.
    #[must_use]
    pub const fn scaled(self, factor: f32) -> Self {
        match self {
            Self::Radiometric(scale) => Self::Radiometric(scale * factor),
            Self::Luminance(Nit(n)) => Self::Luminance(Nit(n * factor)),
        }
    }
}

impl SurfaceAmount {
    /// So many times the amount, in the same unit.
    #[must_use]
    pub const fn scaled(self, factor: f32) -> Self {
        match self {
            Self::Radiance(amount) => Self::Radiance(amount.scaled(factor)),
            Self::LuminousPower(Lumen(n)) => Self::LuminousPower(Lumen(n * factor)),
            Self::RadiantPower(Watt(n)) => Self::RadiantPower(Watt(n * factor)),
        }
    }
}
