//! A list of lights for each tile of the picture.

use core::f32::consts::PI;

use light_gpu::light_sources::light_bounds::LightExtent;
use light_gpu::light_sources::{LightSet, Rgb};
use light_math::Aabb;
use light_math::glam::Vec3;

use crate::surface::is_surface;

/// The edge of a tile in pixels.
const TILE: u32 = 16;

/// Rows of lists.
#[derive(Default)]
pub struct Tiles {
    /// Tiles of a row of the picture.
    pub columns: u32,
    /// First entry and length of the list of each tile.
    pub tiles: Vec<[u32; 4]>,
    /// Four entries a row.
    pub entries: Vec<[u32; 4]>,
}

impl Tiles {
    /// The mean length of a list.
    pub fn mean_length(&self) -> f32 {
        self.tiles.iter().map(|tile| tile[1] as f32).sum::<f32>() / self.tiles.len() as f32
    }
}

/// The lights within whose range the surfaces of a tile are. The range of a light ends where its
/// irradiance, were it a point that emits evenly, is `least`; those at infinity reach everywhere.
///
/// The surfaces of a tile are bounded by a box, which is closer than the tiles and depths of
/// `[Olsson2012]`.
pub fn tiles(lights: &LightSet<Rgb>, pixels: &[[f32; 16]], size: [u32; 2], least: f32) -> Tiles {
    let extents = lights.extents();
    let [width, height] = size;
    let columns = width.div_ceil(TILE);
    let (mut tiles, mut entries) = (Vec::new(), Vec::new());
    for tile in 0..columns * height.div_ceil(TILE) {
        let surfaces = (0..TILE * TILE).filter_map(|i| {
            let x = tile % columns * TILE + i % TILE;
            let y = tile / columns * TILE + i / TILE;
            let pixel = pixels.get((y * width + x) as usize).filter(|_| x < width)?;
            is_surface(pixel).then(|| Vec3::from_slice(pixel))
        });
        let first = entries.len() as u32;
        if let Some(surfaces) = surfaces.map(Aabb::from_point).reduce(Aabb::union) {
            let is_near = |&(_, extent): &(u32, &LightExtent)| reaches(extent, &surfaces, least);
            entries.extend((0..).zip(&extents).filter(is_near).map(|(light, _)| light));
        }
        tiles.push([first, entries.len() as u32 - first, 0, 0]);
    }
    entries.resize(entries.len().next_multiple_of(4), 0);
    let entries = entries.chunks_exact(4).map(|row| [row[0], row[1], row[2], row[3]]);
    Tiles { columns, tiles, entries: entries.collect() }
}

fn reaches(extent: &LightExtent, surfaces: &Aabb, least: f32) -> bool {
    match extent {
        LightExtent::Bounded(light) => {
            let center = light.bounds.center();
            let nearest = center.clamp(surfaces.min, surfaces.max);
            light.phi >= 4.0 * PI * least * center.distance_squared(nearest)
        }
        LightExtent::Infinite(_) => true,
        _ => false,
    }
}
