use alloc::vec::Vec;

use super::centroid::luminance;
use super::pyramid::EnergyPyramid;
use super::region::{TexelRegion, texel_solid_angle};
use crate::image::Image;
use light_math::SphereMap;
use light_math::distribution::SummedAreaTable;

/// How the energy of a region is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum RegionSums {
    /// Exactly, from a summed-area table: 8 bytes a texel.
    #[default]
    Table,
    /// Approximately, from an image pyramid: 16 bytes for every three texels, and faster to
    /// prepare.
    Pyramid,
}

/// The energy of regions of a map, up to a common factor.
#[derive(Clone, Debug)]
pub(super) enum EnergyIndex {
    Table(SummedAreaTable<Vec<u64>>),
    Pyramid(EnergyPyramid),
    /// The map is black.
    Black,
}

impl EnergyIndex {
    pub(super) fn new(image: &Image, map: SphereMap, sums: RegionSums) -> Self {
        let [width, height] = image.size();
        let mut weights: Vec<f32> = image.texels().map(luminance).collect();
        // Relative to the brightest, so that no product overflows.
        let most = weights.iter().copied().fold(0.0, f32::max);
        if !(most > 0.0) {
            return Self::Black;
        }
        for (y, row) in (0..height).zip(weights.chunks_exact_mut(width as usize)) {
            let solid_angle = texel_solid_angle(map, [width, height], y);
            row.iter_mut()
                .for_each(|weight| *weight = *weight / most * solid_angle);
        }
        match sums {
            RegionSums::Pyramid => Self::Pyramid(EnergyPyramid::new(weights, image.size())),
            RegionSums::Table => SummedAreaTable::new(&weights, width as usize, height as usize)
                .map_or(Self::Black, Self::Table),
        }
    }

    /// The energy of `part`, which is a part of the region `of`: those of disjoint parts add up.
    pub(super) fn of(&self, part: &TexelRegion, of: &TexelRegion) -> f64 {
        match self {
            Self::Table(table) => {
                let range = |axis: usize| part.min[axis] as usize..part.max[axis] as usize;
                table.sum(range(0), range(1))
            }
            Self::Pyramid(pyramid) => pyramid.energy(part, pyramid.level_for(of)),
            Self::Black => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::channels::Channels;

    #[test]
    fn light_at_the_ends_of_the_range_counts() {
        for bright in [f32::MAX, f32::MIN_POSITIVE] {
            let image = Image::from_f32([2, 1], Channels::Gray, [0.0, bright]).expect("valid");
            for sums in [RegionSums::Table, RegionSums::Pyramid] {
                let energy = EnergyIndex::new(&image, SphereMap::LatLong, sums);
                let whole = TexelRegion::whole([2, 1]);
                let [dark, lit] = whole.parts(0, 1).map(|part| energy.of(&part, &whole));
                assert!(dark == 0.0 && lit > 0.0 && lit.is_finite(), "{bright}");
            }
        }
    }
}
