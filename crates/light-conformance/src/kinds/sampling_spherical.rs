//! Triangles and rectangles seen from a point.

use crate::comparison::Comparison;
use crate::oracle::{ExactRectangle, ExactTriangle, Jitter};
use crate::{Case, Findings, Malformed, Rule, Tolerance};
use glam::{DVec2, DVec3, Vec2, Vec3};
use lights::math::warp::{SphericalRectangle, SphericalTriangle};

const SINGLE: Rule = Rule {
    name: "single_precision",
    reason: "the reference adds and subtracts angles and cosines in single precision; ours is the \
             answer in double precision",
};

const AREA_SAMPLING: Rule = Rule {
    name: "area_sampling_below_1e-3",
    reason: "the reference samples the area of small rectangles, which is not what its density \
             says; ours is the answer in double precision",
};

const SINGULAR: Rule = Rule {
    name: "singular_inverse",
    reason: "at the second corner every u.x leads to the same direction",
};

const DEGENERATE: Rule = Rule {
    name: "degenerate",
    reason: "the point lies in the plane up to rounding: there is no solid angle to sample",
};

const RELATIVE: Tolerance = Tolerance::new(1e-5, 0.0);

/// The answers of a triangle or a rectangle, and the reference's.
struct Answers {
    omega: f32,
    pdf: f32,
    place: Vec3,
    u: Vec2,
}

/// What the oracle says of the same, for moved corners.
struct Truths<'a> {
    omega: &'a dyn Fn(&mut Jitter) -> f64,
    place: &'a dyn Fn(&mut Jitter) -> DVec3,
    u: &'a dyn Fn(&mut Jitter) -> DVec2,
}

/// Compares all but what is not determined: the first number of the inverse at a singularity.
fn compare(
    ours: &Answers,
    theirs: &Answers,
    truths: &Truths<'_>,
    [place_rule, inverse_rule]: [&'static Rule; 2],
    is_singular: bool,
    findings: &mut Findings,
) {
    // Where the reference finds nothing to sample, it says nothing.
    let said = (theirs.pdf > 0.0).then_some(theirs);
    let mut comparison = Comparison::default();
    let omega = findings.ours("solid angle", ours.omega);
    comparison.number("solid angle", omega, said.map(|t| t.omega), RELATIVE);
    comparison.ill_conditioned();
    let exact = |jitter: &mut Jitter| DVec3::X * (truths.omega)(jitter);
    comparison.settle(findings, || &SINGLE, |jitter| Some(vec![exact(jitter)]));

    // One over that solid angle.
    let mut pdf = Comparison::default();
    let answer = findings.ours("pdf", ours.pdf);
    pdf.number("pdf", answer, said.map(|t| t.pdf), Tolerance::GENERAL);
    let exact = DVec3::X / f64::from(omega);
    pdf.settle(findings, || &SINGLE, |_| Some(vec![exact]));

    let mut place = Comparison::default();
    let answer = findings.ours("place", ours.place);
    place.vec3("place", answer, said.map(|t| t.place), Tolerance::GENERAL);
    place.ill_conditioned();
    let exact = |jitter: &mut Jitter| Some(vec![(truths.place)(jitter)]);
    place.settle(findings, || place_rule, exact);

    let mut u = Comparison::default();
    let (mut answer, mut said) = (ours.u, said.map(|t| t.u));
    if is_singular {
        findings.exempt(&SINGULAR);
        answer.x = 0.0;
        said = said.map(|u| Vec2::new(0.0, u.y));
    }
    let answer = findings.ours("inverse", answer);
    u.vec2("inverse", answer, said, Tolerance::GENERAL);
    u.ill_conditioned();
    let exact = |jitter: &mut Jitter| {
        let mut u = (truths.u)(jitter).clamp(DVec2::ZERO, DVec2::ONE);
        if is_singular {
            u.x = 0.0;
        }
        Some(vec![u.extend(0.0)])
    };
    u.settle(findings, || inverse_rule, exact);
}

/// How near to the plane of a shape, over its distance, a point is in it up to rounding.
const IN_PLANE: f64 = 8.0 * f32::EPSILON as f64;

/// Where the point is in the plane up to rounding there is nothing to sample, or next to nothing.
fn check_degenerate(ours: Option<(f32, f32, Vec3)>, findings: &mut Findings) {
    findings.exempt(&DEGENERATE);
    let Some((omega, pdf, place)) = ours else {
        return findings.check(true, String::new);
    };
    let pdf = findings.ours("degenerate pdf", pdf);
    let is_usable = (pdf * omega - 1.0).abs() < 1e-5
        && place.cmpge(Vec3::ZERO).all()
        && place.cmple(Vec3::ONE).all();
    findings.check(is_usable, || {
        format!("solid angle {omega}, pdf {pdf}, {place}")
    });
}

/// Solid angle, barycentric coordinates, density and inverse.
pub(super) fn triangle(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let v = case.get("v")?;
    let v = [v.at(0)?.vec3()?, v.at(1)?.vec3()?, v.at(2)?.vec3()?];
    let (p, u) = (case.get("p")?.vec3()?, case.get("u")?.vec2()?);
    let exact = |jitter: &mut Jitter| moved_triangle(v, p, jitter);
    let omega = |jitter: &mut Jitter| exact(jitter).solid_angle();
    let seen = SphericalTriangle::new(v, p);
    let [a, b, c] = v.map(|v| (v - p).as_dvec3().normalize());
    let edges = (b - a).length().min((c - a).length());
    if a.dot((b - a).cross(c - a)).abs() <= IN_PLANE * edges {
        let ours = seen.map(|s| (s.solid_angle(), s.pdf(), s.sample(u)));
        check_degenerate(ours, findings);
        return Ok(());
    }
    let Some(seen) = findings.ours_if_any("triangle", seen) else {
        findings.fail("no triangle".to_owned());
        return Ok(());
    };
    let theirs = answers(case, case.find("b").map(|b| b.vec3()).transpose()?)?;
    // The inverse of the reference's own place, or of ours.
    let b = if theirs.pdf > 0.0 {
        theirs.place
    } else {
        seen.sample(u)
    };
    let ours = Answers {
        omega: seen.solid_angle(),
        pdf: seen.pdf(),
        place: seen.sample(u),
        u: seen.invert(b),
    };
    let truths = Truths {
        omega: &omega,
        place: &|jitter| exact(jitter).sample(jitter.numbers(u.as_dvec2())),
        u: &|jitter| exact(jitter).invert(b.as_dvec3()),
    };
    let is_singular = u.y < 1e-6 || b.x + b.z < 1e-6;
    compare(&ours, &theirs, &truths, [&SINGLE; 2], is_singular, findings);
    Ok(())
}

/// Solid angle, place, density and inverse.
pub(super) fn rectangle(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let [s, ex, ey, p] = ["s", "ex", "ey", "p"].map(|name| case.get(name)?.vec3());
    let (s, ex, ey, p) = (s?, ex?, ey?, p?);
    let u = case.get("u")?.vec2()?;
    let exact = |jitter: &mut Jitter| {
        let [s, p] = [s, p].map(|v| moved(v, s.abs().max(p.abs()).max_element(), jitter));
        let [ex, ey] = [ex, ey].map(|v| moved(v, v.length(), jitter));
        ExactRectangle::new(s, ex, ey.reject_from(ex), p)
    };
    let omega = |jitter: &mut Jitter| exact(jitter).solid_angle();
    let seen = SphericalRectangle::new(s, ex, ey, p);
    let normal = ex.as_dvec3().cross(ey.as_dvec3()).normalize();
    let corners = [s, s + ex, s + ey, s + ex + ey].map(|v| v.distance(p));
    let nearest = corners.into_iter().fold(f32::INFINITY, f32::min);
    if (s - p).as_dvec3().dot(normal).abs() <= IN_PLANE * f64::from(nearest) {
        let ours = seen.map(|s| (s.solid_angle(), s.pdf(), s.sample(u).extend(0.0)));
        check_degenerate(ours, findings);
        return Ok(());
    }
    let Some(seen) = findings.ours_if_any("rectangle", seen) else {
        findings.fail("no rectangle".to_owned());
        return Ok(());
    };
    let place = |q: Vec3| {
        let along = |edge: Vec3| (q - s).dot(edge) / edge.length_squared();
        Vec3::new(along(ex), along(ey), 0.0)
    };
    let q = case.find("q").map(|q| q.vec3()).transpose()?;
    let theirs = answers(case, q.map(place))?;
    let at = if theirs.pdf > 0.0 {
        theirs.place.truncate()
    } else {
        seen.sample(u)
    };
    let ours = Answers {
        omega: seen.solid_angle(),
        pdf: seen.pdf(),
        place: seen.sample(u).extend(0.0),
        u: seen.invert(at),
    };
    let truths = Truths {
        omega: &omega,
        place: &|jitter| {
            let at = exact(jitter).sample(jitter.numbers(u.as_dvec2()));
            at.extend(0.0)
        },
        u: &|jitter| {
            let at = at.as_dvec2().clamp(DVec2::ZERO, DVec2::ONE);
            exact(jitter).invert(at)
        },
    };
    let rule = if theirs.omega < 1e-3 {
        &AREA_SAMPLING
    } else {
        &SINGLE
    };
    compare(&ours, &theirs, &truths, [rule; 2], false, findings);
    Ok(())
}

/// The reference's answers; those that it lacks are of density 0.
fn answers(case: &Case<'_>, place: Option<Vec3>) -> Result<Answers, Malformed> {
    let number = |name| case.find(name).map_or(Ok(0.0), |x| x.float());
    let u = case.find("inv").map(|u| u.vec2()).transpose()?;
    let is_said = place.is_some() && u.is_some();
    Ok(Answers {
        omega: number("solid_angle")?,
        pdf: if is_said { number("pdf")? } else { 0.0 },
        place: place.unwrap_or_default(),
        u: u.unwrap_or_default(),
    })
}

pub(super) fn moved(v: Vec3, magnitude: f32, jitter: &mut Jitter) -> DVec3 {
    jitter.vector(v.as_dvec3(), f64::from(magnitude))
}

fn moved_triangle(v: [Vec3; 3], p: Vec3, jitter: &mut Jitter) -> ExactTriangle {
    let magnitude = |v: Vec3| v.abs().max(p.abs()).max_element();
    let v = v.map(|v| moved(v, magnitude(v), jitter));
    ExactTriangle::new(v, p.as_dvec3())
}
