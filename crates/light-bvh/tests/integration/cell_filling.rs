//! Cells that are filled by rays: a pure function of the key that chooses lights that are seen.

use alloc::collections::BTreeMap;

use light_bvh::LightBvh;
use light_bvh::light_bounds::{LightId, LightSampleContext, glam::Vec3};
use light_bvh::visibility::{
    CellFactors, CellKey, CellTable, CellTableRef, CoarseCell, FillOptions, FineCell,
};

use crate::support::two_rooms::Rooms;

/// The size of coarse cells.
const SIZE: f32 = 1.0;

/// Filled cells, and the rays that they took.
struct Filled<'a> {
    rooms: &'a Rooms,
    options: FillOptions,
    coarse: BTreeMap<CellKey, CoarseCell>,
    fine: BTreeMap<CellKey, FineCell>,
    coarse_rays: usize,
    fine_rays: usize,
}

impl<'a> Filled<'a> {
    fn new(rooms: &'a Rooms, options: FillOptions) -> Self {
        Self {
            rooms,
            options,
            coarse: BTreeMap::new(),
            fine: BTreeMap::new(),
            coarse_rays: 0,
            fine_rays: 0,
        }
    }

    fn fill(&mut self, key: CellKey) {
        let (view, rooms, at) = (self.rooms.tree.view(), self.rooms, key.coarse());
        if !self.coarse.contains_key(&at) {
            let rays = &mut self.coarse_rays;
            let places = Rooms::places(at, 128);
            let cell = CoarseCell::fill(view, at, &places, &self.options, |place, light, _| {
                *rays += 1;
                Some(rooms.sees(place.p, light))
            });
            self.coarse.insert(at, cell);
        }
        if !self.fine.contains_key(&key) {
            let rays = &mut self.fine_rays;
            let places = Rooms::places(key, 16);
            let cell =
                self.coarse[&at].fill_fine(view, key, &places, &self.options, |place, light, _| {
                    *rays += 1;
                    Some(rooms.sees(place.p, light))
                });
            self.fine.insert(key, cell);
        }
    }

    /// Mean variances at the points asked: by the tree, coarse cells and fine cells, and by the
    /// tree where it knows what is seen.
    fn variances(&self) -> [f64; 4] {
        let (view, mut sums) = (self.rooms.tree.view(), [0.0; 4]);
        for p in Rooms::receivers() {
            let ctx = Rooms::floor(p);
            let key = CellKey::fine(&ctx, SIZE);
            let coarse = &self.coarse[&key.coarse()];
            let cells = [
                CellFactors::PLAIN,
                coarse.factors(),
                self.fine[&key].factors(coarse),
            ];
            for (sum, cell) in sums.iter_mut().zip(cells) {
                let within = view.in_cell(cell);
                *sum += variance(self.rooms, p, |light| within.pmf(&ctx, light)) / 400.0;
            }
            let seen: f32 = seen(self.rooms, p).map(|light| view.pmf(&ctx, light)).sum();
            sums[3] += variance(self.rooms, p, |light| view.pmf(&ctx, light) / seen) / 400.0;
        }
        sums
    }
}

/// The lamps that a point of the floor sees.
fn seen(rooms: &Rooms, p: Vec3) -> impl Iterator<Item = LightId> + use<'_> {
    let all = (0..).map(LightId).take(rooms.lamps.len());
    all.filter(move |&light| rooms.sees(p, light))
}

/// The relative variance of one choice at a point of the floor, all lamps tried.
fn variance(rooms: &Rooms, p: Vec3, pmf: impl Fn(LightId) -> f32) -> f64 {
    let (mut mean, mut moment) = (0.0, 0.0);
    for light in seen(rooms, p) {
        let (q, phi) = rooms.lamps[light.index()];
        let (height, dist_sq) = (f64::from(q.z - p.z), f64::from(q.distance_squared(p)));
        let arrives = f64::from(phi) * height * height / (dist_sq * dist_sq);
        mean += arrives;
        moment += arrives * arrives / f64::from(pmf(light));
    }
    moment / (mean * mean) - 1.0
}

fn keys() -> impl Iterator<Item = CellKey> {
    Rooms::receivers().map(|p| CellKey::fine(&Rooms::floor(p), SIZE))
}

#[test]
fn variance_falls_where_lights_are_behind_a_wall() {
    for lamps in [100, 3000] {
        let rooms = Rooms::new(lamps, true);
        let mut filled = Filled::new(&rooms, FillOptions::default());
        keys().for_each(|key| filled.fill(key));
        let [plain, coarse, fine, known] = filled.variances();
        println!(
            "{lamps} lamps: V {plain:.3}, coarse {coarse:.3}, fine {fine:.3}, at best {known:.3}; \
             rays: {} in {} coarse cells, {} in {} fine ones",
            filled.coarse_rays,
            filled.coarse.len(),
            filled.fine_rays,
            filled.fine.len()
        );
        assert!(coarse < 0.2 * plain, "coarse: {plain} to {coarse}");
        assert!(fine < coarse, "fine: {coarse} to {fine}");
        assert!(
            lamps > 100 || fine < 0.7 * coarse,
            "fine: {coarse} to {fine}"
        );
        let rays = filled.options.exploring_rays + 2 * filled.options.guided_rays;
        assert_eq!(
            filled.coarse_rays,
            rays as usize * filled.coarse.len(),
            "coarse"
        );
        let most = filled.options.fine_rays as usize * filled.fine.len();
        let share = filled.fine_rays as f32 / most as f32;
        assert!(share > 0.05 && share < 0.5, "{share} of the fine rays");
    }
}

/// Cells in any order, each twice, have the same bytes, and so has a table of them, which knows
/// what the cells know.
#[test]
fn filling_is_a_function_of_the_key() {
    let rooms = Rooms::new(100, true);
    let options = FillOptions {
        exploring_rays: 500,
        guided_rays: 100,
        ..FillOptions::default()
    };
    let [mut there, mut back] = [0; 2].map(|_| Filled::new(&rooms, options));
    let keys: Vec<_> = keys().collect();
    keys.iter().for_each(|&key| there.fill(key));
    keys.iter().rev().for_each(|&key| back.fill(key));
    assert_eq!(there.coarse, back.coarse, "coarse cells");
    assert_eq!(there.fine, back.fine, "fine cells");
    let coarse: Vec<_> = there.coarse.values().cloned().collect();
    let fine: Vec<_> = there.fine.values().cloned().collect();
    let table = CellTable::new(&coarse, &fine).expect("cells");
    let reversed = |cells: &[CoarseCell]| cells.iter().rev().cloned().collect::<Vec<_>>();
    let fine_reversed: Vec<_> = fine.iter().rev().cloned().collect();
    let other = CellTable::new(&reversed(&coarse), &fine_reversed).expect("cells");
    assert_eq!(table, other, "the same table");
    let view = rooms.tree.view();
    let checked = CellTableRef::new(&view, table.view().parts()).expect("a table");
    assert_eq!(checked.bytes(), table.bytes(), "bytes");
    for cell in &fine {
        let own = cell.factors(&there.coarse[&cell.key().coarse()]);
        let found = checked.factors(cell.key());
        assert_eq!(found.shape(), own.shape(), "{:?}", cell.key());
        assert_eq!(found.factors(), own.factors(), "{:?}", cell.key());
    }
    let aside = |p: Vec3| CellKey::fine(&Rooms::floor(p + Vec3::X * 0.17), SIZE);
    let unknown = Rooms::receivers().map(aside).find(|key| {
        let is_known = there.fine.contains_key(key);
        !is_known && there.coarse.contains_key(&key.coarse())
    });
    let unknown = unknown.expect("a fine cell aside");
    let coarse = &there.coarse[&unknown.coarse()];
    assert!(checked.find(unknown).is_none(), "nobody asked for it");
    assert_eq!(
        checked.factors(unknown).factors(),
        coarse.factors().factors(),
        "its coarse cell"
    );
    let far = CellKey::fine(&Rooms::floor(Vec3::splat(100.0)), SIZE);
    assert!(checked.factors(far).is_plain(), "far away");
}

/// A fine cell knows what the coarse cell's rays from its places have seen.
#[test]
fn fine_cells_learn_from_the_rays_of_their_coarse_cell() {
    for lamps in [100, 3000] {
        let rooms = Rooms::new(lamps, true);
        let fill = |keeps_rays: bool| {
            let options = FillOptions {
                fine_rays: 16,
                ..FillOptions::default()
            };
            let mut filled = Filled::new(&rooms, options);
            for key in keys() {
                filled.fill(key);
                if !keeps_rays {
                    let cell = filled.coarse.get_mut(&key.coarse()).expect("filled");
                    *cell = cell.clone().without_rays();
                }
            }
            filled.variances()
        };
        let [plain, coarse, with, _] = fill(true);
        let [same_plain, same_coarse, without, _] = fill(false);
        assert_eq!([plain, coarse], [same_plain, same_coarse], "coarse cells");
        println!("{lamps} lamps: V {without:.3} without, {with:.3} with");
        assert!(with < 0.98 * without, "{without} to {with}");
    }
}

/// A third of the lamps emits nothing toward the places: no wall is in the way of that.
#[test]
fn lights_that_emit_nothing_hide_nothing() {
    let rooms = Rooms::new(100, false);
    let view = rooms.tree.view();
    let key = keys().next().expect("a point").coarse();
    let places = Rooms::places(key, 64);
    let options = FillOptions::default();
    let fill = |dark: Option<bool>| {
        CoarseCell::fill(view, key, &places, &options, |_, light, _| {
            match light.0 % 3 {
                0 => dark,
                _ => Some(true),
            }
        })
    };
    assert!(fill(None).is_plain(), "nothing is hidden");
    assert!(!fill(Some(false)).is_plain(), "a third is hidden");
}

/// Where nothing is in the way the first rays tell so, and there are no others.
#[test]
fn open_places_have_plain_cells() {
    let rooms = Rooms::new(100, false);
    let mut filled = Filled::new(&rooms, FillOptions::default());
    keys().take(50).for_each(|key| filled.fill(key));
    assert!(filled.coarse.values().all(CoarseCell::is_plain), "coarse");
    let fine = filled.fine.values();
    let is_plain = |cell: &FineCell| {
        cell.factors(&filled.coarse[&cell.key().coarse()])
            .is_plain()
    };
    assert!(fine.clone().all(is_plain), "fine");
    let first = filled.options.first_rays as usize;
    assert_eq!(filled.coarse_rays, first * filled.coarse.len(), "rays");
    assert_eq!(filled.fine_rays, 0, "rays of fine cells");
}

/// Behind a grille, whose bars no cell can know, factors gain nothing. Behind a wall the cells are
/// kept that make the second moment less, and their bytes do not depend on the question.
#[test]
fn cells_that_do_not_pay_become_plain() {
    let rooms = Rooms::new(100, true);
    let view = rooms.tree.view();
    let fill = |key: CellKey, least_gain, visible: &dyn Fn(Vec3, LightId) -> bool| {
        let options = FillOptions {
            least_gain,
            ..FillOptions::default()
        };
        let places = Rooms::places(key, 128);
        CoarseCell::fill(view, key, &places, &options, |place, light, _| {
            Some(visible(place.p, light))
        })
    };
    let grille = |p: Vec3, light: LightId| (p.x * 997.0 + light.0 as f32 * 0.37).fract() > -0.5;
    let walls = |p: Vec3, light: LightId| rooms.sees(p, light);
    let (mut plain, mut kept) = (0, 0);
    for p in Rooms::receivers().step_by(13) {
        let ctx = Rooms::floor(p);
        let key = CellKey::fine(&ctx, SIZE).coarse();
        assert!(!fill(key, 0.0, &grille).is_plain(), "{key:?}: half is seen");
        assert!(
            fill(key, 1.5, &grille).is_plain(),
            "{key:?}: behind a grille"
        );
        let (ungated, gated) = (fill(key, 0.0, &walls), fill(key, 1.5, &walls));
        let moment = |cell| 1.0 + variance(&rooms, p, |light| view.in_cell(cell).pmf(&ctx, light));
        let gain = moment(CellFactors::PLAIN) / moment(ungated.factors());
        if gated.is_plain() {
            assert!(gain < 1.8, "{key:?}: given up a gain of {gain}");
            plain += 1;
        } else {
            assert_eq!(gated, ungated, "{key:?}: the same cell");
            assert!(gain > 1.3, "{key:?}: kept for a gain of {gain}");
            kept += 1;
        }
    }
    assert!(plain > 3 && kept > 10, "{plain} plain, {kept} kept");
}

#[test]
fn nothing_to_see_is_plain() {
    let rooms = Rooms::new(100, true);
    let view = rooms.tree.view();
    let key = keys().next().expect("a point");
    let options = FillOptions::default();
    let none: [LightSampleContext; 0] = [];
    let nobody = CoarseCell::fill(view, key, &none, &options, |_, _, _| panic!("no places"));
    assert!(nobody.is_plain(), "no places");
    let places = Rooms::places(key, 8);
    let dark = LightBvh::default();
    let dark = CoarseCell::fill(dark.view(), key, &places, &options, |_, _, _| {
        panic!("no light")
    });
    assert!(dark.is_plain(), "no lights");
    let blind = CoarseCell::fill(view, key.coarse(), &places, &options, |_, _, _| Some(false));
    let without = blind.fill_fine(view, key, &none, &options, |_, _, _| panic!("no places"));
    assert_eq!(
        without.factors(&blind).factors(),
        blind.factors().factors(),
        "the coarse cell's"
    );
    let cell = view.in_cell(blind.factors());
    assert!(
        cell.sample(&places[0], 1 << 63).is_some(),
        "no light is lost"
    );
}
