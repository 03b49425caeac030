use super::*;
use crate::glam::Affine3A;
use core::f32::consts::PI;

/// The share of the light that leaves a point of the wall and arrives at the wall again,
/// against one less the closed form for the two open ends; wherever rounding has put the point.
#[test]
fn the_wall_is_lit_by_itself() {
    let transform = RigidTransform::new(Affine3A::from_axis_angle(Vec3::X, 0.7));
    let tube = Cylinder::new(transform.expect("rigid"), 1.0, 4.0).expect("a tube");
    // H^2 + 1/2 over sqrt(H^2 + 1), less H, of an end at the height 2 = 2 H.
    let expected = 1.0 - 2.0 * (1.5 / sqrt(2.0) - 1.0);
    for moved in [1.0, 1.0 - 2e-7, 1.0 + 2e-7] {
        for turn in [0.0, 0.3, 0.77] {
            let at = tube.at_uv(Vec2::new(turn, 0.5));
            let ctx = LightSampleContext::surface(at.p * moved, -at.n, -at.n);
            let n = 512u16;
            let mut sum = 0.0;
            for i in 0..n * 8 {
                for j in 0..n / 8 {
                    let u = Vec2::new(f32::from(i) + 0.5, f32::from(j) + 0.5);
                    let u = u / Vec2::new(f32::from(n * 8), f32::from(n / 8));
                    let Some(s) = tube.sample_toward(&ctx, u) else {
                        continue;
                    };
                    // Along the wall rounding decides.
                    if at.n.dot(s.wi).abs() < 1e-3 {
                        continue;
                    }
                    let pdf = tube.pdf_toward(&ctx, s.wi);
                    assert!((pdf / s.pdf - 1.0).abs() < 2e-3, "{pdf} and {}", s.pdf);
                    sum += f64::from((-at.n).dot(s.wi).max(0.0) / (PI * s.pdf));
                }
            }
            let share = sum / f64::from(u32::from(n) * u32::from(n));
            let off = share - f64::from(expected);
            assert!(off.abs() < 5e-3, "{moved}, {turn}: {share}, not {expected}");
        }
    }
}

/// Points lie on the side that they are seen from by more than rounding, also those of the far
/// wall: the cylinder does not hide its own light.
#[test]
fn samples_lie_before_the_wall() {
    for center in [Vec3::ZERO, Vec3::new(3e4, -1e3, 20.0)] {
        let transform = RigidTransform::new(Affine3A::from_translation(center));
        let tube = Cylinder::new(transform.expect("rigid"), 0.7, 1.5).expect("a tube");
        for (from, sides) in [
            (Vec3::new(1.5, 0.4, -0.2), [true, false]),
            (Vec3::new(0.3, 0.1, 0.2), [false, true]),
            (Vec3::new(0.8, -0.2, 2.0), [true, true]),
        ] {
            let ctx = LightSampleContext::medium(center + from);
            let mut seen = [false; 2];
            for i in 0..256u16 {
                let u = Vec2::new(f32::from(i % 16), f32::from(i / 16));
                let u = (u + 0.5) / 16.0;
                let sample = tube.sample_toward(&ctx, u).expect("a point");
                let is_inner = sample.at.n.dot(sample.wi) > 0.0;
                seen[usize::from(is_inner)] = true;
                let across = (sample.at.p.as_dvec3() - center.as_dvec3()).truncate();
                let is_inside = across.length() < f64::from(tube.radius);
                assert_eq!(is_inside, is_inner, "{center}, {from}: {sample:?}");
            }
            assert_eq!(seen, sides, "the walls seen from {from}");
        }
    }
}
