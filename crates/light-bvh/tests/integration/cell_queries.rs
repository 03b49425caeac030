//! Queries from within a cell obey the laws of the tree's, whatever the factors are.

use light_bvh::light_bounds::light_math::fraction::stratum;
use light_bvh::light_bounds::light_math::glam::Vec3;
use light_bvh::light_bounds::{Gloss, LightExtent, LightGroups, LightId, LightSampleContext};
use light_bvh::visibility::{CellFactors, CellFactorsError, CopiedNode, encode_factor};
use light_bvh::{LightBvh, LightBvhRef, MediumReceiver};
use light_testkit::Rng;

use crate::support::lamp;

fn tree(count: u32, rng: &mut Rng) -> LightBvh {
    let lights: Vec<LightExtent> = (0..count)
        .map(|_| lamp(rng.vec3() + Vec3::Z, rng.log_range(0.01, 10.0)))
        .collect();
    LightBvh::build(&lights).expect("valid lights")
}

/// A random copy of the top of a tree.
fn shape(tree: &LightBvhRef<'_>, nodes: usize, rng: &mut Rng) -> Vec<CopiedNode> {
    let (mut ids, mut shape) = (vec![0], Vec::new());
    while shape.len() < ids.len() {
        let node = tree.nodes()[ids[shape.len()]];
        let first = u16::try_from(ids.len()).expect("few");
        let mut copied = CopiedNode { opened: 0, first };
        for child in 0..node.inner {
            if ids.len() < nodes && rng.f32() < 0.5 {
                copied.opened |= 1 << child;
                ids.push(node.child_base as usize + usize::from(child));
            }
        }
        shape.push(copied);
    }
    shape
}

fn factors(nodes: usize, mut factor: impl FnMut() -> f32) -> Vec<[u8; 16]> {
    (0..nodes)
        .map(|_| core::array::from_fn(|_| encode_factor(factor())))
        .collect()
}

fn contexts(rng: &mut Rng) -> Vec<LightSampleContext> {
    let (p, n) = (rng.vec3() * 2.0, rng.direction());
    let floor = LightSampleContext::surface(p, n, n);
    let gloss = Gloss {
        wo: rng.direction(),
        alpha: 0.2,
        diffuse: 0.4,
    };
    vec![
        floor,
        floor.with_gloss(gloss),
        floor.with_groups(LightGroups::of(1)),
        LightSampleContext::two_sided(p, n, n),
        LightSampleContext::medium(p),
        LightSampleContext::medium(p * 1e20).with_groups(LightGroups::of(2)),
        LightSampleContext::segment(p, n),
    ]
}

#[test]
fn sampled_pmfs_are_queried_ones_and_no_light_is_lost() {
    let mut rng = Rng::new(1);
    for count in [1, 16, 17, 400, 5000] {
        let mut tree = tree(count, &mut rng);
        let groups: Vec<_> = (0..count).map(|id| LightGroups::of(id % 3)).collect();
        tree.set_groups(&groups).expect("as many");
        for nodes in [1, 5, 24] {
            let view = tree.view();
            let shape = shape(&view, nodes, &mut rng);
            let factors = factors(shape.len(), || rng.log_range(1e-3, 100.0));
            let cell = CellFactors::new(&view, &shape, &factors).expect("a cell");
            let within = view.in_cell(cell);
            for ctx in contexts(&mut rng) {
                let (at, strata) = (within.at(&ctx), 1000);
                let (mut counts, mut none) = (vec![0u32; count as usize], 0u32);
                for u in (0..strata).map(|i| stratum(i, strata, 1 << 63)) {
                    let chosen = within.sample(&ctx, u);
                    assert_eq!(chosen, at.sample(u), "kept, {ctx:?}");
                    if let Some(chosen) = chosen {
                        assert_eq!(chosen.pmf, within.pmf(&ctx, chosen.light), "{ctx:?}");
                        assert_eq!(chosen.pmf, at.pmf(chosen.light), "kept, {ctx:?}");
                        counts[chosen.light.index()] += 1;
                    } else {
                        none += 1;
                    }
                }
                let mut sum = 0.0;
                for (id, count) in (0..).map(LightId).zip(counts) {
                    let pmf = within.pmf(&ctx, id);
                    assert_eq!(pmf > 0.0, view.pmf(&ctx, id) > 0.0, "{id:?} at {ctx:?}");
                    sum += f64::from(pmf);
                    // Of equally spaced numbers an interval holds its width, but for its ends.
                    let expected = f64::from(strata) * f64::from(pmf);
                    let off = (f64::from(count) - expected).abs();
                    assert!(off < 1.1, "{count} of {expected}: {id:?} at {ctx:?}");
                }
                let none = f64::from(none) / f64::from(strata);
                assert!((sum + none - 1.0).abs() < 0.02, "{sum}, {none} at {ctx:?}");
                let is_lit = view.at(&ctx).irradiance() > 0.0;
                assert_eq!(at.irradiance() > 0.0, is_lit, "{ctx:?}");
                if ctx.ns().is_none() {
                    let expected = f64::from(u8::from(is_lit));
                    assert!((sum - expected).abs() < 1e-5, "{sum} at {ctx:?}");
                }
                assert_eq!(within.pmf(&ctx, LightId(count)), 0.0, "no such light");
            }
        }
    }
}

#[test]
fn factors_of_one_have_the_bits_of_the_tree() {
    let mut rng = Rng::new(2);
    let tree = tree(3000, &mut rng);
    let view = tree.view();
    let shape = shape(&view, 24, &mut rng);
    let ones = factors(shape.len(), || 1.0);
    let ones = CellFactors::new(&view, &shape, &ones).expect("a cell");
    let contexts: Vec<_> = (0..50).flat_map(|_| contexts(&mut rng)).collect();
    for ctx in contexts {
        for cell in [ones, CellFactors::PLAIN] {
            let (within, at) = (view.in_cell(cell), view.in_cell(cell).at(&ctx));
            assert_eq!(at.irradiance(), view.at(&ctx).irradiance(), "{ctx:?}");
            for _ in 0..20 {
                let (u, id) = (rng.u64(), LightId(rng.u32() % 3000));
                assert_eq!(within.sample(&ctx, u), view.sample(&ctx, u), "{ctx:?}");
                assert_eq!(at.sample(u), view.sample(&ctx, u), "{ctx:?}");
                assert_eq!(within.pmf(&ctx, id), view.pmf(&ctx, id), "{ctx:?}");
            }
        }
    }
}

#[test]
fn a_child_is_chosen_as_often_as_its_factor_says() {
    let mut rng = Rng::new(3);
    let tree = tree(16, &mut rng);
    let view = tree.view();
    let here = MediumReceiver::new(Vec3::new(0.4, 0.6, 0.1));
    let pmfs: Vec<f32> = view
        .order()
        .iter()
        .map(|&id| view.pmf(&here, LightId(id)))
        .collect();
    // The first child has what rounding leaves over.
    let child = (1..16)
        .max_by(|&a, &b| pmfs[a].total_cmp(&pmfs[b]))
        .expect("lights");
    let mut codes = [encode_factor(1.0); 16];
    codes[child] = encode_factor(1.0 / 16.0);
    let (shape, codes) = ([CopiedNode::default()], [codes]);
    let cell = CellFactors::new(&view, &shape, &codes).expect("a cell");
    let plain = pmfs[child];
    let pmf = view.in_cell(cell).pmf(&here, LightId(view.order()[child]));
    // One sixteenth is the mean of all factors, the rest the child's own.
    let mean = 1.0 - plain * 15.0 / 16.0;
    let expected = plain * (15.0 / 16.0 * (1.0 / 16.0) / mean + 1.0 / 16.0);
    // Probabilities are multiples of 2^-16.
    assert!(
        (pmf - expected).abs() < 3e-5,
        "{pmf}, not {expected}; the tree alone {plain}"
    );
}

#[test]
fn what_is_no_cell_of_the_tree_is_refused() {
    let mut rng = Rng::new(4);
    let tree = tree(3000, &mut rng);
    let view = tree.view();
    let shape = shape(&view, 20, &mut rng);
    let ones = factors(shape.len(), || 1.0);
    let of = |shape: &[CopiedNode], factors: &[[u8; 16]]| {
        CellFactors::new(&view, shape, factors).map(|_| ())
    };
    assert_eq!(of(&shape, &ones), Ok(()), "a cell");
    assert_eq!(of(&[], &[]), Ok(()), "a plain cell");
    assert_eq!(
        of(&shape, &ones[1..]),
        Err(CellFactorsError::Lengths),
        "one short"
    );
    for (code, expected) in [
        (119, Err(CellFactorsError::Factor)),
        (120, Ok(())),
        (240, Ok(())),
        (241, Err(CellFactorsError::Factor)),
    ] {
        let mut codes = ones.clone();
        codes[7][15] = code;
        assert_eq!(of(&shape, &codes), expected, "code {code}");
    }
    for place in 0..shape.len() {
        for bit in 0..32 {
            let mut damaged = shape.clone();
            if bit < 16 {
                damaged[place].opened ^= 1 << bit;
            } else if damaged[place].opened != 0 {
                damaged[place].first ^= 1 << (bit - 16);
            } else {
                continue;
            }
            let expected = Err(CellFactorsError::Links);
            assert_eq!(of(&damaged, &ones), expected, "node {place}, bit {bit}");
        }
    }
    let fewer = &shape[..shape.len() - 1];
    assert_eq!(
        of(fewer, &ones[1..]),
        Err(CellFactorsError::Links),
        "one less"
    );
    let orphan = CopiedNode {
        opened: 1,
        first: 1,
    };
    let apart = [CopiedNode::default(), orphan];
    assert_eq!(
        of(&apart, &ones[..2]),
        Err(CellFactorsError::Links),
        "a node that no other leads to"
    );
    let empty = LightBvh::default();
    let found = CellFactors::new(&empty.view(), &shape, &ones).map(|_| ());
    assert_eq!(found, Err(CellFactorsError::Links), "no tree");
}
