use alloc::vec::Vec;

use light_math::equal_area::square_to_sphere;
use light_math::glam::{Vec2, Vec3};

use super::axis_weights::{Measure, axis_weights};
use super::photometric_web_error::PhotometricWebError;
use super::photometric_web_ref::PhotometricWebRef;
use super::unfolded_axis::UnfoldedAxis;
use super::web_type::WebType;

/// The intensity of a luminaire by direction: candelas at vertical and horizontal angles, bilinear
/// in between, 0 outside.
///
/// Light space is right-handed with y up, whatever the [`WebType`]: the nadir is -y, and the
/// direction that the standard calls photometric horizontal is +x.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotometricWeb {
    web_type: WebType,
    vertical: Vec<f32>,
    horizontal: Vec<f32>,
    /// The values of all vertical angles for each horizontal angle.
    candelas: Vec<f32>,
}

impl PhotometricWeb {
    /// The web of the given angles in degrees; `candelas` holds the values of one horizontal angle
    /// after the other.
    ///
    /// Angles omitted because of symmetry are added. Type C: horizontal angles that end at 0 are
    /// those of a rotationally symmetric web, at 90 of one with four equal quadrants, at 180 (or
    /// from 90 to 270) of one with two equal halves; any end above 180, up to 360, is taken
    /// for a full turn. Types A and B: angles from 0 are mirrored to below 0.
    ///
    /// # Errors
    /// When the angles do not fit the type, or the candelas the angles.
    pub fn new(
        web_type: WebType,
        vertical: &[f32],
        horizontal: &[f32],
        candelas: &[f32],
    ) -> Result<Self, PhotometricWebError> {
        let is_valid = |&value: &f32| value >= 0.0 && value.is_finite();
        let count = vertical.len() * horizontal.len();
        if candelas.len() != count || !candelas.iter().all(is_valid) {
            return Err(PhotometricWebError::Candelas);
        }
        let rows =
            UnfoldedAxis::vertical(web_type, vertical).ok_or(PhotometricWebError::Vertical)?;
        let planes = UnfoldedAxis::horizontal(web_type, horizontal)
            .ok_or(PhotometricWebError::Horizontal)?;
        let value = |&plane: &usize| {
            let plane = &candelas[plane * vertical.len()..][..vertical.len()];
            rows.from.iter().map(|&row| plane[row])
        };
        Ok(Self {
            web_type,
            candelas: planes.from.iter().flat_map(value).collect(),
            vertical: rows.angles,
            horizontal: planes.angles,
        })
    }

    /// The convention of the angles.
    #[must_use]
    pub const fn web_type(&self) -> WebType {
        self.web_type
    }

    /// The vertical angles in degrees, in ascending order, with those that symmetry adds.
    #[must_use]
    pub fn vertical(&self) -> &[f32] {
        &self.vertical
    }

    /// The horizontal angles in degrees, in ascending order, with those that symmetry adds.
    #[must_use]
    pub fn horizontal(&self) -> &[f32] {
        &self.horizontal
    }

    /// What queries need, borrowed; it has the bits of this web.
    #[inline]
    #[must_use]
    pub fn view(&self) -> PhotometricWebRef<'_> {
        let (vertical, horizontal) = (&self.vertical, &self.horizontal);
        PhotometricWebRef::of_valid(self.web_type, vertical, horizontal, &self.candelas)
    }

    /// The intensity in cd at a vertical and a horizontal angle in degrees.
    #[must_use]
    pub fn at(&self, vertical: f32, horizontal: f32) -> f32 {
        self.view().at(vertical, horizontal)
    }

    /// The intensity in cd in a unit direction of light space.
    #[must_use]
    pub fn toward(&self, w: Vec3) -> f32 {
        self.view().toward(w)
    }

    /// The largest intensity, in cd.
    #[must_use]
    pub fn peak_candelas(&self) -> f32 {
        self.view().peak_candelas()
    }

    /// The luminous flux in lm: the exact integral of the bilinear interpolation over all
    /// directions.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
    pub fn total_lumens(&self) -> f32 {
        let [rows, planes] = match self.web_type {
            WebType::A => [Measure::Latitude, Measure::Longitude],
            WebType::B => [Measure::Longitude, Measure::Latitude],
            WebType::C => [Measure::Colatitude, Measure::Longitude],
        };
        let rows = axis_weights(&self.vertical, rows);
        let planes = axis_weights(&self.horizontal, planes);
        let along = |plane: &[f32]| -> f64 {
            let values = rows.iter().zip(plane);
            values
                .map(|(weight, &value)| weight * f64::from(value))
                .sum()
        };
        let each = self.candelas.chunks_exact(rows.len()).zip(&planes);
        each.map(|(plane, weight)| weight * along(plane))
            .sum::<f64>() as f32
    }

    /// The distribution over directions as an equal-area square of `size` texels a side, row by row
    /// from row 0, `size * size` in all: each the mean intensity over the texel divided by the
    /// peak, in `[0, 1]`.
    ///
    /// # Source
    /// The map of the square is that of [`light_math::equal_area`].
    #[must_use]
    pub fn distribution(&self, size: u32) -> Vec<f32> {
        // Samples per side of a texel: at least 1024 a side of the square.
        let places = 1024_u32.div_ceil(size.max(1)).clamp(2, 4);
        let peak = self.peak_candelas();
        let part = if peak > 0.0 { 1.0 / peak } else { 0.0 };
        let place = |x: u32, y: u32, i: u32| {
            let inside = Vec2::new((i % places) as f32, (i / places) as f32) + 0.5;
            let texel = Vec2::new(x as f32, y as f32) + inside / places as f32;
            part * self.toward(square_to_sphere(texel / size as f32))
        };
        let count = places * places;
        let mean = |x, y| (0..count).map(|i| place(x, y, i)).sum::<f32>() / count as f32;
        (0..size)
            .flat_map(|y| (0..size).map(move |x| mean(x, y)))
            .collect()
    }
}
