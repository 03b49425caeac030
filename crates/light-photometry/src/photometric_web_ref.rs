use light_math::float;
use light_math::glam::Vec3;

use super::axis::{Axis, full_turn};
use super::photometric_web_error::PhotometricWebError;
use super::web_type::WebType;

/// A photometric web on borrowed memory, for one in flash or in a buffer; needs no allocator.
///
/// Light space and the interpolation are those of [`PhotometricWeb`](crate::PhotometricWeb), whose
/// arrays these are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhotometricWebRef<'a> {
    web_type: WebType,
    vertical: Axis<'a>,
    horizontal: Axis<'a>,
    candelas: &'a [f32],
}

impl<'a> PhotometricWebRef<'a> {
    /// The web of the given angles in degrees, with those that symmetry adds; `candelas` holds the
    /// values of all vertical angles for each horizontal angle.
    ///
    /// # Errors
    /// When the angles of an axis do not ascend, or the candelas do not fit the angles.
    pub fn new(
        web_type: WebType,
        vertical: &'a [f32],
        horizontal: &'a [f32],
        candelas: &'a [f32],
    ) -> Result<Self, PhotometricWebError> {
        let is_valid = |&value: &f32| value >= 0.0 && value.is_finite();
        let count = vertical.len().checked_mul(horizontal.len());
        if Some(candelas.len()) != count || !candelas.iter().all(is_valid) {
            return Err(PhotometricWebError::Candelas);
        }
        Ok(Self {
            web_type,
            vertical: Axis::new(vertical).ok_or(PhotometricWebError::Vertical)?,
            horizontal: Axis::new(horizontal).ok_or(PhotometricWebError::Horizontal)?,
            candelas,
        })
    }

    /// Of axes and candelas that were checked before.
    #[cfg(feature = "alloc")]
    pub(super) const fn of_valid(
        web_type: WebType,
        vertical: &'a [f32],
        horizontal: &'a [f32],
        candelas: &'a [f32],
    ) -> Self {
        Self {
            web_type,
            vertical: Axis::of_valid(vertical),
            horizontal: Axis::of_valid(horizontal),
            candelas,
        }
    }

    /// The convention of the angles.
    #[must_use]
    pub const fn web_type(&self) -> WebType {
        self.web_type
    }

    /// The vertical angles in degrees, in ascending order.
    #[must_use]
    pub const fn vertical(&self) -> &'a [f32] {
        self.vertical.angles()
    }

    /// The horizontal angles in degrees, in ascending order.
    #[must_use]
    pub const fn horizontal(&self) -> &'a [f32] {
        self.horizontal.angles()
    }

    /// The intensities in cd: those of all vertical angles for each horizontal angle.
    #[must_use]
    pub const fn candelas(&self) -> &'a [f32] {
        self.candelas
    }

    /// The intensity in cd at a vertical and a horizontal angle in degrees.
    #[must_use]
    pub fn at(&self, vertical: f32, horizontal: f32) -> f32 {
        let place = (
            self.vertical.place(vertical),
            self.horizontal.place(horizontal),
        );
        let (Some(row), Some(plane)) = place else {
            return 0.0;
        };
        let n = self.vertical.angles().len();
        let along = |plane: usize| {
            let [low, high] = [row.below, row.above].map(|row| self.candelas[plane * n + row]);
            low + row.t * (high - low)
        };
        let (low, high) = (along(plane.below), along(plane.above));
        low + plane.t * (high - low)
    }

    /// The intensity in cd in a unit direction of light space.
    #[must_use]
    pub fn toward(&self, w: Vec3) -> f32 {
        let (vertical, horizontal) = match self.web_type {
            // At the poles of these types a negative zero would mean the direction behind.
            WebType::A => (float::safe_asin(w.y), float::atan2(w.z, w.x + 0.0)),
            WebType::B => (float::atan2(w.x, 0.0 - w.y), float::safe_asin(w.z)),
            WebType::C => (float::safe_acos(-w.y), float::atan2(-w.z, w.x)),
        };
        let (vertical, horizontal) = (vertical.to_degrees(), horizontal.to_degrees());
        match self.web_type {
            WebType::A | WebType::B => self.at(vertical, horizontal),
            WebType::C => self.at(vertical, full_turn(horizontal)),
        }
    }

    /// The largest intensity, in cd.
    #[must_use]
    pub fn peak_candelas(&self) -> f32 {
        self.candelas.iter().copied().fold(0.0, f32::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_is_no_web() {
        let new = |v, h, c| PhotometricWebRef::new(WebType::C, v, h, c).map(|_| ());
        let (up, turn) = (&[0.0, 90.0][..], &[0.0, 360.0][..]);
        assert_eq!(new(up, turn, &[1.0; 4]), Ok(()), "a web");
        let few = new(up, turn, &[1.0; 3]);
        assert_eq!(few, Err(PhotometricWebError::Candelas), "too few");
        let negative = new(up, turn, &[1.0, 1.0, -1.0, 1.0]);
        assert_eq!(negative, Err(PhotometricWebError::Candelas), "negative");
        let falling = new(&[90.0, 0.0], turn, &[1.0; 4]);
        assert_eq!(falling, Err(PhotometricWebError::Vertical), "falling");
        let none = new(up, &[], &[]);
        assert_eq!(none, Err(PhotometricWebError::Horizontal), "no plane");
    }

    #[cfg(feature = "alloc")]
    #[test]
    fn a_view_is_made_again_from_its_arrays() {
        let candelas = [3.0, 2.0, 1.0, 5.0, 4.0, 0.0];
        let (v, h) = ([0.0, 45.0, 90.0], [0.0, 90.0]);
        let web = crate::PhotometricWeb::new(WebType::C, &v, &h, &candelas).expect("a web");
        let view = web.view();
        let again = PhotometricWebRef::new(
            view.web_type(),
            view.vertical(),
            view.horizontal(),
            view.candelas(),
        );
        assert_eq!(again, Ok(view), "nothing else is needed");
        let w = Vec3::new(0.6, -0.48, 0.64);
        assert_eq!(web.toward(w), view.toward(w), "the same bits");
    }
}
