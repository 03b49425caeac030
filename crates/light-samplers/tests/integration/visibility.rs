//! The default hierarchy with factors of visibility obeys the laws of light samplers, whatever the
//! factors are.

use light_bvh::LightBvhRef;
use light_bvh::visibility::{CellFactors, CopiedNode, MAX_COPIED_NODES, encode_factor};
use light_samplers::light_bounds::glam::Vec3;
use light_samplers::light_bounds::light_math::Aabb;
use light_samplers::light_bounds::{
    LightBounds, LightExtent, LightId, LightSampleContext, SampledLight,
};
use light_samplers::{
    BvhLightSampler, LightChoices, LightSampler, VisibilityCache, VisibilityLightSampler,
};
light_testkit::sampler_laws! {
    /// Factors from 2^-9 to 64 on one side of a plane, and none on the other.
    mod half {
        |set| InCells::new(&set.extents(), 1, |child| encode_factor(UNLIKE[child % 5]))
    }

    /// Factors that are all alike change nothing.
    mod alike {
        |set| InCells::new(&set.extents(), 1, |_| encode_factor(0.25))
    }

    /// Factors of as many nodes as a cell copies.
    mod deep {
        |set| {
            let code = |child: usize| encode_factor(UNLIKE[child % 5]);
            InCells::new(&set.extents(), MAX_COPIED_NODES, code)
        }
    }
}

/// Factors from the least to the largest.
const UNLIKE: [f32; 5] = [0.002, 64.0, 0.3, 1.0, 2.5];

/// A sampler and the cells of its lights.
struct InCells {
    lights: BvhLightSampler,
    cells: HalfSpace,
}

/// One cell for all points with a positive `x`.
struct HalfSpace {
    shape: Vec<CopiedNode>,
    factors: Vec<[u8; 16]>,
    tree: BvhLightSampler,
}

impl InCells {
    /// A cell that copies so many nodes, or all, with factors by the place of a child in its node.
    fn new(lights: &[LightExtent], nodes: usize, code: impl Fn(usize) -> u8) -> Self {
        let lights = BvhLightSampler::new(lights).expect("valid bounds");
        let shape = top(&lights.tree().view(), nodes);
        let cells = HalfSpace {
            factors: vec![core::array::from_fn(code); shape.len()],
            shape,
            tree: lights.clone(),
        };
        Self { lights, cells }
    }

    fn sampler(&self) -> VisibilityLightSampler<'_, HalfSpace> {
        VisibilityLightSampler::new(self.lights.view(), &self.cells)
    }
}

impl VisibilityCache for HalfSpace {
    fn factors<'a>(&'a self, ctx: &LightSampleContext) -> Option<CellFactors<'a>> {
        let tree = self.tree.tree().view();
        let cell = CellFactors::new(&tree, &self.shape, &self.factors).expect("a cell of the tree");
        (ctx.p.x > 0.0 && !cell.is_plain()).then_some(cell)
    }
}

impl LightSampler for InCells {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.sampler().sample(ctx, u)
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.sampler().pmf(ctx, light)
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        self.sampler().choices(ctx, count, count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.sampler().sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.sampler().pmf_emitter(light)
    }
}

/// The copy of the first nodes of a tree, level by level.
fn top(tree: &LightBvhRef<'_>, nodes: usize) -> Vec<CopiedNode> {
    let mut indices = vec![0; usize::from(!tree.is_empty())];
    let mut shape = Vec::new();
    while let Some(&index) = indices.get(shape.len()) {
        let (node, first) = (tree.nodes()[index as usize], indices.len());
        let below = (0..u32::from(node.inner)).take(nodes - first);
        indices.extend(below.clone().map(|child| node.child_base + child));
        shape.push(CopiedNode {
            opened: below.fold(0, |opened, child| opened | 1 << child),
            first: u16::try_from(first).expect("few nodes"),
        });
    }
    shape
}

/// Lamps in a row above the x axis, on both sides of the origin.
fn row() -> Vec<LightExtent> {
    let lamp = |x: i16| LightBounds {
        bounds: Aabb::from_point(Vec3::new(f32::from(x), 0.0, 3.0)),
        w: Vec3::NEG_Z,
        phi: 1.0,
        cos_theta_o: 1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    };
    (-20..20).map(|x| LightExtent::Bounded(lamp(x))).collect()
}

#[test]
fn known_and_unknown_places_have_their_own_counts() {
    let sampler = InCells::new(&row(), 1, |_| encode_factor(0.5));
    let count = |x: f32| {
        let ctx = LightSampleContext::medium(Vec3::X * x);
        let choices = sampler.sampler().choices(&ctx, 1, 4);
        let lights = choices.samples(1 << 60).count();
        assert_eq!(lights, choices.count() as usize, "all lamps light {ctx:?}");
        lights
    };
    assert_eq!(count(1.0), 1, "known");
    assert_eq!(count(-1.0), 4, "unknown");
}

#[test]
fn a_copy_makes_the_same_choices_with_one_count_for_all_places() {
    let cells = InCells::new(&row(), 1, |child| encode_factor(UNLIKE[child % 5]));
    let sampler = cells.sampler();
    let copy = Clone::clone(&sampler);
    for x in [1.0, -1.0] {
        let ctx = LightSampleContext::medium(Vec3::X * x);
        for count in [1, 3] {
            let (here, same) = (copy.at(&ctx, count), sampler.choices(&ctx, count, count));
            assert_eq!(here.count(), count, "at {x}");
            assert!(here.samples(1 << 62).eq(same.samples(1 << 62)), "at {x}");
            assert!((0..40).map(LightId).all(|id| here.pmf(id) == same.pmf(id)));
        }
    }
}

#[test]
fn a_factor_of_a_child_makes_its_lights_rarer() {
    let lamps = row();
    let plain = BvhLightSampler::new(&lamps).expect("valid bounds");
    let sampler = InCells::new(&lamps, 1, |child| encode_factor([0.002, 1.0][child % 2]));
    let ctx = LightSampleContext::medium(Vec3::X);
    let changes = (0..40).map(LightId).filter_map(|light| {
        let (before, after) = (plain.pmf(&ctx, light), sampler.pmf(&ctx, light));
        (before > 0.0).then_some(after / before)
    });
    let (rarer, likelier): (Vec<f32>, Vec<f32>) = changes.partition(|&ratio| ratio < 1.0);
    assert!(
        rarer.iter().any(|&ratio| ratio < 0.1) && likelier.iter().any(|&ratio| ratio > 1.05),
        "{} rarer, {} likelier",
        rarer.len(),
        likelier.len()
    );
}
