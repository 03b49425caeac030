//! Shapes far from the origin of the scene, where coordinates have few digits: samples bring the
//! light that the shape with its rounded corners emits.

use core::f64::consts::PI;

use light_bounds::LightSampleContext;
use light_math::glam::{Affine3A, DVec2, DVec3, Quat, Vec2, Vec3};
use light_math::warp::cosine_hemisphere;
use light_math::{Frame, mis};
use light_sources::shape::{AnyShape, Shape, ShapeDesc};
use light_testkit::{Estimate, Rng};

const OFFSETS: [f32; 7] = [0.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0];

/// A trapezoid, a kite, and two bent patches: corners at (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
fn quads() -> [(&'static str, [Vec3; 4]); 4] {
    let quad = |[c, d]: [[f32; 3]; 2]| [Vec3::ZERO, Vec3::X, c.into(), d.into()];
    [
        ("trapezoid", quad([[0.1, 1.5, 0.0], [0.8, 1.5, 0.0]])),
        ("kite", quad([[0.0, 1.0, 0.0], [1.4, 1.4, 0.0]])),
        ("slightly bent", quad([[0.1, 1.5, 0.0], [0.8, 1.5, 0.05]])),
        ("bent", quad([[0.1, 1.5, 0.0], [0.8, 1.5, 0.5]])),
    ]
}

/// The cosine-weighted solid angle of a patch that hides no part of itself, in double precision.
fn irradiance(corners: [Vec3; 4], p: Vec3, n: Vec3) -> f64 {
    const STEPS: u32 = 200;
    let [a, b, c, d] = corners.map(|corner| corner.as_dvec3() - p.as_dvec3());
    let n = n.as_dvec3();
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(STEPS);
    let cells = (0..STEPS * STEPS).map(|i| (middle(i % STEPS), middle(i / STEPS)));
    let arriving = |(u, v)| {
        let to: DVec3 = a.lerp(b, u).lerp(c.lerp(d, u), v);
        let normal = (b - a).lerp(d - c, v).cross((c - a).lerp(d - b, u));
        let dist_sq = to.length_squared();
        to.dot(normal).abs() * to.dot(n).max(0.0) / (dist_sq * dist_sq)
    };
    cells.map(arriving).sum::<f64>() / f64::from(STEPS * STEPS)
}

/// Samples from one receiver: their estimate of the irradiance, and how many there are none of.
fn sampled(shape: &AnyShape, ctx: &LightSampleContext, n: Vec3, rng: &mut Rng) -> (Estimate, u32) {
    let mut missing = 0;
    let estimate = Estimate::of(COUNT, || {
        let Some(sample) = shape.sample_toward(ctx, rng.vec2()) else {
            missing += 1;
            return 0.0;
        };
        let queried = shape.pdf_toward(ctx, sample.wi);
        assert!(
            (queried - sample.pdf).abs() <= 1e-3 * sample.pdf,
            "{shape:?} from {}: queried {queried}, {sample:?}",
            ctx.p
        );
        f64::from(n.dot(sample.wi).max(0.0) / sample.pdf)
    });
    (estimate, missing)
}

const COUNT: u32 = 20_000;

#[test]
fn quads_bring_all_of_their_light() {
    let mut rng = Rng::new(6);
    for (name, corners) in quads() {
        for (offset, i) in OFFSETS
            .into_iter()
            .flat_map(|offset| [(offset, 0), (offset, 1)])
        {
            // Once along the axes, once turned.
            let turn = [0.0, 0.8][i];
            let turn = Quat::from_axis_angle(Vec3::new(1.0, 2.0, 0.5).normalize(), turn);
            let place = |p: Vec3| Vec3::new(1.0, 0.7, -0.3) * offset + turn * p;
            let corners = corners.map(place);
            let shape = ShapeDesc::Quad(corners).build().expect("a quad");
            for side in [1.0, -1.0] {
                let p = place(Vec3::new(0.5, 0.5, 2.0 * side));
                let n = turn * Vec3::NEG_Z * side;
                let ctx = LightSampleContext::surface(p, n, n);
                let (estimate, missing) = sampled(&shape, &ctx, n, &mut rng);
                let truth = irradiance(corners, p, n);
                assert!(
                    (estimate.mean - truth).abs() < estimate.margin(truth) + 1e-3 * truth,
                    "{name} at {offset}, side {side}: {estimate:?} of {truth}"
                );
                assert!(
                    missing <= COUNT / 1000,
                    "{name} at {offset}, side {side}: {missing} of {COUNT} missing"
                );
            }
        }
    }
}

/// A patch that hides a part of itself: samples bring what rays find, and each ray has a density.
#[test]
fn hidden_parts_stay_hidden() {
    let mut rng = Rng::new(8);
    let corners = [
        Vec3::ZERO,
        Vec3::new(1.0, 0.0, 1.0),
        Vec3::new(0.0, 1.0, 1.2),
        Vec3::new(1.0, 1.0, -0.5),
    ];
    let p = Vec3::new(2.2, 1.9, 0.4);
    for offset in OFFSETS {
        let place = |p: Vec3| Vec3::new(1.0, 0.7, -0.3) * offset + p;
        let shape = ShapeDesc::Quad(corners.map(place)).build().expect("a quad");
        let n = (Vec3::splat(0.5) - p).normalize();
        let ctx = LightSampleContext::surface(place(p), n, n);
        let (estimate, missing) = sampled(&shape, &ctx, n, &mut rng);
        let by_rays = Estimate::of(10 * COUNT, || {
            let wi = rng.direction();
            let is_hit = shape.hit(ctx.p, wi).is_some();
            let pdf = shape.pdf_toward(&ctx, wi);
            assert_eq!(is_hit, pdf > 0.0, "at {offset}: {wi}");
            4.0 * PI * f64::from(n.dot(wi).max(0.0)) * f64::from(u8::from(is_hit))
        });
        assert!(
            estimate.agrees_with_estimate(&by_rays),
            "at {offset}: {estimate:?}, by rays {by_rays:?}"
        );
        let missing = f64::from(missing) / f64::from(COUNT);
        assert!(
            (missing - 0.29).abs() < 0.02,
            "at {offset}: {missing} hidden"
        );
    }
}

/// The fluence of a triangle, its solid angle, in double precision.
fn solid_angle(corners: [Vec3; 3], p: Vec3) -> f64 {
    let [a, b, c] = corners.map(|corner| (corner.as_dvec3() - p.as_dvec3()).normalize());
    let volume = (b - a).cross(c - a).dot(a);
    2.0 * volume.abs().atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}

/// A triangle seen at grazing angles from beside it: none of its light is lost.
#[test]
fn triangles_bring_all_of_their_light_at_grazing_angles() {
    const COUNT: u32 = 4000;
    let mut rng = Rng::new(9);
    let corners = [(-0.5, -0.5), (0.5, -0.4), (0.1, 0.6)];
    let corners = corners.map(|(x, y)| Vec3::new(x, y, 0.0));
    for degrees in [0.3f32, 1.0, 5.0] {
        for trial in 0..8u8 {
            let axis = rng.direction();
            let turn = Quat::from_axis_angle(axis, f32::from(trial));
            let around = f32::from(trial) * 0.8;
            let up = degrees.to_radians();
            let toward = Vec3::new(around.cos(), around.sin(), 0.0) * up.cos() + Vec3::Z * up.sin();
            let far = rng.direction() * 3000.0;
            let place = |p: Vec3| far + turn * p;
            let (corners, p) = (corners.map(place), place(toward * 1.5));
            let shape = ShapeDesc::Triangle(corners).build().expect("a triangle");
            let ctx = LightSampleContext::medium(p);
            let mut missing = 0;
            let mut sum = 0.0;
            for _ in 0..COUNT {
                let Some(sample) = shape.sample_toward(&ctx, rng.vec2()) else {
                    missing += 1;
                    continue;
                };
                let queried = shape.pdf_toward(&ctx, sample.wi);
                let error = (queried / sample.pdf - 1.0).abs();
                assert!(error <= 1e-3, "{degrees} degrees: {queried}, {sample:?}");
                sum += 1.0 / f64::from(sample.pdf);
            }
            assert_eq!(missing, 0, "at {degrees} degrees, {trial}");
            let part = sum / f64::from(COUNT) / solid_angle(corners, p);
            assert!((part - 1.0).abs() < 0.02, "at {degrees} degrees: {part}");
        }
    }
}

/// A thin strip of a rectangle, seen at a slope of less than a thousandth from beside it: none of
/// its light is lost.
#[test]
fn rectangles_bring_all_of_their_light_at_grazing_angles() {
    const COUNT: u32 = 4000;
    let mut rng = Rng::new(13);
    let turn = Quat::from_axis_angle(Vec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    for offset in [0.0, 30.0, 100.0, 300.0] {
        for width in [1e-3, 0.01, 0.1] {
            let far = Vec3::new(1.0, 0.7, 0.3) * offset;
            let edges = [Vec3::X, Vec3::Y * width].map(|v| turn * v);
            let desc = ShapeDesc::Rectangle { corner: far, edges };
            let shape = desc.build().expect("a rectangle");
            let AnyShape::Rectangle(built) = &shape else {
                panic!("{shape:?} is a rectangle");
            };
            let ([x, y], n) = (built.edges(), turn * Vec3::Y);
            let p = far + turn * Vec3::new(0.5, -1.5, 1e-3);
            let ctx = LightSampleContext::surface(p, n, n);
            let mut missing = 0;
            let estimate = Estimate::of(COUNT, || {
                let Some(sample) = shape.sample_toward(&ctx, rng.vec2()) else {
                    missing += 1;
                    return 0.0;
                };
                f64::from(n.dot(sample.wi).max(0.0) / sample.pdf)
            });
            assert_eq!(missing, 0, "at {offset}, width {width}");
            // Corners relative to the receiver: their sums would be rounded.
            let first = far - p;
            let corners = [Vec3::ZERO, x, y, x + y].map(|corner| first + corner);
            let truth = irradiance(corners, Vec3::ZERO, n);
            assert!(
                (estimate.mean - truth).abs() < estimate.margin(truth) + 2e-3 * truth,
                "at {offset}, width {width}: {estimate:?} of {truth}"
            );
        }
    }
}

/// A flat quad is sampled as one wherever it is: the samples are as even as at the origin.
#[test]
fn flat_quads_stay_flat() {
    let mut rng = Rng::new(10);
    let turn = Quat::from_axis_angle(Vec3::new(1.0, 2.0, 0.5).normalize(), 0.8);
    let mut errors = |corners: [Vec3; 4]| {
        OFFSETS.map(|offset| {
            let place = |p: Vec3| Vec3::new(1.0, 0.7, -0.3) * offset + turn * p;
            let shape = ShapeDesc::Quad(corners.map(place)).build().expect("a quad");
            let n = turn * Vec3::NEG_Z;
            let ctx = LightSampleContext::surface(place(Vec3::new(0.5, 0.5, 1.0)), n, n);
            sampled(&shape, &ctx, n, &mut rng).0.standard_error
        })
    };
    let [(_, trapezoid), (_, kite), _, (_, bent)] = quads();
    for corners in [trapezoid, kite] {
        let errors = errors(corners);
        assert!(errors.iter().all(|e| *e < 1.3 * errors[0]), "{errors:?}");
    }
    let (flat, bent) = (errors(trapezoid)[0], errors(bent)[0]);
    assert!(bent > 1.3 * flat, "a bent one has {bent}, not {flat}");
}

/// By how much all light is too bright by MIS, where rays start beside the receiver `from` away from a
/// light at `at`, as far as rounding of points asks for. `is_hit` tells whether a ray meets the light.
fn excess_by_both(
    shape: &dyn Shape,
    [at, from]: [Vec3; 2],
    is_hit: &dyn Fn(Vec3, Vec3) -> bool,
) -> f64 {
    const STEPS: u16 = 512;
    let n = (Vec3::new(0.6, 0.0, 0.8) * 0.7 - from).normalize();
    let error = at.abs() * 8.0 * f32::EPSILON;
    let ctx = LightSampleContext::surface(at + from, n, n).with_error(error);
    let origin = ctx.p + n * n.abs().dot(error);
    let frame = Frame::from_z(n);
    let [mut by_light, mut by_both] = [0.0, 0.0];
    for i in 0..STEPS {
        for j in 0..STEPS {
            let u = (Vec2::new(f32::from(i), f32::from(j)) + 0.5) / f32::from(STEPS);
            if let Some(sample) = shape.sample_toward(&ctx, u) {
                let cos = sample.wi.dot(n).max(0.0);
                let weight = mis::power(sample.pdf, cosine_hemisphere::pdf(cos));
                by_light += f64::from(cos / sample.pdf);
                by_both += f64::from(weight * cos / sample.pdf);
            }
            let local = cosine_hemisphere::sample(u);
            let wi = frame.from_local(local);
            if is_hit(origin, wi) {
                let pdf = cosine_hemisphere::pdf(local.z);
                let weight = mis::power(pdf, shape.pdf_toward(&ctx, wi));
                by_both += f64::from(weight * local.z / pdf);
            }
        }
    }
    by_both / by_light - 1.0
}

/// Where coordinates are large, and on which side of a light the receiver is.
const FAR: Vec3 = Vec3::new(9000.0, -8000.0, 10_000.0);
const SIDES: [Vec3; 2] = [Vec3::new(1.0, -0.5, 0.25), Vec3::new(-0.5, 0.25, 0.75)];

/// Rays start beside their surface, by as much as the rounding of its points, and see a little more
/// of a light on one side and less on the other: the weights of both kinds of samples still
/// balance.
#[test]
fn rays_that_start_beside_the_receiver_have_the_density_of_samples() {
    let tube = ShapeDesc::Cylinder {
        transform: Affine3A::from_rotation_translation(Quat::from_rotation_x(1.2), FAR),
        radius: 0.125,
        length: 1.5,
    };
    for (name, desc) in [("ball", ShapeDesc::sphere(FAR, 0.125)), ("tube", tube)] {
        let shape = desc.build().expect("a shape");
        for from in SIDES {
            let is_hit = |origin, wi| shape.hit(origin, wi).is_some();
            let excess = excess_by_both(&shape, [FAR, from], &is_hit);
            assert!(excess.abs() < 3e-3, "{name} from {from}: {excess}");
        }
    }
}

/// Whether a ray meets a flat shape with the normal z at the height of [`FAR`], of which `inside` tells
/// which points it has, relative to [`FAR`]: in double precision, for `Shape::hit` is wider than the
/// shape by its own rounding.
fn meets_level(origin: Vec3, wi: Vec3, inside: impl Fn(DVec2) -> bool) -> bool {
    let (from, wi) = (origin.as_dvec3() - FAR.as_dvec3(), wi.as_dvec3());
    let t = -from.z / wi.z;
    t > 0.0 && inside((from + wi * t).truncate())
}

#[test]
fn flat_lights_have_the_density_of_samples_beside_the_receiver() {
    type Inside = fn(DVec2) -> bool;
    let (x, y) = (0.25 * Vec3::X, 0.25 * Vec3::Y);
    let triangle = ShapeDesc::Triangle([FAR, FAR + x, FAR + y]);
    let rectangle = ShapeDesc::Rectangle {
        corner: FAR,
        edges: [x, y],
    };
    let disk = ShapeDesc::Disk {
        transform: Affine3A::from_translation(FAR),
        radius: 0.125,
        inner_radius: 0.0,
    };
    let trapezoid = ShapeDesc::Quad([FAR, FAR + x, FAR + y, FAR + 0.5 * x + y]);
    let shapes: [(&str, ShapeDesc, Inside); 4] = [
        ("trapezoid", trapezoid, |p| {
            let right = 0.25 - 0.5 * p.y;
            p.min_element() >= 0.0 && p.y <= 0.25 && p.x <= right
        }),
        ("triangle", triangle, |p| {
            p.min_element() >= 0.0 && p.x + p.y <= 0.25
        }),
        ("rectangle", rectangle, |p| {
            p.min_element() >= 0.0 && p.max_element() <= 0.25
        }),
        ("disk", disk, |p| p.length() <= 0.125),
    ];
    for (name, desc, inside) in shapes {
        let shape = desc.build().expect("a shape");
        for from in SIDES {
            let is_hit = |origin, wi| meets_level(origin, wi, inside);
            let excess = excess_by_both(&shape, [FAR, from], &is_hit);
            assert!(excess.abs() < 3e-3, "{name} from {from}: {excess}");
        }
    }
}
