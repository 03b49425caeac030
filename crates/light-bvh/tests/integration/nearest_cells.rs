//! Places whose own fine cell is not in a table use the nearest one that is.

use light_bvh::light_bounds::{LightId, LightSampleContext, glam::Vec3};
use light_bvh::visibility::{CellFactors, CellKey, CellTable, CoarseCell, FillOptions, FineCell};

use crate::support::two_rooms::Rooms;

/// The size of coarse cells.
const SIZE: f32 = 1.0;

/// The coarse cell at a point of the floor that sees both rooms, and some of its fine cells: those
/// for which `keeps` returns true.
struct Cells {
    rooms: Rooms,
    coarse: CoarseCell,
    fine: Vec<FineCell>,
    table: CellTable,
}

/// Points of the floor in one coarse cell, and a little around it.
fn points() -> impl Iterator<Item = LightSampleContext> {
    let start = Rooms::receivers().nth(210).expect("one of 400");
    let step = |i: u8| f32::from(i) * SIZE / 40.0;
    (0..60).flat_map(move |x| {
        (0..60).map(move |y| Rooms::floor(start + Vec3::new(step(x), step(y), 0.0)))
    })
}

impl Cells {
    fn new(keeps: impl Fn(usize) -> bool) -> Self {
        let rooms = Rooms::new(300, true);
        let options = FillOptions {
            exploring_rays: 1000,
            guided_rays: 100,
            ..FillOptions::default()
        };
        let view = rooms.tree.view();
        let middle = points().nth(30 * 60 + 30).expect("of 3600");
        let key = CellKey::fine(&middle, SIZE).coarse();
        let see = |at: &LightSampleContext, light: LightId, _| Some(rooms.sees(at.p, light));
        let coarse = CoarseCell::fill(view, key, &Rooms::places(key, 64), &options, see);
        let mut keys: Vec<_> = points().map(|ctx| CellKey::fine(&ctx, SIZE)).collect();
        keys.retain(|fine| fine.coarse() == key);
        keys.sort_unstable();
        keys.dedup();
        let kept = keys.iter().enumerate().filter(|(i, _)| keeps(*i));
        let fill = |(_, &key): (usize, &CellKey)| {
            coarse.fill_fine(view, key, &Rooms::places(key, 16), &options, see)
        };
        let fine: Vec<_> = kept.map(fill).collect();
        let table =
            CellTable::new(core::slice::from_ref(&coarse), &fine).expect("cells of one another");
        Self {
            rooms,
            coarse,
            fine,
            table,
        }
    }

    /// The factors of the first of `keys` that has a fine cell.
    fn first_of(&self, keys: &[CellKey]) -> Option<CellFactors<'_>> {
        let cell = |key: &CellKey| self.fine.iter().find(|cell| cell.key() == *key);
        Some(keys.iter().find_map(cell)?.factors(&self.coarse))
    }
}

/// Every third fine cell is there: which of them a point uses is found by going through them all.
#[test]
fn the_nearest_fine_cell_takes_the_place_of_one_that_is_not_there() {
    let cells = Cells::new(|i| i % 3 == 0);
    let [mut own, mut near, mut of_coarse, mut plain] = [0; 4];
    for ctx in points() {
        let key = CellKey::fine(&ctx, SIZE);
        let neighbours = CellKey::nearest_neighbours(&ctx, SIZE);
        let found = cells.table.view().nearest_factors(&ctx, SIZE);
        let (count, expected) = if let Some(factors) = cells.first_of(&[key]) {
            (&mut own, factors)
        } else if key.coarse() != cells.coarse.key() {
            (&mut plain, CellFactors::PLAIN)
        } else if let Some(factors) = cells.first_of(&neighbours) {
            (&mut near, factors)
        } else {
            (&mut of_coarse, cells.coarse.factors())
        };
        *count += 1;
        assert_eq!(found.factors(), expected.factors(), "{ctx:?}");
        assert_eq!(found.shape(), expected.shape(), "{ctx:?}");
    }
    for count in [own, near, of_coarse, plain] {
        assert!(
            count > 20,
            "{own} own, {near} near, {of_coarse} coarse, {plain} plain"
        );
    }
}

/// A sample and a query at one place use the same cell.
#[test]
fn sampled_pmfs_are_queried_ones_at_places_without_a_fine_cell() {
    let cells = Cells::new(|i| i % 3 == 0);
    let tree = cells.rooms.tree.view();
    for (i, ctx) in points().enumerate() {
        let at = |ctx| tree.in_cell(cells.table.view().nearest_factors(ctx, SIZE));
        let u = (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let chosen = at(&ctx).sample(&ctx, u).expect("lamps shine on the floor");
        let queried = at(&ctx).pmf(&ctx, chosen.light);
        assert_eq!(chosen.pmf.to_bits(), queried.to_bits(), "{ctx:?}");
    }
}
