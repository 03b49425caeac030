//! Environment maps as a few directional lights of equal energy.

mod centroid;
mod energy;
mod pyramid;
mod region;

use alloc::collections::BinaryHeap;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Ordering;
use core::error::Error;
use core::fmt;

use crate::amount::IrradianceAmount;
use crate::distant::DistantLightDesc;
use crate::glam::Vec3;
use crate::image::Image;
use crate::rgb::Rgb;
use light_math::SphereMap;

pub use centroid::Centroid;
use centroid::RegionSum;
use energy::EnergyIndex;
pub use energy::RegionSums;
pub use region::TexelRegion;
use region::texel_solid_angle;

/// An environment map, ready to be cut into regions of equal energy, each of which becomes a
/// distant light.
///
/// A region is cut across its longer side, measured on the sphere, where its energy falls into the
/// wanted shares; the energy of a texel is its luminance (red 0.2125, green 0.7154, blue 0.0721)
/// times its solid angle. The lights have the total energy of the map, but their illumination is
/// biased: each concentrates a region in one direction.
///
/// Building takes time and memory in proportion to the texels: 8 bytes each with
/// [`RegionSums::Table`]. The example [`median_cut`][1] draws regions and lights.
///
/// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/median_cut.rs
///
/// # Source
/// `[Debevec2005]`; regions are cut by shares instead of halves, so that any number of lights is of
/// equal energy.
#[derive(Clone, Debug)]
pub struct MedianCut {
    image: Image,
    map: SphereMap,
    energy: EnergyIndex,
}

/// A distant light that replaces a region of an environment map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MedianCutLight {
    /// The unit direction toward the light.
    pub direction: Vec3,
    /// Irradiance of a plane that faces the light, in W m^-2: the region's radiance times its solid
    /// angle.
    pub irradiance: Vec3,
    /// The region; the regions of all lights cover the map without overlap.
    pub region: TexelRegion,
}

/// Why an image cannot be cut into lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MedianCutError {
    /// An image that is to be an equal-area map is not square.
    NotSquare,
    /// The number of lights is 0.
    NoLights,
    /// A region has more light than single precision can hold.
    TooBright,
}

impl MedianCut {
    /// Prepares `image`, laid around the sphere as `map` says.
    ///
    /// # Errors
    /// When an equal-area image is not square.
    pub fn new(image: Image, map: SphereMap, sums: RegionSums) -> Result<Self, MedianCutError> {
        let [width, height] = image.size();
        if map == SphereMap::EqualArea && width != height {
            return Err(MedianCutError::NotSquare);
        }
        let energy = EnergyIndex::new(&image, map, sums);
        Ok(Self { image, map, energy })
    }

    /// At most `n` lights, by the rows and columns at which their regions begin.
    ///
    /// Energies differ, because a texel is never cut. There are fewer lights than `n` where fewer
    /// texels emit light, none for a black map, and a few less where [`RegionSums::Pyramid`] took a
    /// dark region for a lit one. Takes `O(n log(texels))` for the cuts and one pass over the
    /// texels.
    ///
    /// # Errors
    /// When `n` is 0, or a light would not be finite.
    pub fn lights(
        &self,
        n: usize,
        centroid: Centroid,
    ) -> Result<Vec<MedianCutLight>, MedianCutError> {
        if n == 0 {
            return Err(MedianCutError::NoLights);
        }
        let mut regions = self.regions(n);
        regions.sort_unstable_by_key(|region| (region.min[1], region.min[0]));
        let lights = regions
            .into_iter()
            .filter_map(|region| self.light(region, centroid));
        lights
            .map(|light| {
                let is_finite = light.irradiance.is_finite();
                is_finite.then_some(light).ok_or(MedianCutError::TooBright)
            })
            .collect()
    }

    /// At most `n` regions of equal energy that cover the map; none if it is black.
    fn regions(&self, n: usize) -> Vec<TexelRegion> {
        let whole = TexelRegion::whole(self.image.size());
        let energy = self.energy.of(&whole, &whole);
        let mut open = vec![(
            Piece {
                energy,
                region: whole,
            },
            n,
        )];
        let mut pieces = BinaryHeap::new();
        let mut single = Vec::new();
        if !(energy > 0.0) {
            return single;
        }

        // Distributes the lights in proportion to the energies of both sides of each cut.
        while let Some((piece, n)) = open.pop() {
            if n == 1 {
                pieces.push(piece);
                continue;
            }
            let Some([a, b]) = self.cut(&piece, (n / 2) as f64 / n as f64) else {
                single.push(piece.region);
                continue;
            };
            let for_a = share(n, a.energy / (a.energy + b.energy));
            open.extend([(a, for_a), (b, n - for_a)]);
        }

        // Gives lights that a single bright texel cannot use to the regions of most energy.
        while pieces.len() + single.len() < n {
            let Some(piece) = pieces.pop() else { break };
            match self.cut(&piece, 0.5) {
                Some(parts) => pieces.extend(parts),
                None => single.push(piece.region),
            }
        }
        single.extend(pieces.into_iter().map(|piece| piece.region));
        single
    }

    /// Both parts of a piece, cut so that the first has about `share` of the energy; `None` if only
    /// one texel emits light.
    fn cut(&self, piece: &Piece, share: f64) -> Option<[Piece; 2]> {
        let [width, height] = piece.region.sides(self.map, self.image.size());
        let axes = if width >= height { [0, 1] } else { [1, 0] };
        axes.into_iter()
            .find_map(|axis| self.cut_along(piece, axis, share))
    }

    fn cut_along(&self, piece: &Piece, axis: usize, share: f64) -> Option<[Piece; 2]> {
        let of = &piece.region;
        let (start, end) = (of.min[axis], of.max[axis]);
        let target = share * piece.energy;
        let energy_before = |at: u32| self.energy.of(&of.parts(axis, at)[0], of);

        // The first place with enough energy before it.
        let (mut low, mut high) = (start + 1, end);
        while low < high {
            let middle = low + (high - low) / 2;
            if energy_before(middle) >= target {
                high = middle;
            } else {
                low = middle + 1;
            }
        }

        // That one or the one before, whichever is closer and leaves no side dark.
        [low - 1, low]
            .into_iter()
            .filter(|&at| start < at && at < end)
            .map(|at| {
                of.parts(axis, at).map(|region| Piece {
                    energy: self.energy.of(&region, of),
                    region,
                })
            })
            .filter(|parts| parts.iter().all(|part| part.energy > 0.0))
            .min_by(|[a, _], [b, _]| {
                let off = |part: &Piece| (part.energy - target).abs();
                off(a).total_cmp(&off(b))
            })
    }

    /// The light of a region; `None` if it is dark.
    fn light(&self, region: TexelRegion, centroid: Centroid) -> Option<MedianCutLight> {
        let mut sum = RegionSum::new(centroid);
        for y in region.min[1]..region.max[1] {
            let solid_angle = texel_solid_angle(self.map, self.image.size(), y);
            for x in region.min[0]..region.max[0] {
                let direction = || region::center(self.map, self.image.size(), [x, y]);
                sum.add(self.image.texel(x, y), solid_angle, direction);
            }
        }
        let irradiance = sum.irradiance();
        (irradiance != Vec3::ZERO).then(|| MedianCutLight {
            direction: sum
                .direction()
                .unwrap_or_else(|| region.direction(self.map, self.image.size())),
            irradiance,
            region,
        })
    }
}

/// A region that is still to be cut; ordered by energy.
#[derive(Clone, Copy, Debug)]
struct Piece {
    energy: f64,
    region: TexelRegion,
}

impl Ord for Piece {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_energy = self.energy.total_cmp(&other.energy);
        by_energy.then_with(|| self.region.min.cmp(&other.region.min))
    }
}

impl PartialOrd for Piece {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Piece {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Piece {}

impl From<MedianCutLight> for DistantLightDesc<Rgb> {
    fn from(light: MedianCutLight) -> Self {
        Self {
            direction: light.direction,
            emission: light.irradiance,
            amount: IrradianceAmount::default(),
        }
    }
}

impl fmt::Display for MedianCutError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotSquare => "an equal-area image must be square",
            Self::NoLights => "the number of lights must be at least 1",
            Self::TooBright => "a region has more light than single precision can hold",
        })
    }
}

impl Error for MedianCutError {}

/// How many of `n` lights, at least 2, go to a side with the given fraction of energy: at least one
/// to each side.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between 0 and n"
)]
fn share(n: usize, fraction: f64) -> usize {
    ((n as f64 * fraction + 0.5) as usize).clamp(1, n - 1)
}

#[cfg(test)]
mod tests;
