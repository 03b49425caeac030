use super::grid::Grid;
use super::majorant::Layer;
use super::majorant_grid::MajorantGrid;
use super::{Coefficients, GridMediumError, Majorants, Medium};
use crate::phase::Phase;
use crate::ray::{Ray, Span};
use crate::region::Region;
use light_math::Aabb;
use light_math::glam::{Affine3A, Vec3};
use light_sources::{ColorModel, Radiance};

/// A coloured quantity over the unit cube: three channels, and the basis colour of each in the
/// colour model.
///
/// For RGB the basis is red, green and blue; for spectra any three of them.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize, S: serde::Serialize")
)]
pub struct ColorGrid<C: ColorModel, S> {
    basis: [C::Emission; 3],
    grid: Grid<S, 3>,
}

/// Why a coloured grid is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ColorGridError {
    /// A value of the basis is negative or not finite.
    Basis,
}

impl<C: ColorModel, S: AsRef<[f32]>> ColorGrid<C, S> {
    /// The sum of the channels of `grid`, each times its member of `basis`.
    ///
    /// # Errors
    /// A value of the basis is negative or not finite.
    pub fn new(basis: [C::Emission; 3], grid: Grid<S, 3>) -> Result<Self, ColorGridError> {
        if basis.iter().all(C::is_valid) {
            Ok(Self { basis, grid })
        } else {
            Err(ColorGridError::Basis)
        }
    }

    fn at(&self, p: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        let channels = self.grid.lookup(p);
        let parts = self.basis.iter().zip(channels);
        parts.fold(C::Radiance::BLACK, |sum, (basis, channel)| {
            sum + C::emit(basis, wavelengths) * channel
        })
    }

    /// Upper bound of the sum for the channels 1, 1, 1; times the largest channel it bounds any
    /// sum.
    fn of_ones(&self, wavelengths: &C::Wavelengths) -> f32 {
        let basis = self.basis.iter().map(|b| C::emit(b, wavelengths));
        basis.fold(C::Radiance::BLACK, |sum, b| sum + b).maximum()
    }

    /// Upper bound of the sum over the cube, for all wavelengths.
    fn max_value(&self) -> f32 {
        let ones = self.basis.iter().map(C::maximum).sum::<f32>();
        ones * self.grid.max_value()
    }

    fn majorants(&self) -> MajorantGrid {
        MajorantGrid::new(self.grid.size(), self.grid.maxima())
    }
}

/// A medium whose absorption, scattering and emission vary in colour over grids that fill a box.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize, S: serde::Serialize")
)]
pub struct ColorGridMedium<C: ColorModel, S> {
    sigma_a: ColorGrid<C, S>,
    sigma_s: ColorGrid<C, S>,
    le: Option<ColorGrid<C, S>>,
    // Derived from the samples.
    #[cfg_attr(feature = "serde", serde(skip))]
    majorants: [MajorantGrid; 2],
    phase: Phase,
    region: Region,
}

impl<C: ColorModel, S: AsRef<[f32]>> ColorGridMedium<C, S> {
    /// The medium in `bounds` of a space that `to_scene` takes to the scene: absorption `sigma_a`
    /// and scattering `sigma_s` per unit length; it emits `sigma_a le` per
    /// unit length.
    ///
    /// # Errors
    /// The box is empty, flat or not finite, the transform has no inverse, or extinction or emission
    /// is not finite where the grids are largest.
    pub fn new(
        sigma_a: ColorGrid<C, S>,
        sigma_s: ColorGrid<C, S>,
        le: Option<ColorGrid<C, S>>,
        phase: Phase,
        bounds: Aabb,
        to_scene: Affine3A,
    ) -> Result<Self, GridMediumError> {
        let absorbed = sigma_a.max_value();
        let most_le = le.as_ref().map_or(0.0, ColorGrid::max_value);
        GridMediumError::check(absorbed + sigma_s.max_value(), absorbed * most_le)?;
        Ok(Self {
            majorants: [sigma_a.majorants(), sigma_s.majorants()],
            sigma_a,
            sigma_s,
            le,
            phase,
            region: Region::unit_cube(bounds, to_scene)?,
        })
    }
}

impl<C: ColorModel, S: AsRef<[f32]>> Medium<C> for ColorGridMedium<C, S> {
    fn phase(&self) -> &Phase {
        &self.phase
    }

    fn coefficients(&self, p: Vec3, wavelengths: &C::Wavelengths) -> Coefficients<C::Radiance> {
        let Some(p) = self.region.locate(p) else {
            return Coefficients::VACUUM;
        };
        let sigma_a = self.sigma_a.at(p, wavelengths);
        let le = self.le.as_ref().map(|le| le.at(p, wavelengths));
        Coefficients {
            sigma_a,
            sigma_s: self.sigma_s.at(p, wavelengths),
            emission: le.map_or(C::Radiance::BLACK, |le| sigma_a * le),
        }
    }

    fn clip(&self, ray: &Ray, span: Span) -> Option<Span> {
        self.region.clip(ray, span)
    }

    fn majorants(&self, ray: &Ray, span: Span, wavelengths: &C::Wavelengths) -> Majorants<'_> {
        let [a, s] = &self.majorants;
        let layers: [Layer<'_>; 2] = [
            Some((a, self.sigma_a.of_ones(wavelengths))),
            Some((s, self.sigma_s.of_ones(wavelengths))),
        ];
        let rounding = self.region.rounding(ray, span.t1);
        Majorants::cells(span, layers, &self.region.local_ray(ray), rounding)
    }
}

impl core::fmt::Display for ColorGridError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(
            "the channels of a coloured grid must stand for finite values, nowhere negative",
        )
    }
}

impl core::error::Error for ColorGridError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase::Isotropic;
    use alloc::vec::Vec;
    use light_sources::Rgb;

    const RGB: [Vec3; 3] = [Vec3::X, Vec3::Y, Vec3::Z];

    fn grid(seed: u32, size: [u32; 3]) -> Grid<Vec<f32>, 3> {
        let n = 3 * size.iter().product::<u32>();
        let value = |i: u32| (i.wrapping_mul(2_654_435_761 ^ seed) >> 24) as f32 / 64.0;
        Grid::new(size, (0..n).map(value).collect()).expect("valid")
    }

    fn medium() -> ColorGridMedium<Rgb, Vec<f32>> {
        let colored = |seed| ColorGrid::new(RGB, grid(seed, [7, 3, 5])).expect("valid");
        let phase = Phase::Isotropic(Isotropic);
        let cube = Aabb::new(Vec3::ZERO, Vec3::new(2.0, 1.0, 1.0));
        let le = Some(colored(3));
        ColorGridMedium::new(colored(1), colored(2), le, phase, cube, Affine3A::IDENTITY)
            .expect("valid")
    }

    #[test]
    fn channels_are_colours() {
        let ones = Grid::new([1, 1, 1], [1.0, 2.0, 3.0]).expect("valid");
        let scaled = RGB.map(|c| c * 0.5);
        let colored = ColorGrid::<Rgb, _>::new(scaled, ones).expect("valid");
        let middle = Vec3::splat(0.5);
        assert_eq!(colored.at(middle, &()), Vec3::new(0.5, 1.0, 1.5), "scaled");
        assert_eq!(colored.of_ones(&()), 0.5, "a tight bound");
        let negative = [Vec3::NEG_X, Vec3::Y, Vec3::Z];
        let ones = Grid::new([1, 1, 1], [1.0; 3]).expect("valid");
        let refused = ColorGrid::<Rgb, _>::new(negative, ones).err();
        assert_eq!(refused, Some(ColorGridError::Basis), "negative");
    }

    #[test]
    fn majorants_bound_the_extinction_in_all_channels() {
        let medium = medium();
        let ray = Ray {
            o: Vec3::new(-0.5, 0.1, 0.05),
            d: Vec3::new(1.0, 0.3, 0.35).normalize(),
        };
        let far = Span { t0: 0.0, t1: 9.0 };
        let span = medium.clip(&ray, far).expect("hits the box");
        for segment in medium.majorants(&ray, span, &()) {
            for i in 0..=16u8 {
                let t = segment.span.t0 + segment.span.length() * f32::from(i) / 16.0;
                let sigma_t = medium.coefficients(ray.at(t), &()).sigma_t().maximum();
                let bound = segment.sigma_maj;
                assert!(sigma_t <= bound * 1.0001, "{sigma_t} above {bound} at {t}");
            }
        }
        let here = medium.coefficients(Vec3::splat(0.5), &());
        assert!(here.emission.min_element() > 0.0, "it glows");
    }
}
