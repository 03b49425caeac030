//! Tables of cells: cells that do not fit each other, and arrays that are no table, are refused.

use light_bvh::light_bounds::{LightId, LightSampleContext, glam::Vec3};
use light_bvh::visibility::{
    CellEntry, CellKey, CellTable, CellTableError, CellTableParts, CellTableRef, CoarseCell,
    CopiedNode, FillOptions, FineCell,
};

use crate::support::two_rooms::Rooms;

/// Cells of a few places in a row, of which the first is plain.
fn cells(rooms: &Rooms) -> (Vec<CoarseCell>, Vec<FineCell>) {
    let options = FillOptions {
        exploring_rays: 400,
        guided_rays: 50,
        ..FillOptions::default()
    };
    let (mut coarse, mut fine): (Vec<CoarseCell>, Vec<FineCell>) = Default::default();
    for p in Rooms::receivers().take(20) {
        let key = CellKey::fine(&Rooms::floor(p), 1.0);
        if !coarse.iter().any(|cell| cell.key() == key.coarse()) {
            let places = Rooms::places(key.coarse(), 32);
            let is_plain = coarse.is_empty();
            let see = |p: Vec3, light| Some(is_plain || rooms.sees(p, light));
            let (view, key) = (rooms.tree.view(), key.coarse());
            let cell = CoarseCell::fill(view, key, &places, &options, |at, l, _| see(at.p, l));
            coarse.push(cell);
        }
        let of = coarse.last().expect("just made");
        let places = Rooms::places(key, 16);
        let visible = |at: &LightSampleContext, light, _| Some(rooms.sees(at.p, light));
        fine.push(of.fill_fine(rooms.tree.view(), key, &places, &options, visible));
    }
    (coarse, fine)
}

#[test]
fn cells_that_do_not_fit_make_no_table() {
    let rooms = Rooms::new(300, true);
    let (coarse, fine) = cells(&rooms);
    assert!(coarse[0].is_plain() && !coarse[1].is_plain(), "{coarse:?}");
    assert!(CellTable::new(&coarse, &fine).is_ok(), "a table");
    assert!(CellTable::new(&[], &[]).is_ok(), "no cell");
    let key = coarse[3].key();
    let twice: Vec<_> = coarse.iter().chain(&coarse[3..4]).cloned().collect();
    let found = CellTable::new(&twice, &fine);
    assert_eq!(found, Err(CellTableError::Twice { key }), "coarse");
    let key = fine[5].key();
    let again: Vec<_> = fine.iter().chain(&fine[5..6]).cloned().collect();
    let found = CellTable::new(&coarse, &again);
    assert_eq!(found, Err(CellTableError::Twice { key }), "fine");
    let without: Vec<_> = fine
        .iter()
        .filter(|f| f.key().coarse() == coarse[1].key())
        .collect();
    let found = CellTable::new(&coarse[2..], &[without[0].clone()]);
    let key = without[0].key();
    assert_eq!(found, Err(CellTableError::NoCoarseCell { key }), "missing");
    let plain = [CoarseCell::plain(coarse[1].key())];
    let found = CellTable::new(&plain, &[without[0].clone()]);
    assert_eq!(
        found,
        Err(CellTableError::NoCoarseCell { key }),
        "of another"
    );
}

/// The arrays of a table, to be damaged.
#[derive(Clone)]
struct Arrays {
    keys: Vec<CellKey>,
    entries: Vec<CellEntry>,
    starts: Vec<u32>,
    shapes: Vec<CopiedNode>,
    factors: Vec<[u8; 16]>,
}

impl Arrays {
    fn of(parts: CellTableParts<'_>) -> Self {
        Self {
            keys: parts.keys.to_vec(),
            entries: parts.entries.to_vec(),
            starts: parts.starts.to_vec(),
            shapes: parts.shapes.to_vec(),
            factors: parts.factors.to_vec(),
        }
    }

    /// What a damage makes of them.
    fn check(&self, rooms: &Rooms, damage: impl FnOnce(&mut Self)) -> Result<(), CellTableError> {
        let mut damaged = self.clone();
        damage(&mut damaged);
        damaged.table(rooms).map(|_| ())
    }

    fn table(&self, rooms: &Rooms) -> Result<CellTableRef<'_>, CellTableError> {
        let parts = CellTableParts {
            keys: &self.keys,
            entries: &self.entries,
            starts: &self.starts,
            shapes: &self.shapes,
            factors: &self.factors,
        };
        CellTableRef::new(&rooms.tree.view(), parts)
    }

    /// The arrays with each bit changed once, but for those of keys.
    fn each_damage(&self) -> impl Iterator<Item = Self> + '_ {
        let bits = |count: usize, width: usize| {
            (0..count).flat_map(move |at| (0..width).map(move |bit| (at, bit)))
        };
        let of = |damage: &dyn Fn(&mut Self)| {
            let mut damaged = self.clone();
            damage(&mut damaged);
            damaged
        };
        let entries = bits(self.entries.len(), 96).map(move |(at, bit)| {
            of(&|t| {
                let CellEntry {
                    shape,
                    factors,
                    nodes,
                } = &mut t.entries[at];
                *[shape, factors, nodes][bit / 32] ^= 1 << (bit % 32);
            })
        });
        let starts =
            bits(self.starts.len(), 32).map(move |(at, bit)| of(&|t| t.starts[at] ^= 1 << bit));
        let shapes = bits(self.shapes.len(), 32).map(move |(at, bit)| {
            of(&|t| {
                let CopiedNode { opened, first } = &mut t.shapes[at];
                *[opened, first][bit / 16] ^= 1 << (bit % 16);
            })
        });
        let factors = bits(16 * self.factors.len(), 8)
            .map(move |(at, bit)| of(&|t| t.factors[at / 16][at % 16] ^= 1 << bit));
        entries.chain(starts).chain(shapes).chain(factors)
    }
}

/// What a file of bytes holds.
#[cfg(feature = "bytemuck")]
fn read_back<T: bytemuck::Pod>(values: &[T]) -> Vec<T> {
    let file: Vec<u8> = bytemuck::cast_slice(values).to_vec();
    bytemuck::pod_collect_to_vec(&file)
}

#[test]
#[cfg(feature = "bytemuck")]
fn a_table_is_read_back_from_bytes() {
    let rooms = Rooms::new(100, true);
    let (coarse, fine) = cells(&rooms);
    let table = CellTable::new(&coarse, &fine).expect("cells");
    let parts = table.view().parts();
    let arrays = Arrays {
        keys: read_back(parts.keys),
        entries: read_back(parts.entries),
        starts: read_back(parts.starts),
        shapes: read_back(parts.shapes),
        factors: read_back(parts.factors),
    };
    let read = arrays.table(&rooms).expect("the table");
    assert_eq!(read.parts(), parts, "the same arrays");
}

#[test]
fn arrays_that_are_no_table_are_refused() {
    let rooms = Rooms::new(300, true);
    let (coarse, fine) = cells(&rooms);
    let table = CellTable::new(&coarse, &fine).expect("a table");
    let whole = Arrays::of(table.view().parts());
    assert_eq!(whole.check(&rooms, |_| ()), Ok(()), "a table");
    let cells = 32 * whole.keys.len() + 4;
    let nodes = 4 * whole.shapes.len() + 16 * whole.factors.len();
    assert_eq!(table.bytes(), cells + nodes, "bytes of all arrays");
    let refused = |error, damage: &dyn Fn(&mut Arrays)| {
        assert_eq!(whole.check(&rooms, damage), Err(error), "damaged");
    };
    refused(CellTableError::Lengths, &|t| t.entries.truncate(3));
    refused(CellTableError::Lengths, &|t| t.starts.truncate(3));
    refused(CellTableError::Links, &|t| t.shapes.truncate(3));
    refused(CellTableError::Links, &|t| t.factors.truncate(3));
    for k in 0..whole.starts.len() {
        refused(CellTableError::Order, &|t| t.starts[k] ^= 1);
    }
    for k in 1..whole.keys.len() {
        refused(CellTableError::Order, &|t| t.keys.swap(k - 1, k));
        refused(CellTableError::Order, &|t| t.keys[k] = t.keys[k - 1]);
    }
    let last = whole.factors.len() - 1;
    refused(CellTableError::Factor, &|t| t.factors[last][3] = 7);
    for (k, entry) in whole.entries.iter().enumerate() {
        if entry.nodes > 0 {
            refused(CellTableError::Links, &|t| t.entries[k].nodes += 1);
            refused(CellTableError::Links, &|t| t.entries[k].shape = u32::MAX);
            refused(CellTableError::Links, &|t| t.entries[k].factors = u32::MAX);
        }
    }
    let other = Rooms::new(5, true);
    assert_eq!(
        whole.check(&other, |_| ()),
        Err(CellTableError::Links),
        "another tree"
    );
}

/// What passes, for a bit of a factor or of a link makes another table, loses no light, and its
/// samples have the probabilities of queries.
#[test]
fn tables_with_a_changed_bit_are_refused_or_obey_the_laws() {
    let rooms = Rooms::new(60, true);
    let (mut coarse, mut fine) = cells(&rooms);
    coarse.truncate(4);
    fine.retain(|cell| coarse.iter().any(|of| of.key() == cell.key().coarse()));
    fine.truncate(6);
    let table = CellTable::new(&coarse, &fine).expect("a table");
    let whole = Arrays::of(table.view().parts());
    let ctx = Rooms::floor(Vec3::new(0.4, 0.3, 0.0));
    let view = rooms.tree.view();
    let reached = |pmf: &dyn Fn(LightId) -> f32| -> Vec<bool> {
        (0..60).map(|id| pmf(LightId(id)) > 0.0).collect()
    };
    let expected = reached(&|light| view.pmf(&ctx, light));
    let (mut passed, mut refused) = (0, 0);
    for damaged in whole.each_damage() {
        let Ok(table) = damaged.table(&rooms) else {
            refused += 1;
            continue;
        };
        passed += 1;
        let key = whole.keys[passed % whole.keys.len()];
        let within = view.in_cell(table.factors(key));
        assert_eq!(
            reached(&|light| within.pmf(&ctx, light)),
            expected,
            "{key:?}"
        );
        for u in [0, 0x5b3a_91c7 << 32, u64::MAX] {
            if let Some(chosen) = within.sample(&ctx, u) {
                assert_eq!(chosen.pmf, within.pmf(&ctx, chosen.light), "{key:?}");
            }
        }
    }
    assert!(
        passed > 100 && refused > 1000,
        "{passed} pass, {refused} do not"
    );
}
