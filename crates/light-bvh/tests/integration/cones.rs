//! Groups of cones lose no light: a spot that shines at a point by its falloff has a pmf above 0
//! there, in every arrangement.

use core::f64::consts::PI;

use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
use light_bvh::light_bounds::{
    LightBounds, LightExtent, LightId, LightSampleContext, ReceiverKind, ReceiverSides,
};
use light_bvh::{LightBvh, LightBvhOptions};
use light_testkit::Rng;

use crate::support::double::{angle, between, double, tilted};

/// A spot light: full within an inner cone, nothing beyond an outer one.
#[derive(Clone, Copy, Debug)]
struct Spot {
    position: Vec3,
    axis: Vec3,
    power: f32,
    /// Angles of the two cones.
    start: f64,
    end: f64,
}

impl Spot {
    #[expect(clippy::cast_possible_truncation, reason = "bounds are rounded")]
    fn extent(&self) -> LightExtent {
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_point(self.position),
            w: self.axis,
            phi: self.power,
            cos_theta_o: self.start.cos() as f32,
            cos_theta_e: (self.end - self.start).cos() as f32,
            two_sided: false,
        })
    }

    /// Whether it shines at the context, by more than what bounds in single precision can tell.
    fn emits_at(&self, ctx: &LightSampleContext) -> bool {
        let away = angle(double(self.axis), between(self.position, ctx.p));
        let ReceiverKind::Surface { ns, sides, .. } = *ctx.kind() else {
            panic!("receivers on surfaces only")
        };
        let above = angle(double(ns), between(ctx.p, self.position)).cos();
        let received = sides == ReceiverSides::Both || above > GRAZING;
        received && away.cos() > self.end.cos() + GRAZING
    }
}

/// Cosines nearer than this are not told apart.
const GRAZING: f64 = 1e-5;

/// Where lights stand: at one point, on a plane, in a thin slab, in a box.
const EXTENTS: [Vec3; 5] = [
    Vec3::ZERO,
    Vec3::splat(1e-3),
    Vec3::new(1.0, 1.0, 0.0),
    Vec3::new(10.0, 10.0, 1e-3),
    Vec3::ONE,
];

/// An arrangement of cones: the axis, the half angle and how much of it is the rim, of one light
/// after another.
type Arrangement = fn(&mut Rng, usize) -> (Vec3, f32, f32);

const ARRANGEMENTS: [(&str, Arrangement); 7] = [
    ("aligned, of unlike widths", |rng, _| {
        (Vec3::NEG_Z, rng.range(4.0, 25.0), 0.3)
    }),
    ("aligned, of one width", |_, _| (Vec3::NEG_Z, 20.0, 0.3)),
    ("8 and 60 degrees", |_, i| {
        (Vec3::NEG_Z, [8.0, 60.0][i % 2], 0.0)
    }),
    ("opposite", |rng, i| {
        let axis = [Vec3::NEG_Z, Vec3::Z][i % 2];
        (axis, rng.range(5.0, 50.0), 0.2)
    }),
    ("all over", |rng, _| {
        (rng.direction(), rng.range(2.0, 80.0), rng.f32())
    }),
    ("aligned to rounding", |rng, _| {
        let axis = Vec3::new(0.6, 0.0, -0.8) + rng.direction() * 1e-7;
        (axis.normalize(), 15.0, 0.0)
    }),
    ("needles", |rng, _| {
        (Vec3::X, rng.log_range(0.05, 2.0), rng.f32())
    }),
];

fn spots(
    rng: &mut Rng,
    count: usize,
    extent: Vec3,
    origin: Vec3,
    arrange: Arrangement,
) -> Vec<Spot> {
    let spot = |i| {
        let (axis, degrees, rim) = arrange(rng, i);
        let end = f64::from(degrees).to_radians();
        Spot {
            position: origin + rng.vec3() * extent,
            axis,
            power: rng.log_range(0.01, 100.0),
            start: end * f64::from(1.0 - rim),
            end,
        }
    };
    (0..count).map(spot).collect()
}

/// A point in the light of one of the spots, or just beside it: in the middle, anywhere, at the
/// edge.
fn receiver(rng: &mut Rng, spots: &[Spot]) -> Vec3 {
    let spot = spots[rng.below(spots.len())];
    let share = [rng.f64(), 1.1 * rng.f64(), 0.999][rng.below(3)];
    let w = tilted(spot.axis, spot.end * share, PI * rng.f64());
    spot.position + w * rng.log_range(0.1, 30.0)
}

/// How many pairs of light and point contribute.
fn check(
    rng: &mut Rng,
    spots: &[Spot],
    options: &LightBvhOptions,
    points: usize,
    name: &str,
) -> usize {
    let extents: Vec<_> = spots.iter().map(Spot::extent).collect();
    let mut tree = LightBvh::build_with(&extents, options).expect("valid lights");
    if rng.below(2) == 0 {
        tree.refit(&extents).expect("the same lights");
    }
    let mut pairs = 0;
    for _ in 0..points {
        let p = receiver(rng, spots);
        let n = rng.direction();
        let surface = LightSampleContext::surface(p, n, n);
        for ctx in [LightSampleContext::two_sided(p, n, n), surface] {
            for (id, spot) in (0..).map(LightId).zip(spots) {
                if spot.emits_at(&ctx) {
                    assert!(
                        tree.pmf(&ctx, id) > 0.0,
                        "{name}: {id:?} of {} shines at {ctx:?}: {spot:?}",
                        spots.len(),
                    );
                    pairs += 1;
                }
            }
        }
    }
    pairs
}

#[test]
fn groups_of_cones_lose_no_light() {
    let mut rng = Rng::new(81);
    let mut pairs = 0;
    for (name, arrange) in ARRANGEMENTS {
        for round in 0..60 {
            let count = [1, 2, 3, 7, 16, 17, 40, 300][round % 8];
            let extent = EXTENTS[round % 5];
            let origin = [Vec3::ZERO, Vec3::splat(1e3)][round / 5 % 2];
            let spots = spots(&mut rng, count, extent, origin, arrange);
            let options = [LightBvhOptions::QUALITY, LightBvhOptions::FAST][round / 3 % 2];
            pairs += check(&mut rng, &spots, &options, 8, name);
        }
    }
    assert!(pairs > 30_000, "{pairs} pairs");
}

/// Ten thousand downlights of unlike width at one height, by several levels of groups.
#[test]
fn downlights_of_unlike_width_lose_no_light() {
    let mut rng = Rng::new(82);
    let arrange: Arrangement = |rng, _| (Vec3::NEG_Z, rng.range(8.0, 50.0), rng.f32());
    let extent = Vec3::new(30.0, 30.0, 0.0);
    let spots = spots(&mut rng, 10_000, extent, Vec3::Z * 3.0, arrange);
    let pairs = check(
        &mut rng,
        &spots,
        &LightBvhOptions::QUALITY,
        100,
        "downlights",
    );
    assert!(pairs > 1000, "{pairs} pairs");
}
