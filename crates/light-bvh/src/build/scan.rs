use light_bounds::{InfiniteBounds, LightExtent, LightId};
use light_math::Aabb;
use light_math::glam::Vec3;

use crate::LightBvhError;
use crate::build::lights::phi;
use crate::build::options::DarkLights;
use crate::importance::position::FAR;
use crate::parallel::join;
use crate::validate::validate_light;

/// The largest number of lights. A tree has fewer nodes than lights, and a place, `16 * node +
/// child`, has 32 bits.
const MAX_LIGHTS: usize = 1 << 28;

/// Whether slots of 32 bits can name the places of so many lights.
pub(crate) const fn is_addressable(lights: usize) -> bool {
    lights <= MAX_LIGHTS
}

/// Makes sure that slots of 32 bits can name the places of so many lights.
///
/// # Errors
/// [`LightBvhError::TooManyLights`].
pub(crate) const fn expect_addressable(lights: usize) -> Result<(), LightBvhError> {
    if is_addressable(lights) {
        return Ok(());
    }
    Err(LightBvhError::TooManyLights { most: MAX_LIGHTS })
}

/// Lights that one job validates.
const CHUNK: usize = 8192;

/// The sums of a first pass over all lights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scan {
    /// The power of all lights together.
    pub(crate) power: f64,
    /// How many lights the tree holds.
    pub(crate) count: usize,
    /// Box of their centres.
    pub(crate) centers: Aabb,
}

impl Scan {
    /// The sums of no light.
    pub(crate) const NOTHING: Self = Self {
        power: 0.0,
        count: 0,
        centers: Aabb::EMPTY,
    };

    /// Adds a light that the tree holds.
    #[inline]
    pub(crate) fn add(&mut self, power: f32, center: Vec3) {
        self.power += f64::from(power);
        self.count += 1;
        self.centers = self.centers.extend(center);
    }

    /// Validates all lights of a tree.
    ///
    /// # Errors
    /// The first light with invalid bounds, or a coordinate beyond the reach of the tree.
    pub(crate) fn of(lights: &[LightExtent], dark: DarkLights) -> Result<Self, LightBvhError> {
        Self::new(lights, 0, dark, &|_, _| Ok(()))
    }

    /// Validates `lights`, of which `first` is the id of the first one; `check` may refuse more of
    /// them.
    ///
    /// The order of additions does not depend on the number of threads.
    ///
    /// # Errors
    /// The first light with invalid bounds, a coordinate beyond the reach of the tree, or an error
    /// by `check`.
    pub(crate) fn new(
        lights: &[LightExtent],
        first: u32,
        dark: DarkLights,
        check: &(impl Fn(LightId, &LightExtent) -> Result<(), LightBvhError> + Sync),
    ) -> Result<Self, LightBvhError> {
        if lights.len() <= CHUNK {
            return Self::of_chunk(lights, first, dark, check);
        }
        let (left, right) = lights.split_at(lights.len() / 2);
        #[expect(clippy::cast_possible_truncation, reason = "ids have 32 bits")]
        let middle = first + left.len() as u32;
        let (left, right) = join(
            lights.len(),
            || Self::new(left, first, dark, check),
            || Self::new(right, middle, dark, check),
        );
        Ok(left?.union(&right?))
    }

    /// The sums of both sets of lights.
    pub(crate) fn union(&self, other: &Self) -> Self {
        Self {
            power: self.power + other.power,
            count: self.count + other.count,
            centers: self.centers.union(other.centers),
        }
    }

    fn of_chunk(
        lights: &[LightExtent],
        first: u32,
        dark: DarkLights,
        check: &(impl Fn(LightId, &LightExtent) -> Result<(), LightBvhError> + Sync),
    ) -> Result<Self, LightBvhError> {
        let mut scan = Self::NOTHING;
        for (light, extent) in (first..).map(LightId).zip(lights) {
            validate_light(light, extent)?;
            check(light, extent)?;
            let Some(bounds) = extent.bounded() else {
                continue;
            };
            if is_far(&bounds.bounds) {
                return Err(LightBvhError::TooFar { light });
            }
            let phi = phi(extent);
            if is_held(phi, dark) {
                scan.add(phi, bounds.bounds.center());
            }
        }
        Ok(scan)
    }
}

/// An extent in the place of a light that gets no place in the tree.
pub(crate) fn not_held() -> LightExtent {
    LightExtent::Infinite(InfiniteBounds::uniform(0.0))
}

/// Whether a light of power `phi` gets a place in the tree.
pub(crate) fn is_held(phi: f32, dark: DarkLights) -> bool {
    phi > 0.0 || dark == DarkLights::Kept
}

fn is_far(bounds: &Aabb) -> bool {
    bounds.min.min_element() < -FAR || bounds.max.max_element() > FAR
}

#[cfg(test)]
mod tests {
    use light_math::float::next_up;

    use alloc::string::ToString;

    use super::*;
    use crate::node::wide_node::{NOWHERE, WIDTH};

    #[test]
    fn a_box_is_far_beyond_any_of_its_faces() {
        let reach = Aabb::new(Vec3::splat(-FAR), Vec3::splat(FAR));
        assert!(!is_far(&reach), "as far as it goes");
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            let beyond = axis * next_up(FAR);
            assert!(is_far(&Aabb::new(Vec3::ZERO, beyond)), "up {axis}");
            assert!(is_far(&Aabb::new(-beyond, Vec3::ZERO)), "down {axis}");
        }
    }

    #[test]
    fn slots_of_the_largest_tree_fit() {
        // Each node has two children at least, so that there are fewer nodes than lights.
        let slots = (MAX_LIGHTS - 1) * WIDTH;
        assert!(is_addressable(MAX_LIGHTS), "so many");
        assert!(slots <= NOWHERE as usize, "no slot is that of no place");
        assert!(!is_addressable(MAX_LIGHTS + 1), "one more");
        assert_eq!(expect_addressable(MAX_LIGHTS), Ok(()), "so many");
        let error = expect_addressable(MAX_LIGHTS + 1).expect_err("one more");
        let says = "expected at most 268435456 lights, which the tree can address";
        assert_eq!(error.to_string(), says, "the limit");
    }
}
