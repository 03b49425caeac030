use super::{sampling_discrete, sampling_solid_angle, sampling_spherical};
use crate::comparison::Comparison;
use crate::oracle::warp::{bilinear as exact_bilinear, bilinear_pdf, smoothstep_sample};
use crate::{Case, Findings, Malformed, Rule, Tolerance};
use glam::{DVec2, DVec3};
use lights::math::glam::{Vec2, Vec3};
use lights::math::warp::{
    bilinear, concentric_disk, cosine_hemisphere, linear, polar_disk, smoothstep, uniform_cone,
    uniform_hemisphere, uniform_sphere, uniform_triangle,
};

const POLE: Rule = Rule {
    name: "pole",
    reason: "at a pole, or in the centre of a disk, the azimuth is not determined, nor is its \
             inverse",
};

const ZERO_DENSITY: Rule = Rule {
    name: "zero_density",
    reason: "the reference returns a point of density 0 for u at the end of its range, or divides \
             by that density; ours stays off it by 2^-24",
};

const ROOT: Rule = Rule {
    name: "root_of_a_difference",
    reason: "where a component is the root of 1 - cos^2 or the like, rounding under the root is \
             magnified; squares agree to 4 roundings of 1",
};

const ROUNDED_COSINE: Rule = Rule {
    name: "rounded_cosine",
    reason: "the reference inverts a narrow cone by the rounded cosine, which ends within two \
             roundings of ours",
};

const SEARCH: Rule = Rule {
    name: "search_ends_early",
    reason: "the reference's search ends once x is known to 1e-6 or the integral is within 1e-6 of \
             u",
};

/// The routine that `op` names.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    match case.get("op")?.text() {
        Some("uniform_triangle") => {
            let b = findings.ours("b", uniform_triangle::sample(case.get("u")?.vec2()?));
            let theirs = case.get("b")?.vec3()?;
            findings.near3("b", b, theirs, Tolerance::GENERAL);
            let inverse = findings.ours("inverse", uniform_triangle::invert(theirs));
            findings.near2("inv", inverse, case.get("inv")?.vec2()?, Tolerance::GENERAL);
        }
        Some("linear") => linear_density(case, findings)?,
        Some("bilinear") => bilinear_density(case, findings)?,
        Some("smoothstep") => smoothstep_density(case, findings)?,
        Some("disk_concentric") => disk(
            case,
            findings,
            concentric_disk::sample,
            concentric_disk::invert,
        )?,
        Some("disk_polar") => disk(case, findings, polar_disk::sample, polar_disk::invert)?,
        Some("uniform_hemisphere") => directions(
            case,
            findings,
            uniform_hemisphere::sample,
            |w| uniform_hemisphere::pdf(w.z),
            uniform_hemisphere::invert,
        )?,
        Some("uniform_sphere") => directions(
            case,
            findings,
            uniform_sphere::sample,
            |_| uniform_sphere::pdf(),
            uniform_sphere::invert,
        )?,
        Some("cosine_hemisphere") => directions(
            case,
            findings,
            cosine_hemisphere::sample,
            |w| cosine_hemisphere::pdf(w.z),
            cosine_hemisphere::invert,
        )?,
        Some("uniform_cone") => {
            let cap = 1.0 - case.get("cos_theta_max")?.float()?;
            directions(
                case,
                findings,
                |u| uniform_cone::sample(u, cap),
                |_| uniform_cone::pdf(cap),
                |w| uniform_cone::invert(w, cap),
            )?;
        }
        Some("discrete") => sampling_discrete::check(case, findings)?,
        Some("spherical_triangle") => sampling_spherical::triangle(case, findings)?,
        Some("spherical_rectangle") => sampling_spherical::rectangle(case, findings)?,
        Some("spherical_triangle_area") => sampling_solid_angle::triangle_area(case, findings)?,
        Some("spherical_quad_area") => sampling_solid_angle::quad_area(case, findings)?,
        _ => return Err(Malformed("unknown `op`".to_owned())),
    }
    Ok(())
}

/// A point of the unit disk, and its inverse.
fn disk(
    case: &Case<'_>,
    findings: &mut Findings,
    sample: impl Fn(Vec2) -> Vec2,
    invert: impl Fn(Vec2) -> Vec2,
) -> Result<(), Malformed> {
    let theirs = case.get("p")?.vec2()?;
    let ours = findings.ours("p", sample(case.get("u")?.vec2()?));
    findings.near2("p", ours, theirs, Tolerance::GENERAL);
    inverse(case, findings, theirs, invert(theirs))
}

/// A direction, its density and its inverse.
fn directions(
    case: &Case<'_>,
    findings: &mut Findings,
    sample: impl Fn(Vec2) -> Vec3,
    pdf: impl Fn(Vec3) -> f32,
    invert: impl Fn(Vec3) -> Vec2,
) -> Result<(), Malformed> {
    let theirs = case.get("w")?.vec3()?;
    let ours = findings.ours("w", sample(case.get("u")?.vec2()?));
    let roots = ours * ours - theirs * theirs;
    let has_signs = (ours * theirs).min_element() > -4.0 * f32::EPSILON;
    let is_root = has_signs && roots.abs().max_element() < 4.0 * f32::EPSILON;
    if !near3(ours, theirs) && is_root {
        findings.exempt(&ROOT);
    } else {
        findings.near3("w", ours, theirs, Tolerance::GENERAL);
    }
    let density = case.get("pdf")?.float()?;
    if density == 0.0 {
        findings.check(pdf(ours) > 0.0, || format!("density {}", pdf(ours)));
        findings.exempt(&ZERO_DENSITY);
    } else {
        let pdf = findings.ours("pdf", pdf(theirs));
        findings.near("pdf", pdf, density, Tolerance::GENERAL);
    }
    inverse(case, findings, theirs.truncate(), invert(theirs))
}

fn near3(ours: Vec3, theirs: Vec3) -> bool {
    (0..3).all(|i| Tolerance::GENERAL.accepts(ours[i], theirs[i]))
}

/// The inverse of the reference's own answer, whose projection to the disk is `p`.
fn inverse(case: &Case<'_>, findings: &mut Findings, p: Vec2, ours: Vec2) -> Result<(), Malformed> {
    let theirs = case.get("inv")?.vec2()?;
    // At a pole the azimuth is not compared.
    let is_pole = p.abs().max_element() < 1e-6;
    let ours = if is_pole {
        Vec2::new(findings.ours("inverse at a pole", ours.x), ours.y)
    } else {
        findings.ours("inverse", ours)
    };
    if let Some(cos_theta_max) = case.find("cos_theta_max") {
        let error = 2.0 * f32::EPSILON / (1.0 - cos_theta_max.float()?);
        let is_near = Tolerance::GENERAL.accepts(ours.x, theirs.x);
        if !is_near && (ours.x - theirs.x).abs() < error.min(0.1) {
            findings.exempt(&ROUNDED_COSINE);
            if !is_pole {
                findings.near("inv", ours.y, theirs.y, Tolerance::GENERAL);
            }
            return Ok(());
        }
    }
    if is_pole {
        findings.exempt(&POLE);
        findings.near("inv", ours.x, theirs.x, Tolerance::GENERAL);
    } else {
        findings.near2("inv", ours, theirs, Tolerance::GENERAL);
    }
    Ok(())
}

fn linear_density(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let [u, a, b, x] = ["u", "a", "b", "x"].map(|name| case.get(name)?.float());
    let (u, a, b, x) = (u?, a?, b?, x?);
    let ours = findings.ours("x", linear::sample(u, a, b));
    findings.near("x", ours, x, Tolerance::GENERAL);
    let inverse = findings.ours("inverse", linear::invert(x, a, b));
    findings.near(
        "inv",
        inverse,
        case.get("inv")?.float()?,
        Tolerance::GENERAL,
    );
    let density = case.get("pdf")?.float()?;
    if density == 0.0 {
        findings.check(linear::pdf(ours, a, b) > 0.0, || "density 0".to_owned());
        findings.exempt(&ZERO_DENSITY);
    } else {
        let pdf = findings.ours("pdf", linear::pdf(x, a, b));
        findings.near("pdf", pdf, density, Tolerance::GENERAL);
    }
    Ok(())
}

fn bilinear_density(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let w = case.get("w")?.float_array()?;
    let (u, p) = (case.get("u")?.vec2()?, case.get("p")?.vec2()?);
    let ours = findings.ours("p", bilinear::sample(u, w));
    if p.is_nan() {
        return empty_row(u, w, ours, findings);
    }
    findings.near2("p", ours, p, Tolerance::GENERAL);
    let inverse = findings.ours("inverse", bilinear::invert(p, w));
    findings.near2("inv", inverse, case.get("inv")?.vec2()?, Tolerance::GENERAL);
    let density = case.get("pdf")?.float()?;
    if density == 0.0 {
        findings.check(bilinear::pdf(ours, w) > 0.0, || "density 0".to_owned());
        findings.exempt(&ZERO_DENSITY);
    } else {
        let pdf = findings.ours("pdf", bilinear::pdf(p, w));
        findings.near("pdf", pdf, density, Tolerance::GENERAL);
    }
    Ok(())
}

/// On a row without density the reference divides 0 by 0. Ours stays off it by 2^-24, and x is that
/// of the rows beside.
fn empty_row(u: Vec2, w: [f32; 4], ours: Vec2, findings: &mut Findings) -> Result<(), Malformed> {
    let exact_w = w.map(f64::from);
    let u = u.as_dvec2();
    let at = exact_bilinear(u.max(DVec2::new(0.0, 1e-12)), exact_w).as_vec2();
    findings.near2("p on an empty row", ours, at, Tolerance::GENERAL);
    let pdf = findings.ours("pdf", bilinear::pdf(ours, w));
    let exact = bilinear_pdf(ours.as_dvec2(), exact_w) as f32;
    findings.check(pdf > 0.0, || format!("density {pdf}"));
    findings.near("pdf", pdf, exact, Tolerance::new(1e-5, 0.0));
    let inverse = findings.ours("inverse", bilinear::invert(ours, w));
    findings.near2("inv", inverse, u.as_vec2(), Tolerance::GENERAL);
    findings.exempt(&ZERO_DENSITY);
    Ok(())
}

/// The reference's search ends at about 1e-4 of the width, so its own place is where densities are
/// compared.
fn smoothstep_density(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let [u, a, b, x] = ["u", "a", "b", "x"].map(|name| case.get(name)?.float());
    let (u, a, b, x) = (u?, a?, b?, x?);
    let ours = findings.ours("x", smoothstep::sample(u, a, b));
    let mut comparison = Comparison::default();
    comparison.number("x", ours, Some(x), Tolerance::new(0.0, 1e-4 * (b - a)));
    comparison.settle(
        findings,
        || &SEARCH,
        |jitter| {
            let [u, a, b] = [u, a, b].map(|x| jitter.relative(f64::from(x)));
            Some(vec![DVec3::X * (a + (b - a) * smoothstep_sample(u))])
        },
    );
    let density = case.get("pdf")?.float()?;
    if density == 0.0 {
        findings.check(smoothstep::pdf(ours, a, b) > 0.0, || "density 0".to_owned());
        findings.exempt(&ZERO_DENSITY);
    } else {
        let pdf = findings.ours("pdf", smoothstep::pdf(x, a, b));
        findings.near("pdf", pdf, density, Tolerance::GENERAL);
    }
    Ok(())
}
