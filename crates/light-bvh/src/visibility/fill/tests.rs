//! What cells are made from, on a tree of two rows of lamps.

use alloc::vec::Vec;

use light_bounds::{LightBounds, LightExtent, LightId, LightSampleContext};
use light_math::Aabb;
use light_math::glam::Vec3;

use crate::LightBvh;
use crate::node::wide_node::WIDTH;
use crate::query::bvh_ref::LightBvhRef;
use crate::visibility::cell_factors::copied_nodes;
use crate::visibility::fill::counts::Counts;
use crate::visibility::fill::gain::Gain;
use crate::visibility::fill::learn::learn;
use crate::visibility::fill::mean_importance::mean_importance;
use crate::visibility::fill::ray_log::RayLog;
use crate::visibility::way::Way;
use crate::visibility::{
    CellFactors, CellFactorsError, CellKey, CellTable, CellTableRef, CoarseCell, CopiedNode,
};

/// Half of them a unit apart, the others a thousandth.
const LAMPS: u16 = 600;

fn lamps() -> Vec<LightBounds> {
    let place = |i: u16| match i / (LAMPS / 2) {
        0 => Vec3::X * f32::from(i),
        _ => Vec3::new(f32::from(i) * 1e-3, 40.0, 0.0),
    };
    let lamp = |i: u16| LightBounds {
        bounds: Aabb::from_point(place(i)),
        w: Vec3::Z,
        phi: 1.0 + f32::from(i % 7),
        cos_theta_o: -1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    };
    (0..LAMPS).map(lamp).collect()
}

fn tree() -> LightBvh {
    let lights: Vec<_> = lamps().into_iter().map(LightExtent::Bounded).collect();
    LightBvh::build(&lights).expect("valid lights")
}

fn ids() -> impl Iterator<Item = LightId> {
    (0..u32::from(LAMPS)).map(LightId)
}

#[test]
fn ways_lead_from_the_root_to_the_light() {
    let tree = tree();
    let view = tree.view();
    for light in ids() {
        let way = Way::of(&view, light).expect("a light of the tree");
        let steps: Vec<_> = way.down().collect();
        assert!(steps.len() > 1 && steps[0].0 == 0, "{light:?}: {steps:?}");
        for (above, below) in steps.iter().zip(&steps[1..]) {
            let node = view.nodes()[above.0];
            let child = node.child_base as usize + above.1;
            assert_eq!(below.0, child, "{light:?}: {steps:?}");
        }
        let (node, child) = steps[steps.len() - 1];
        assert_eq!(WIDTH * node + child, view.slot(light) as usize, "{light:?}");
    }
    let unknown = LightId(u32::from(LAMPS));
    assert!(Way::of(&view, unknown).is_none(), "no such light");
}

#[test]
fn rays_keep_their_ways_and_what_they_saw() {
    let tree = tree();
    let view = tree.view();
    let mut log = RayLog::default();
    for light in ids() {
        log.push(&view, (light.0 % 7, light), Some(light.0 % 3 == 0));
    }
    log.push(&view, (0, LightId(u32::MAX)), Some(true));
    assert_eq!(log.rays().len(), usize::from(LAMPS), "known lights alone");
    assert!(log.is_open(0.333) && !log.is_open(0.334), "every third");
    for (light, ray) in ids().zip(log.rays()) {
        assert_eq!(ray.is_seen(), light.0 % 3 == 0, "{light:?}");
        let way = Way::of(&view, light).expect("a light of the tree");
        for (level, (_, child)) in way.down().enumerate() {
            assert_eq!(ray.child(level), child, "{light:?}, {level}");
        }
    }
}

/// Rays to the children of a node, by the ways of their lights.
fn counts(view: &LightBvhRef<'_>, log: &RayLog, node: usize) -> [Counts; WIDTH] {
    let mut counts = [Counts::default(); WIDTH];
    for (light, ray) in ids().zip(log.rays()) {
        let way = Way::of(view, light).expect("a light of the tree");
        if let Some((_, child)) = way.down().find(|step| step.0 == node) {
            counts[child].add(ray.is_seen());
        }
    }
    counts
}

/// A ray to every lamp, of which those of the first row are seen from the 200th on.
#[test]
fn what_is_learnt_is_what_rays_saw() {
    let tree = tree();
    let view = tree.view();
    let mut log = RayLog::default();
    for light in ids() {
        log.push(&view, (0, light), Some((200..300).contains(&light.0)));
    }
    let learnt = learn(&view, &log);
    assert!(learnt.shape.len() > 2, "{:?}", learnt.shape);
    let nodes = copied_nodes(&view, &learnt.shape).expect("the top of the tree");
    let mut before = [0.0; 24];
    before[0] = 100.5 / 601.0;
    for (place, copied) in learnt.shape.iter().enumerate() {
        let counts = counts(&view, &log, nodes[place] as usize);
        for (child, Counts { rays, seen }) in counts.into_iter().enumerate() {
            let expected = (seen as f32 + before[place]) / (rays as f32 + 1.0);
            let found = learnt.visibility[place][child];
            assert_eq!(found, expected, "child {child} of {place}");
            if let Some(copy) = copied.copy_of(child) {
                before[copy] = found;
                assert!(seen > 0 && seen < rays && rays > 5, "{seen} of {rays}");
            }
        }
    }
}

/// From afar, of lamps that emit alike in all directions: power over squared distance, in one unit
/// for nodes of any size.
#[test]
fn importance_has_one_unit_for_all_nodes() {
    let (tree, lamps) = (tree(), lamps());
    let view = tree.view();
    let place = LightSampleContext::medium(Vec3::new(150.0, 20.0, 5000.0));
    let nodes: Vec<u32> = (0..u32::try_from(view.nodes().len()).expect("few")).collect();
    let found = mean_importance(&view, &nodes, &[place, place]);
    let mut expected = alloc::vec![[0.0; WIDTH]; nodes.len()];
    for (light, lamp) in ids().zip(&lamps) {
        let way = Way::of(&view, light).expect("a light of the tree");
        for (node, child) in way.down() {
            let dist_sq = lamp.bounds.min.distance_squared(place.p);
            expected[node][child] += lamp.phi / dist_sq;
        }
    }
    let unit = found[0][0] / expected[0][0];
    for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
        let expected = expected * unit;
        assert!(
            (found - expected).abs() <= 0.1 * expected,
            "{found}, {expected}"
        );
    }
}

#[test]
fn cells_are_the_top_of_their_tree() {
    let tree = tree();
    let view = tree.view();
    let check = |shape: &[CopiedNode]| {
        let factors = alloc::vec![[192; WIDTH]; shape.len()];
        CellFactors::new(&view, shape, &factors).map(|cell| cell.bytes())
    };
    let [closed, opened] = [(0, 0), (1, 1)].map(|(opened, first)| CopiedNode { opened, first });
    assert_eq!(check(&[closed]), Ok(20), "the root alone");
    assert_eq!(check(&[opened, closed]), Ok(40), "its first child too");
    let wrong = [
        &[closed, closed][..],
        &[opened],
        &[CopiedNode { first: 2, ..opened }, closed],
    ];
    for shape in wrong {
        assert_eq!(check(shape), Err(CellFactorsError::Links), "{shape:?}");
    }
}

#[test]
fn tables_find_plain_cells() {
    let tree = LightBvh::build(&[]).expect("no lights");
    let key = |x: f32| CellKey::fine(&LightSampleContext::medium(Vec3::X * x), 1.0).coarse();
    let keys: Vec<_> = (0..50u8).map(|i| key(f32::from(i) * 1.5)).collect();
    let mut cells: Vec<_> = keys.iter().map(|&key| CoarseCell::plain(key)).collect();
    cells.dedup_by_key(|cell| cell.key());
    let table = CellTable::new(&cells, &[]).expect("a table");
    let checked = CellTableRef::new(&tree.view(), table.view().parts()).expect("a table");
    assert!(
        keys.iter().all(|&key| checked.find(key).is_some()),
        "all of them"
    );
    assert!(checked.find(key(-9.0)).is_none(), "no such cell");
    // A key, an entry and a start each, and the end of the starts.
    assert_eq!(
        checked.bytes(),
        32 * cells.len() + 4,
        "{} cells",
        cells.len()
    );
}

#[test]
fn counts_expect_what_was_expected_before() {
    let of = |rays, seen| Counts { rays, seen };
    assert_eq!(of(0, 0).visibility(0.25), 0.25, "no ray");
    assert_eq!(
        of(3, 2).visibility(0.5),
        0.625,
        "three rays and a half seen"
    );
    assert_eq!(of(5, 2).open_score(), 0, "too few");
    assert_eq!(of(6, 2).open_score(), 2, "seen");
    assert_eq!(of(40, 38).open_score(), 8, "four times what is not");
    assert_eq!(of(40, 40).open_score(), 0, "nothing to tell apart");
}

#[test]
fn moments_add_up() {
    let mut gain = Gain::default();
    gain.add(0.5, 0.25);
    gain.add(0.25, 0.5);
    // 2 + 1/2 by the tree, 4 + 1/4 by the cell.
    for (least, is_below) in [(0.5, false), (0.588, false), (0.589, true), (1.0, true)] {
        assert_eq!(gain.is_below(least), is_below, "{least}");
    }
}
