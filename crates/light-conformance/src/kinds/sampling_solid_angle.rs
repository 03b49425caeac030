//! Solid angles of three and four directions.

use super::sampling_spherical::moved;
use crate::comparison::Comparison;
use crate::oracle::{ExactTriangle, Jitter};
use crate::{Case, Findings, Malformed, Rule, Tolerance};
use glam::DVec3;
use lights::math::glam::Vec3;
use lights::math::solid_angle;
use std::f64::consts::PI;

const SINGLE: Rule = Rule {
    name: "single_precision",
    reason: "the reference adds angles in single precision, or answers half of the sphere for \
             directions in one plane through the point, which ours counts as nothing; ours is an \
             answer in double precision",
};

const OPPOSITE: Rule = Rule {
    name: "opposite_corners",
    reason: "two neighbouring corners are opposite directions, so the side between them is not \
             determined",
};

const QUAD: Rule = Rule {
    name: "not_convex",
    reason: "the reference adds four angles below pi each, which is an area only if there are four \
             corners, none is re-entrant, no sides cross and not all are in one plane; ours are \
             two triangles in double precision",
};

/// The solid angle of three directions.
pub(super) fn triangle_area(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let [a, b, c] = ["a", "b", "c"].map(|name| case.get(name)?.vec3());
    let v = [a?, b?, c?];
    let ours = solid_angle::triangle(v, Vec3::ZERO);
    if (0..3).any(|i| are_opposite(v[i], v[(i + 1) % 3])) {
        findings.check((0.0..=std::f32::consts::TAU).contains(&ours), || {
            format!("area {ours}")
        });
        findings.exempt(&OPPOSITE);
        return Ok(());
    }
    compare_area(case, findings, ours, &SINGLE, |jitter| {
        signed_area(v.map(|v| moved(v, 1.0, jitter)), jitter).abs()
    })
}

/// The solid angle of four directions.
pub(super) fn quad_area(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| case.get(name)?.vec3());
    let v = [a?, b?, c?, d?];
    let ours = solid_angle::quad(v, Vec3::ZERO);
    if (0..4).any(|i| are_opposite(v[i], v[(i + 1) % 4])) || are_opposite(v[0], v[2]) {
        findings.check((0.0..=2.0 * std::f32::consts::TAU).contains(&ours), || {
            format!("area {ours}")
        });
        findings.exempt(&OPPOSITE);
        return Ok(());
    }
    compare_area(case, findings, ours, &QUAD, |jitter| {
        two_triangles(v.map(|v| moved(v, 1.0, jitter)), jitter)
    })
}

/// Compares our solid angle with the reference's and, where they differ by `rule`, with `exact`.
fn compare_area(
    case: &Case<'_>,
    findings: &mut Findings,
    ours: f32,
    rule: &'static Rule,
    exact: impl Fn(&mut Jitter) -> f64,
) -> Result<(), Malformed> {
    let mut comparison = Comparison::default();
    let ours = findings.ours("area", ours);
    let theirs = Some(case.get("area")?.float()?);
    comparison.number("area", ours, theirs, Tolerance::GENERAL);
    let exact = |jitter: &mut Jitter| Some(vec![DVec3::X * exact(jitter)]);
    comparison.settle(findings, || rule, exact);
    Ok(())
}

/// The two triangles beside the diagonal that looks shorter, with signs; the smaller of both sides
/// of the sphere.
fn two_triangles([a, b, c, d]: [DVec3; 4], jitter: &mut Jitter) -> f64 {
    let cosine = |a: DVec3, b: DVec3| a.normalize().dot(b.normalize());
    let triangles = if jitter.at_scale(cosine(a, c) - cosine(b, d), 1.0) >= 0.0 {
        [[a, b, c], [a, c, d]]
    } else {
        [[b, c, d], [b, d, a]]
    };
    let sum = triangles
        .map(|v| signed_area(v, jitter))
        .iter()
        .sum::<f64>();
    sum.abs().min(4.0 * PI - sum.abs())
}

/// The solid angle of three unit vectors, negative if they run clockwise. Where they are in one
/// plane up to rounding it is 0 by definition, and near 2 pi if they go all around.
fn signed_area(v: [DVec3; 3], jitter: &mut Jitter) -> f64 {
    const ROUNDING: f64 = 16.0 * f32::EPSILON as f64;
    let volume = v[0].dot(v[1].cross(v[2]));
    let area = volume.signum() * ExactTriangle::new(v, DVec3::ZERO).solid_angle();
    if volume.abs() < ROUNDING {
        jitter.either(area, 0.0)
    } else {
        area
    }
}

/// Whether two unit vectors point opposite ways up to rounding.
fn are_opposite(a: Vec3, b: Vec3) -> bool {
    (a + b).abs().max_element() < 4.0 * f32::EPSILON
}
