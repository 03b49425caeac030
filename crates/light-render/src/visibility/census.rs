use core::borrow::Borrow;

use lights::bounds::{LightId, LightSampleContext};
use lights::bvh::visibility::CellKey;
use lights::glam::{Vec2, Vec3};
use lights::sources::shape::Shape;
use lights::sources::{AreaLight, LightRef, PdfCoverage};
use rayon::prelude::*;

use super::cell_size::CellSize;
use super::film_point::FilmPoint;
use crate::bsdf::Scattering;
use crate::{Surface, View, World};

/// Bytes that the census takes at most for each pixel of the whole picture.
pub(super) const MAX_BYTES_PER_PIXEL: u64 =
    (size_of::<Option<CellKey>>() + FilmPoint::QUARTERS * size_of::<Sighting>()) as u64;

/// A point of the picture, and the cell of the surface that it shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Sighting {
    pub(super) coarse: CellKey,
    pub(super) fine: CellKey,
    pub(super) point: FilmPoint,
}

/// How many pixels show these sightings.
pub(super) fn pixels(sightings: &[Sighting]) -> f32 {
    quarters(sightings) as f32 / FilmPoint::QUARTERS as f32
}

/// How many quarters of pixels show these sightings.
pub(super) fn quarters(sightings: &[Sighting]) -> usize {
    let quarters = sightings.iter().map(|sighting| sighting.point.quarters());
    quarters.sum()
}

/// A point that a pixel shows, and the receiver there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) surface: Surface,
    pub(super) ctx: LightSampleContext,
}

impl Place {
    /// Whether the point of `light` that `u` chooses is visible from here; `None` if it emits
    /// nothing toward this place.
    pub(super) fn sees(&self, world: &World, light: LightId, u: Vec2) -> Option<bool> {
        let Self { surface, ctx } = self;
        let (wi, p_light) = match world.lights().get(light)? {
            // By area: to choose a point by solid angle takes as long as the ray.
            LightRef::Triangle(light) => {
                let at = light.shape().sample(u)?.at;
                let wi = (at.p - ctx.p).try_normalize()?;
                (light.l(&at, -wi, &()) != Vec3::ZERO).then_some((wi, at.p))?
            }
            _ => {
                let sample = world.sample_light(light, ctx, u, PdfCoverage::Complete)?;
                (sample.l != Vec3::ZERO).then_some((sample.wi, sample.p_light))?
            }
        };
        Some(!world.occluded(surface, wi, p_light))
    }
}

impl Borrow<LightSampleContext> for Place {
    fn borrow(&self) -> &LightSampleContext {
        &self.ctx
    }
}

/// The cells that the camera sees, in the order of coarse cells, fine cells and pixels: by one ray
/// through the middle of each pixel of the whole picture, or through the middles of its quarters
/// where it shows something else than a pixel beside it.
///
/// Not of the part that is rendered: a pixel has the same cells in a picture and in its parts.
pub(super) fn take(world: &World, view: &View, size: &CellSize) -> Vec<Sighting> {
    let (width, height) = view.resolution();
    let cell = |point| Some(size.fine_key(place(world, view, point)?.borrow()));
    let pixels = 0..width * height;
    let cells: Vec<Option<CellKey>> = (pixels.clone().into_par_iter())
        .map(|pixel| cell(FilmPoint::of_pixel(pixel)))
        .collect();
    let sighting = |(point, fine): (FilmPoint, Option<CellKey>)| {
        let fine = fine?;
        let coarse = fine.coarse();
        Some(Sighting {
            coarse,
            fine,
            point,
        })
    };
    let mut sightings: Vec<_> = pixels
        .into_par_iter()
        .flat_map_iter(|pixel| {
            let own = cells[pixel as usize];
            let mut beside = neighbours(pixel, (width, height)).map(|i| cells[i]);
            let is_edge = beside.any(|other| !may_be_one_surface(own, other));
            let quarters = is_edge.then(|| FilmPoint::quarters_of(pixel).map(|at| (at, cell(at))));
            let whole = (!is_edge).then(|| (FilmPoint::of_pixel(pixel), own));
            quarters.into_iter().flatten().chain(whole)
        })
        .filter_map(sighting)
        .collect();
    sightings.par_sort_unstable();
    sightings
}

/// The up to four pixels that share an edge with this one.
fn neighbours(pixel: u32, (width, height): (u32, u32)) -> impl Iterator<Item = usize> {
    let (x, y) = (pixel % width, pixel / width);
    let left = (x > 0).then(|| pixel - 1);
    let right = (x + 1 < width).then(|| pixel + 1);
    let above = (y > 0).then(|| pixel - width);
    let below = (y + 1 < height).then(|| pixel + width);
    let all = [left, right, above, below].into_iter().flatten();
    all.map(|pixel| pixel as usize)
}

/// Whether two pixels beside each other may show one surface: their cells, if any, face the same
/// side and are near each other.
fn may_be_one_surface(a: Option<CellKey>, b: Option<CellKey>) -> bool {
    /// In fine cells, which are 2.5 pixels wide.
    const NEAR: f32 = 2.5;
    let (Some(a), Some(b)) = (a, b) else {
        return a == b;
    };
    let apart = (a.bounds().min - b.bounds().min).abs().max_element();
    a.facing() == b.facing() && a.size() == b.size() && apart < NEAR * a.size()
}

/// The first surface behind a point, and the receiver there; `None` if there is none, or a mirror.
pub(super) fn place(world: &World, view: &View, point: FilmPoint) -> Option<Place> {
    let (surface, scattering, wo) = camera_surface(world, view, point.pixel, point.at())?;
    let ctx = world.light_context(&surface, &scattering, wo);
    Some(Place { surface, ctx })
}

/// The first surface behind the point `at` of a pixel, how it scatters, and the direction to the
/// camera; `None` if there is none, or a mirror.
pub(super) fn camera_surface(
    world: &World,
    view: &View,
    pixel: u32,
    at: Vec2,
) -> Option<(Surface, Scattering, Vec3)> {
    let (width, _) = view.resolution();
    let corner = Vec2::new((pixel % width) as f32, (pixel / width) as f32);
    let ray = view.ray(corner + at, Vec2::splat(0.5));
    let surface = world.closest(&ray, None)?;
    let scattering = world.scattering(&surface);
    if scattering.bsdf().is_dirac() {
        return None;
    }
    Some((surface, scattering, -ray.direction))
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_scene::{BuiltinScene, OcclusionKind, OcclusionSize};

    /// How many of 96 x 64 pixels are looked at whole, and how many in quarters.
    fn counts(kind: OcclusionKind) -> [usize; 2] {
        let scene = BuiltinScene::Occlusion(kind, OcclusionSize::Small).load();
        let view = View::new(&scene.camera_or_default(), 96, 64).expect("a view");
        let world = World::new(scene).expect("a world");
        let mut sightings = take(&world, &view, &CellSize::of(&view));
        assert!(sightings.is_sorted(), "{kind}: by cells");
        sightings.sort_unstable_by_key(|sighting| sighting.point);
        let of_pixels = sightings.chunk_by(|a, b| a.point.pixel == b.point.pixel);
        let mut counts = [0; 2];
        for of_pixel in of_pixels {
            let quarters: usize = of_pixel.iter().map(|s| s.point.quarters()).sum();
            assert!(quarters <= FilmPoint::QUARTERS, "{kind}: {of_pixel:?}");
            counts[usize::from(quarters > of_pixel.len())] += 1;
            for Sighting {
                coarse,
                fine,
                point,
            } in of_pixel
            {
                let place = place(&world, &view, *point).expect("it was seen");
                let key = CellSize::of(&view).fine_key(place.borrow());
                assert_eq!((key, key.coarse()), (*fine, *coarse), "{kind}: {point:?}");
            }
        }
        let [in_quarters, whole] = counts;
        [whole, in_quarters]
    }

    /// In the open field they are lamps, the horizon, and the flat ground far away.
    #[test]
    fn the_census_looks_closer_at_edges() {
        let [open, trunks] = [OcclusionKind::Open, OcclusionKind::Trunks].map(|kind| {
            let [whole, in_quarters] = counts(kind).map(|count| count as f32);
            in_quarters / (whole + in_quarters)
        });
        assert!(open > 0.1 && open < 0.3, "{open} of the open field");
        assert!(trunks > 0.4 && trunks < 0.9, "{trunks} among trunks");
    }
}
