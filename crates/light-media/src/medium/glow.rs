use super::grid::Grid;
#[cfg(feature = "alloc")]
use super::temperature::TemperatureGrid;
use light_math::glam::Vec3;
use light_sources::{ColorModel, Radiance};

/// The emission of a grid medium over the unit cube, as a factor of the emission of its substance.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize, S: serde::Serialize")
)]
pub struct Glow<C: ColorModel, S> {
    /// A factor without colour; 1 if absent.
    pub scale: Option<Grid<S>>,
    /// The colour and strength of black bodies of these temperatures, as a further factor.
    #[cfg(feature = "alloc")]
    pub temperature: Option<TemperatureGrid<C, S>>,
    #[cfg(not(feature = "alloc"))]
    _colors: core::marker::PhantomData<C>,
}

impl<C: ColorModel, S> Default for Glow<C, S> {
    fn default() -> Self {
        Self::uniform()
    }
}

impl<C: ColorModel, S> Glow<C, S> {
    /// The factor 1 everywhere.
    #[must_use]
    pub fn uniform() -> Self {
        Self {
            scale: None,
            #[cfg(feature = "alloc")]
            temperature: None,
            #[cfg(not(feature = "alloc"))]
            _colors: core::marker::PhantomData,
        }
    }

    /// The factors of a grid.
    #[must_use]
    pub fn scaled(scale: Grid<S>) -> Self {
        Self {
            scale: Some(scale),
            #[cfg(feature = "alloc")]
            temperature: None,
            #[cfg(not(feature = "alloc"))]
            _colors: core::marker::PhantomData,
        }
    }

    /// Black bodies of the temperatures of a grid.
    #[cfg(feature = "alloc")]
    #[must_use]
    pub fn of_temperature(temperature: TemperatureGrid<C, S>) -> Self {
        Self {
            scale: None,
            temperature: Some(temperature),
        }
    }
}

impl<C: ColorModel, S: AsRef<[f32]>> Glow<C, S> {
    /// An upper bound of the factor over the cube, for all wavelengths.
    pub(super) fn max_value(&self) -> f32 {
        let scale = self.scale.as_ref().map_or(1.0, Grid::max_value);
        #[cfg(feature = "alloc")]
        if let Some(temperature) = &self.temperature {
            return temperature.max_value() * scale;
        }
        scale
    }

    /// The factor at `p` of the unit cube.
    pub(super) fn at(&self, p: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        let [scale] = self.scale.as_ref().map_or([1.0], |grid| grid.lookup(p));
        #[cfg(feature = "alloc")]
        if let Some(temperature) = &self.temperature {
            return temperature.at(p, wavelengths) * scale;
        }
        let _ = wavelengths;
        C::Radiance::splat(scale)
    }
}
