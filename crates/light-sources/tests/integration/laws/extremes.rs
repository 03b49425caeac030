//! Shapes that are tiny, far away, seen from their edge, or fill almost half of the view.

use light_sources::glam::{Affine3A, Vec3};
use light_sources::light_bounds::LightSampleContext;
use light_sources::light_math::solid_angle;
use light_sources::shape::{AnyShape, Shape, ShapeDesc};
use light_testkit::{Estimate, Rng};

/// One of each shape, of about unit size, around the origin.
fn shapes() -> [ShapeDesc; 6] {
    let transform = Affine3A::IDENTITY;
    [
        ShapeDesc::Triangle([Vec3::NEG_X, Vec3::X, Vec3::Y]),
        ShapeDesc::Rectangle {
            corner: Vec3::new(-1.0, -0.5, 0.0),
            edges: [Vec3::X * 2.0, Vec3::Y],
        },
        ShapeDesc::Quad([Vec3::NEG_X, Vec3::X, Vec3::Y, Vec3::new(1.5, 1.0, 0.0)]),
        ShapeDesc::Sphere {
            transform,
            radius: 1.0,
        },
        ShapeDesc::Disk {
            transform,
            radius: 1.0,
            inner_radius: 0.3,
        },
        ShapeDesc::Cylinder {
            transform,
            radius: 0.5,
            length: 2.0,
        },
    ]
}

/// Where points are, in units of the shape: very near, near, far, so far that the shape is a few
/// ulps wide.
const DISTANCES: [f32; 6] = [1e-4, 1e-2, 1.0, 30.0, 3e3, 1e5];

/// Whatever the distance and the angle, samples are on the shape, and their density is that of
/// their direction.
///
/// One in a hundred may lie so near to an edge that the rounding of its direction decides.
#[test]
fn samples_carry_the_density_of_their_direction() {
    let mut rng = Rng::new(61);
    for desc in shapes() {
        let shape = desc.build().expect("a shape");
        for distance in DISTANCES {
            let (mut taken, mut strays) = (0u32, 0u32);
            for _ in 0..2000 {
                let on = shape.sample(rng.vec2()).expect("an area").at.p;
                let n = rng.direction();
                let ctx = LightSampleContext::surface(on + rng.direction() * distance, n, n);
                let Some(sample) = shape.sample_toward(&ctx, rng.vec2()) else {
                    continue;
                };
                let again = shape.pdf_toward(&ctx, sample.wi);
                let is_valid = sample.pdf > 0.0 && sample.pdf.is_finite() && again.is_finite();
                assert!(is_valid, "{desc:?} from {ctx:?}: {sample:?}");
                assert!(
                    sample.wi.is_normalized(),
                    "{desc:?} from {ctx:?}: {sample:?}"
                );
                taken += 1;
                strays += u32::from((again / sample.pdf - 1.0).abs() > 0.02);
            }
            assert!(taken > 1500, "{desc:?} at {distance}: {taken} samples");
            let stray = f64::from(strays) / f64::from(taken);
            assert!(
                stray < 0.01,
                "{desc:?} at {distance}: {stray} of the samples disagree"
            );
        }
    }
}

/// The mean of the inverse density is the solid angle, exact by other means, from 1e-10 sr up to
/// almost half a sphere.
#[test]
fn inverse_densities_add_up_to_the_solid_angle() {
    let mut rng = Rng::new(62);
    for desc in shapes() {
        let shape = desc.build().expect("a shape");
        for distance in DISTANCES {
            // Above the shape and a little to the side, so that planar ones are not seen from their
            // edge.
            let p = Vec3::new(0.1, 0.2, distance);
            let ctx = LightSampleContext::medium(p);
            let Some(truth) = exact_solid_angle(&shape, p) else {
                continue;
            };
            let estimate = Estimate::of(1 << 13, || {
                let sample = shape.sample_toward(&ctx, rng.vec2());
                sample.map_or(0.0, |s| 1.0 / f64::from(s.pdf))
            });
            let margin = estimate.margin(truth) + 1e-3 * truth;
            assert!(
                (estimate.mean - truth).abs() < margin,
                "{desc:?} at {distance}: {truth}, {estimate:?}"
            );
        }
    }
}

/// The solid angle of the shapes that have a closed form, from where they have one.
fn exact_solid_angle(shape: &AnyShape, p: Vec3) -> Option<f64> {
    Some(match shape {
        AnyShape::Triangle(triangle) => f64::from(solid_angle::triangle(triangle.vertices(), p)),
        AnyShape::Rectangle(_) => {
            let x = Vec3::X;
            let corner = Vec3::new(-1.0, -0.5, 0.0);
            let corners = [
                corner,
                corner + 2.0 * x,
                corner + 2.0 * x + Vec3::Y,
                corner + Vec3::Y,
            ];
            f64::from(solid_angle::quad(corners, p))
        }
        AnyShape::BilinearPatch(patch) => {
            let [p00, p10, p01, p11] = patch.corners();
            f64::from(solid_angle::quad([p00, p10, p11, p01], p))
        }
        AnyShape::Sphere(_) => {
            let dist_sq = f64::from(p.length()).powi(2);
            if dist_sq <= 1.0 {
                return None;
            }
            let sin_sq = 1.0 / dist_sq;
            core::f64::consts::TAU * sin_sq / (1.0 + (1.0 - sin_sq).sqrt())
        }
        _ => return None,
    })
}

/// What a receiver gets from a large triangle or rectangle varies less when its cosine guides the
/// samples.
#[test]
fn the_receivers_cosine_cuts_the_variance() {
    for desc in &shapes()[..2] {
        let shape = desc.build().expect("a shape");
        let n = Vec3::new(0.7, 0.2, -0.6).normalize();
        let p = Vec3::new(0.0, 0.2, 1.2);
        let error = |ctx: LightSampleContext| {
            let mut rng = Rng::new(63);
            let estimate = Estimate::of(1 << 13, || {
                let sample = shape.sample_toward(&ctx, rng.vec2());
                sample.map_or(0.0, |s| f64::from(n.dot(s.wi).max(0.0) / s.pdf))
            });
            (estimate.mean, estimate.standard_error)
        };
        let (mean, with) = error(LightSampleContext::surface(p, n, n));
        let (again, without) = error(LightSampleContext::medium(p));
        assert!(
            (mean - again).abs() < 5.0 * (with + without),
            "{desc:?}: {mean}, {again}"
        );
        assert!(with < 0.5 * without, "{desc:?}: {with}, {without}");
    }
}
