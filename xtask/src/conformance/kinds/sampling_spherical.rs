//! Triangles and rectangles seen from a point.

use crate::conformance::exact::{ExactRectangle, ExactTriangle};
use crate::conformance::{Case, Findings, Malformed, Rule, Tolerance};
use lights::math::glam::{Vec2, Vec3};
use lights::math::solid_angle;
use lights::math::warp::{SphericalRectangle, SphericalTriangle};

const CLOSER: Rule = Rule {
    name: "closer_to_double_precision",
    reason: "the reference adds and subtracts angles and cosines in single precision; computed in double precision, \
             the answer is at least as near to ours as to the reference",
};

const ROUNDED_CORNERS: Rule = Rule {
    name: "rounded_corners",
    reason: "where the point is almost in the plane, or the shape is a sliver, moving the corners or u by 4 ulps moves \
             the answer in double precision by as much as ours is off",
};

const AREA_SAMPLING: Rule = Rule {
    name: "area_sampling_below_1e-3",
    reason: "the reference samples the area of small rectangles, which is not what its density says; ours agrees \
             with double precision",
};

const SINGULAR: Rule = Rule {
    name: "singular_inverse",
    reason: "at the second corner every u.x leads to the same direction",
};

const DEGENERATE: Rule = Rule {
    name: "degenerate",
    reason: "the reference found no solid angle to sample and answers with density 0, or ours found none",
};

const OPPOSITE: Rule = Rule {
    name: "opposite_corners",
    reason: "two neighbouring corners are opposite directions, so the side between them is not determined",
};

const REPEATED: Rule = Rule {
    name: "repeated_corner",
    reason: "two corners are the same: the reference answers 0, ours is the triangle that is left",
};

const IN_PLANE: Rule = Rule {
    name: "in_plane",
    reason: "all directions lie in one plane through the point: the reference answers half of the sphere, ours 0",
};

const NOT_CONVEX: Rule = Rule {
    name: "not_convex",
    reason: "the reference adds four angles below pi each, which is an area only if no corner is re-entrant and no \
             sides cross",
};

/// Solid angle, barycentric coordinates, density and inverse.
pub(super) fn triangle(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let v = case.get("v")?;
    let v = [v.at(0)?.vec3()?, v.at(1)?.vec3()?, v.at(2)?.vec3()?];
    let (p, u) = (case.get("p")?.vec3()?, case.get("u")?.vec2()?);
    let pdf = case.get("pdf")?.float()?;
    let Some(ours) = SphericalTriangle::new(v, p).filter(|_| pdf > 0.0) else {
        findings.exempt(&DEGENERATE);
        return Ok(());
    };
    let exact = |step: usize| ExactTriangle::new(moved(v, step), p);
    let omega = case.get("solid_angle")?.float()?;
    let mut judge = Judge {
        rule: &CLOSER,
        findings,
    };
    judge.compare("solid angle", [ours.solid_angle()], [omega], |i| {
        [exact(i).solid_angle() as f32]
    });
    judge.compare("pdf", [ours.pdf()], [pdf], |i| {
        [1.0 / exact(i).solid_angle() as f32]
    });
    let b = case.get("b")?.vec3()?;
    judge.compare("b", ours.sample(u).to_array(), b.to_array(), |i| {
        exact(i).sample(moved_u(u, i)).to_array()
    });
    if u.y < 1e-6 {
        findings.exempt(&SINGULAR);
        return Ok(());
    }
    let inv = case.get("inv")?.vec2()?;
    judge.compare("inv", ours.invert(b).to_array(), inv.to_array(), |i| {
        exact(i).invert(b).clamp(Vec2::ZERO, Vec2::ONE).to_array()
    });
    Ok(())
}

/// Solid angle, place, density and inverse.
pub(super) fn rectangle(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let [s, ex, ey, p] = ["s", "ex", "ey", "p"].map(|name| case.get(name)?.vec3());
    let (s, ex, ey, p) = (s?, ex?, ey?, p?);
    let (u, pdf) = (case.get("u")?.vec2()?, case.get("pdf")?.float()?);
    let Some(ours) = SphericalRectangle::new(s, ex, ey, p).filter(|_| pdf > 0.0) else {
        findings.exempt(&DEGENERATE);
        return Ok(());
    };
    let exact = |step: usize| {
        let [s, ex, ey] = moved([s, ex, ey], step);
        ExactRectangle::new(s, ex, ey, p)
    };
    let omega = case.get("solid_angle")?.float()?;
    let mut judge = Judge {
        rule: &CLOSER,
        findings,
    };
    judge.compare("solid angle", [ours.solid_angle()], [omega], |i| {
        [exact(i).solid_angle() as f32]
    });
    judge.compare("pdf", [ours.pdf()], [pdf], |i| {
        [1.0 / exact(i).solid_angle() as f32]
    });
    if omega < 1e-3 {
        judge.rule = &AREA_SAMPLING;
    }
    let q = case.get("q")?.vec3()? - s;
    let place = Vec2::new(
        q.dot(ex) / ex.length_squared(),
        q.dot(ey) / ey.length_squared(),
    );
    judge.compare("q", ours.sample(u).to_array(), place.to_array(), |i| {
        exact(i).sample(moved_u(u, i)).to_array()
    });
    let inv = case.get("inv")?.vec2()?;
    judge.compare("inv", ours.invert(place).to_array(), inv.to_array(), |i| {
        exact(i)
            .invert(place)
            .clamp(Vec2::ZERO, Vec2::ONE)
            .to_array()
    });
    Ok(())
}

/// The solid angle of three directions.
pub(super) fn triangle_area(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let [a, b, c] = ["a", "b", "c"].map(|name| case.get(name)?.vec3());
    let v = [a?, b?, c?];
    if (0..3).any(|i| are_opposite(v[i], v[(i + 1) % 3])) {
        findings.exempt(&OPPOSITE);
        return Ok(());
    }
    let ours = solid_angle::triangle(v, Vec3::ZERO);
    let exact = |i| [ExactTriangle::new(moved(v, i), Vec3::ZERO).solid_angle() as f32];
    let area = case.get("area")?.float()?;
    Judge {
        rule: &CLOSER,
        findings,
    }
    .compare("area", [ours], [area], exact);
    Ok(())
}

/// The solid angle of four directions.
pub(super) fn quad_area(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| case.get(name)?.vec3());
    let v = [a?, b?, c?, d?];
    let sides = [0, 1, 2, 3].map(|i| (v[i], v[(i + 1) % 4]));
    let turns = [0, 1, 2, 3].map(|i| v[i].cross(v[(i + 1) % 4]).dot(v[(i + 2) % 4]));
    let rule = if sides.iter().any(|&(a, b)| are_opposite(a, b)) {
        Some(&OPPOSITE)
    } else if sides.iter().any(|&(a, b)| a == b) {
        Some(&REPEATED)
    } else if turns.iter().all(|&t| t.abs() < 4.0 * f32::EPSILON) {
        Some(&IN_PLANE)
    } else if turns.iter().any(|&t| t > 0.0) && turns.iter().any(|&t| t < 0.0) {
        Some(&NOT_CONVEX)
    } else {
        None
    };
    if let Some(rule) = rule {
        findings.exempt(rule);
        return Ok(());
    }
    let ours = solid_angle::quad(v, Vec3::ZERO);
    findings.near("area", ours, case.get("area")?.float()?, Tolerance::GENERAL);
    Ok(())
}

/// Compares numbers; where they differ, double precision decides.
struct Judge<'a> {
    rule: &'static Rule,
    findings: &'a mut Findings,
}

impl Judge<'_> {
    /// `exact` answers in double precision for the corners, and for corners moved in the way of a step above 0.
    fn compare<const N: usize>(
        &mut self,
        what: &str,
        ours: [f32; N],
        theirs: [f32; N],
        exact: impl Fn(usize) -> [f32; N],
    ) {
        let mut pairs = ours.iter().zip(&theirs);
        if pairs.all(|(&ours, &theirs)| Tolerance::GENERAL.accepts(ours, theirs)) {
            self.findings.check(true, String::new);
            return;
        }
        let truth = exact(0);
        let largest = truth.iter().fold(1.0, |m: f32, x| m.max(x.abs()));
        let rounding = 16.0 * f32::EPSILON * largest;
        let error = |x: [f32; N]| {
            let errors = x.iter().zip(&truth).map(|(x, truth)| (x - truth).abs());
            errors.fold(
                0.0,
                |m: f32, e| if e.is_nan() { f32::INFINITY } else { m.max(e) },
            )
        };
        let (our_error, their_error) = (error(ours), error(theirs));
        if our_error <= their_error + rounding {
            self.findings.exempt(self.rule);
            return;
        }
        let spread = (1..=STEPS).map(|i| error(exact(i))).fold(0.0, f32::max);
        self.findings.check(our_error <= spread + rounding, || {
            format!("{what}: {ours:?} ({our_error}), reference {theirs:?} ({their_error}), exact {truth:?} ({spread})")
        });
        self.findings.exempt(&ROUNDED_CORNERS);
    }
}

/// Whether two unit vectors point opposite ways up to rounding.
fn are_opposite(a: Vec3, b: Vec3) -> bool {
    (a + b).abs().max_element() < 4.0 * f32::EPSILON
}

/// `u` with every coordinate moved by 4 ulps, differently for each `step` above 0.
fn moved_u(u: Vec2, step: usize) -> Vec2 {
    let [u, ..] = moved([u.extend(0.0); 3], step);
    u.truncate()
}

/// How many ways there are to move corners.
const STEPS: usize = 16;

/// The corners with every coordinate moved by 4 ulps up or down, differently for each `step` above 0.
fn moved(v: [Vec3; 3], step: usize) -> [Vec3; 3] {
    if step == 0 {
        return v;
    }
    core::array::from_fn(|i| {
        let signs = Vec3::from_array(core::array::from_fn(|k| {
            let bit = (step * 0x9e37_79b9) >> (3 * i + k + 8) & 1;
            if bit == 0 { -1.0 } else { 1.0 }
        }));
        v[i] + v[i] * signs * (4.0 * f32::EPSILON)
    })
}
