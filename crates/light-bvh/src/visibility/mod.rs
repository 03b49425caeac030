//! Visibility of lights in cells of space: within a cell, a tree prefers the lights that are seen
//! from it. The factors are a pure function of the place.
//!
//! A [`CellKey`] is a quantised position, the side that a surface faces, and a size. Its cell holds
//! a copy of the top of the tree, with one byte a child that multiplies the child's importance:
//! [`CellFactors`]. [`LightBvhRef::in_cell`](crate::LightBvhRef::in_cell) uses them in queries;
//! below the copy the tree decides alone. Every light that can contribute keeps a probability above
//! 0, and the probability of a sample has the bits of the queried one.
//!
//! Cells are filled by rays of the caller. A [`CoarseCell`] learns which groups of lights are seen
//! from it, and opens those that are seen in part. A [`FineCell`], eight times smaller, tests the
//! groups whose visibility the rays of the coarse cell leave open. Random numbers depend on the key only:
//! every thread that fills a cell makes the same bytes. Where nothing blocks the rays, a cell
//! becomes plain after 48 of them. A [`CellTable`] holds all cells in flat slices; [`CellTableRef`]
//! looks them up without an allocator, and finds the nearest fine cell where a place has none.
//!
//! ```
//! # #[cfg(feature = "alloc")] {
//! use light_bvh::LightBvh;
//! use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
//! use light_bvh::light_bounds::{LightBounds, LightExtent, LightId, LightSampleContext};
//! use light_bvh::visibility::{CellKey, CellTable, CoarseCell, FillOptions};
//!
//! // Lamps in a row, and a wall in the middle that hides every lamp beyond it.
//! let lamp = |i: u16| LightBounds {
//!     bounds: Aabb::from_point(Vec3::new(f32::from(i), 0.0, 3.0)),
//!     w: Vec3::NEG_Z,
//!     phi: 60.0,
//!     cos_theta_o: 1.0,
//!     cos_theta_e: 0.0,
//!     two_sided: false,
//! };
//! let lights: Vec<_> = (0..100).map(|i| LightExtent::Bounded(lamp(i))).collect();
//! let tree = LightBvh::build(&lights).expect("valid lights");
//! let visible = |p: Vec3, light: LightId| (p.x < 50.0) == (light.0 < 50);
//!
//! let floor = |x| LightSampleContext::surface(Vec3::X * x, Vec3::Z, Vec3::Z);
//! let places: Vec<_> = (0..64).map(|i| floor(48.5 + i as f32 / 64.0)).collect();
//! let (here, coarse_size) = (floor(49.0), 2.0);
//! let key = CellKey::fine(&here, coarse_size);
//! let options = FillOptions::default();
//! let see = |place: &LightSampleContext, light, _| Some(visible(place.p, light));
//! let coarse = CoarseCell::fill(tree.view(), key.coarse(), &places, &options, see);
//! let fine = coarse.fill_fine(tree.view(), key, &places[..16], &options, see);
//! let table = CellTable::new(&[coarse], &[fine]).expect("the fine cell is in the coarse one");
//!
//! let within = tree.view().in_cell(table.view().factors(key));
//! let (hidden, seen) = (LightId(50), LightId(48));
//! assert!(within.pmf(&here, hidden) < 0.2 * tree.pmf(&here, hidden));
//! assert!(within.pmf(&here, seen) > 1.1 * tree.pmf(&here, seen));
//! # }
//! ```
//!
//! # Costs
//!
//! With the deepest copy a sample takes a hundredth more instructions than one of the tree, and a
//! pmf a fifth more (`cargo xtask counts`); looking a cell up is a hash and a few loads. By default
//! a coarse cell takes 22,048 rays and a fine one at most 192, and 10 to 30 in these: the relative
//! variance V of one choice in a room with one door to a second room, which has most lamps and the
//! brightest (mean of 400 points; cells of an eighth of the room):
//!
//! | lamps | V, tree | coarse cells | fine cells | tree that knows visibility |
//! | --- | --- | --- | --- | --- |
//! | 100 | 2.03 | 0.20 | 0.13 | 0.03 |
//! | 3000 | 4.12 | 0.43 | 0.36 | 0.03 |
//!
//! # What moves
//!
//! A cell belongs to one tree: a new build needs new cells. The copies of a cell also fit the tree
//! after a refit, and old cells lose no light, but they describe the old places of the lights. V of
//! 300 lamps in such rooms that all move, with cells of fewer rays:
//!
//! | step | V, tree | old cells | cells filled again |
//! | --- | --- | --- | --- |
//! | 0.1 m | 3.30 | 0.45 | 0.41 |
//! | 0.4 m | 2.78 | 1.10 | 0.36 |
//! | 1.6 m, many through the wall | 0.54 | 2.92 | 0.17 |
//!
//! One lamp that moves by a centimetre changes the weights by which nearly all cells choose their
//! rays: of 400 fine cells none keeps its bytes among 300 lamps, and 20 do among 3,000. So cells
//! that must be a function of the scene are all filled again after a refit. Where geometry moves and
//! places do not, a cell keeps its bytes if none of its rays meets the old or the new place of what
//! moves. `visible` gets every ray, and so can note the other cells; a fine cell is filled again
//! with its coarse one.
//!
//! # Storage
//!
//! Any cell may be dropped at any time, and has the same bytes when it is filled again. The arrays
//! of a table are plain data (feature `bytemuck`); [`CellTableRef::new`] checks arrays of a file
//! against the tree.
//!
//! # Limits
//!
//! A light that is seen from a corner of a cell only may be missed by all rays of the cell: it keeps
//! about [`FillOptions::floor`] of its probability, and is noisy. Visibility that changes within a
//! fine cell, as behind the bars of a grille, cannot be learnt; [`FillOptions::least_gain`] detects
//! that. Visibility is 0 or 1; the caller decides how transmittance counts. The caller chooses the
//! size of the cells, which cells are made, and the places in them. For pictures that depend on the
//! scene alone, these choices must depend on the scene alone.
//!
//! # Source
//!
//! Keys by hashed positions and normals: `[Binder2019]`. Contributions of clusters of lights,
//! learnt by region with a prior for few observations: `[Vevoda2018]`. Choices in proportion to the
//! root of a second moment: `[Rath2020]`. Probabilities learnt for the nodes of a light tree, by
//! cells: `[Pantaleoni2019]`. Two levels, factors in bytes on the importance of the tree, and cells
//! that depend on their key alone are this crate's.

mod at_cell;
mod cell_factors;
mod cell_key;
mod factor_code;
#[cfg(feature = "alloc")]
mod fill;
mod hash;
mod in_cell;
mod multiply;
mod table_error;
mod table_ref;
mod walk;
mod way;

pub use at_cell::LightBvhInCellAt;
pub use cell_factors::{CellFactors, CellFactorsError, CopiedNode, MAX_COPIED_NODES};
pub use cell_key::CellKey;
pub use factor_code::{decode_factor, encode_factor};
#[cfg(feature = "alloc")]
pub use fill::{CellTable, CoarseCell, FillOptions, FineCell};
pub use in_cell::LightBvhInCell;
pub use table_error::CellTableError;
pub use table_ref::{CellEntry, CellTableParts, CellTableRef};
