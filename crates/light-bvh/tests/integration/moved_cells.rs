//! Cells of visibility where lights or walls move: which must be filled again, and what the others
//! still know.

use alloc::collections::{BTreeMap, BTreeSet};

use light_bvh::LightBvh;
use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
use light_bvh::light_bounds::{LightExtent, LightId, LightSampleContext};
use light_bvh::visibility::{CellFactors, CellKey, CoarseCell, FillOptions, FineCell};
use light_testkit::Rng;

use crate::support::lamp;
use crate::support::two_rooms::Rooms;

/// The size of coarse cells.
const SIZE: f32 = 1.0;

const OPTIONS: FillOptions = FillOptions {
    first_rays: 48,
    exploring_rays: 500,
    guided_rays: 100,
    fine_rays: 48,
    plain_share: 0.97,
    floor: 0.1,
    least_gain: 0.0,
};

/// The cells of the floor of the left room.
#[derive(Debug, Default, PartialEq)]
struct Cells {
    coarse: BTreeMap<CellKey, CoarseCell>,
    fine: BTreeMap<CellKey, FineCell>,
}

impl Cells {
    /// Fills those cells that are not there; `visible` also gets the key of the cell.
    fn fill(&mut self, rooms: &Rooms, visible: &mut dyn FnMut(CellKey, Vec3, LightId) -> bool) {
        let view = rooms.tree.view();
        for p in Rooms::receivers() {
            let key = CellKey::fine(&Rooms::floor(p), SIZE);
            let at = key.coarse();
            let coarse = self.coarse.entry(at).or_insert_with(|| {
                let see = |place: &LightSampleContext, light, _| Some(visible(at, place.p, light));
                CoarseCell::fill(view, at, &Rooms::places(at, 64), &OPTIONS, see)
            });
            self.fine.entry(key).or_insert_with(|| {
                let see = |place: &LightSampleContext, light, _| Some(visible(key, place.p, light));
                coarse.fill_fine(view, key, &Rooms::places(key, 16), &OPTIONS, see)
            });
        }
    }

    fn of(rooms: &Rooms) -> Self {
        let mut cells = Self::default();
        cells.fill(rooms, &mut |_, p, light| rooms.sees(p, light));
        cells
    }

    fn factors(&self, ctx: &LightSampleContext) -> CellFactors<'_> {
        let key = CellKey::fine(ctx, SIZE);
        self.fine[&key].factors(&self.coarse[&key.coarse()])
    }

    /// How many have the same bytes as in `other`, and how many there are.
    fn kept(&self, other: &Self) -> [usize; 2] {
        let fine = self.fine.iter().filter(|(key, cell)| {
            let at = key.coarse();
            other.fine[key] == **cell && other.coarse[&at] == self.coarse[&at]
        });
        [fine.count(), self.fine.len()]
    }
}

/// Whether a segment meets a box.
fn meets(bounds: &Aabb, p: Vec3, q: Vec3) -> bool {
    let (mut near, mut far) = (0.0_f32, 1.0_f32);
    for axis in 0..3 {
        let along = q[axis] - p[axis];
        let [a, b] = [bounds.min, bounds.max].map(|end| (end[axis] - p[axis]) / along);
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    near <= far
}

/// A panel moves across a room. A cell none of whose rays meets its old or its new place has the
/// bytes that it would have if it were filled again: the caller knows by the rays that it is asked
/// for. The others are filled again.
#[test]
fn what_moves_changes_only_cells_whose_rays_meet_it() {
    let rooms = Rooms::new(300, true);
    let panel = |x: f32| Aabb {
        min: Vec3::new(x, 5.0, 0.5),
        max: Vec3::new(x + 1.0, 6.0, 0.6),
    };
    let [old, new] = [panel(-7.0), panel(-6.5)];
    let seen = |panel: &Aabb, p: Vec3, light: LightId| {
        rooms.sees(p, light) && !meets(panel, p, rooms.lamps[light.index()].0)
    };
    let mut touched = BTreeSet::new();
    let mut cells = Cells::default();
    cells.fill(&rooms, &mut |key, p, light| {
        let q = rooms.lamps[light.index()].0;
        if meets(&old, p, q) || meets(&new, p, q) {
            touched.insert(key);
        }
        seen(&old, p, light)
    });
    let mut expected = Cells::default();
    expected.fill(&rooms, &mut |_, p, light| seen(&new, p, light));
    let all = cells.fine.len();
    assert_ne!(cells, expected, "the panel counts");

    // A fine cell rests on the rays of its coarse one.
    cells.coarse.retain(|key, _| !touched.contains(key));
    let coarse = &cells.coarse;
    (cells.fine).retain(|key, _| !touched.contains(key) && coarse.contains_key(&key.coarse()));
    let kept = cells.fine.len();
    println!("{kept} of {all} fine cells are kept");
    assert!(4 * kept > all && kept < all, "{kept} of {all} are kept");
    cells.fill(&rooms, &mut |_, p, light| seen(&new, p, light));
    assert_eq!(cells, expected, "as if all were filled again");
}

/// Two rooms before and after all lamps, or some of them, move a step in random directions.
fn moved(lamps: usize, step: f32, moves: impl Fn(usize) -> bool) -> [Rooms; 2] {
    let [before, mut after] = [0; 2].map(|_| Rooms::new(lamps, true));
    let mut rng = Rng::new(5);
    for (i, (p, _)) in after.lamps.iter_mut().enumerate() {
        let aside = (rng.vec3() - 0.5).with_z(0.0).normalize_or(Vec3::X);
        if moves(i) {
            *p += step * aside;
        }
    }
    let extents: Vec<LightExtent> = (after.lamps.iter()).map(|&(p, phi)| lamp(p, phi)).collect();
    after.tree.refit(&extents).expect("as many lights");
    [before, after]
}

/// The mean over the floor of the relative variance of one choice.
fn variance<'a>(rooms: &Rooms, cell: impl Fn(&LightSampleContext) -> CellFactors<'a>) -> f64 {
    let view = rooms.tree.view();
    let at = |p: Vec3| {
        let ctx = Rooms::floor(p);
        let within = view.in_cell(cell(&ctx));
        let (mut mean, mut moment) = (0.0, 0.0);
        for (light, &(q, phi)) in (0..).map(LightId).zip(&rooms.lamps) {
            if rooms.sees(p, light) {
                let dist_sq = f64::from(q.distance_squared(p));
                let arrives = f64::from(phi) * f64::from(q.z * q.z) / (dist_sq * dist_sq);
                mean += arrives;
                moment += arrives * arrives / f64::from(within.pmf(&ctx, light));
            }
        }
        moment / (mean * mean) - 1.0
    };
    Rooms::receivers().map(at).sum::<f64>() / 400.0
}

/// Old cells of a refitted tree choose as the laws demand, and where lights move little they still
/// know what is hidden.
#[test]
fn old_cells_of_lights_that_moved_lose_no_light() {
    for step in [0.1, 0.4, 1.6] {
        let [before, after] = moved(300, step, |_| true);
        let [old, new] = [&before, &after].map(Cells::of);
        let tree: &LightBvh = &after.tree;
        for p in Rooms::receivers().step_by(7) {
            let ctx = Rooms::floor(p);
            let within = tree.view().in_cell(old.factors(&ctx));
            let lights = (0..300).map(LightId);
            let all: f64 = (lights.clone().map(|light| within.pmf(&ctx, light)))
                .map(f64::from)
                .sum();
            assert!((all - 1.0).abs() < 1e-4, "{step}, {p}: {all}");
            let lost =
                |&light: &LightId| tree.pmf(&ctx, light) > 0.0 && within.pmf(&ctx, light) <= 0.0;
            assert_eq!(lights.clone().find(lost), None, "{step}, {p}: lost");
            for i in 0..32u64 {
                let sample = within.sample(&ctx, i << 59 | 0x3_1415_9265).expect("lit");
                assert_eq!(sample.pmf, within.pmf(&ctx, sample.light), "{step}, {p}");
            }
        }
        let plain = variance(&after, |_| CellFactors::PLAIN);
        let [kept, again] = [&old, &new].map(|cells| variance(&after, |ctx| cells.factors(ctx)));
        println!("step {step}: V {plain:.3}, old cells {kept:.3}, new ones {again:.3}");
        assert!(again < 0.4 * plain, "{step}: {plain} to {again}");
        // Larger steps take many lamps through the wall.
        assert!(
            step > 0.4 || kept < 0.6 * plain,
            "{step}: {plain} to {kept}"
        );
    }
}

/// A cell of a tree that was refitted to the same lights has the same bytes. One lamp that moves
/// changes the weights by which nearly all cells choose their rays, and so their bytes.
#[test]
fn a_lamp_that_moves_changes_nearly_all_cells() {
    let [before, same] = moved(300, 0.4, |_| false);
    let cells = Cells::of(&before);
    assert_eq!(cells, Cells::of(&same), "nothing moved");
    for (lamps, step) in [(300, 0.01), (300, 0.4), (3000, 0.01), (3000, 0.4)] {
        let [before, after] = moved(lamps, step, |lamp| lamp == 7);
        let [kept, all] = Cells::of(&before).kept(&Cells::of(&after));
        println!("one of {lamps} lamps moves by {step}: {kept} of {all} cells keep their bytes");
        assert!(10 * kept < all, "{lamps}, {step}: {kept} of {all}");
    }
}
