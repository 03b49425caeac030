use super::tables::{U_ROUNDING, check_integral, check_inverse, refuses_signs, unless_zero};
use crate::comparison::Comparison;
use crate::{Case, Findings, Malformed, Tolerance};
use glam::{DVec2, DVec3};
use lights::math::distribution::PiecewiseConstant2D;
use lights::math::glam::Vec2;

/// Integral, samples, densities and inverses, on the given domain.
pub(super) fn check(case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let func = case.get("func")?.floats()?;
    let (nx, ny) = (case.get("nx")?.index()?, case.get("ny")?.index()?);
    let domain = case.get("domain")?;
    let (min, max) = (domain.at(0)?.vec2()?, domain.at(1)?.vec2()?);
    refuses_signs(
        &func,
        |w| PiecewiseConstant2D::new(w, nx, ny).map(|_| ()),
        findings,
    );
    let weights: Vec<f32> = func.iter().map(|f| f.abs()).collect();
    let table = PiecewiseConstant2D::new(&weights, nx, ny).and_then(|t| t.over(min, max));
    let Some(table) = unless_zero(table, &weights, findings)? else {
        return Ok(());
    };

    check_integral(table.integral(), case, findings)?;
    let exact = super::tables::table(&weights, nx, ny);
    let (low, size) = (min.as_dvec2(), max.as_dvec2() - min.as_dvec2());
    let absolute = 1e-5 * (max - min).max_element();
    let place = Tolerance::new(1e-5, absolute);
    for sample in case.get("samples")?.items()? {
        let [u0, u1, x, y, pdf, ix, iy] = sample.float_array()?;
        let u = Vec2::new(u0, u1);
        let ours = table.sample(u);
        let mut comparison = Comparison::default();
        let p = findings.ours("p", ours.p);
        comparison.vec2("p", p, Some(Vec2::new(x, y)), place);
        comparison.ill_conditioned();
        let our_pdf = findings.ours("pdf of the sample", ours.pdf);
        comparison.number("pdf", our_pdf, Some(pdf), Tolerance::GENERAL);
        let texel = findings.ours("texel", ours.texel.map(|i| i as i64));
        let texel = Vec2::new(texel[0] as f32, texel[1] as f32);
        let their_texel = Some(Vec2::new(ix, iy));
        comparison.vec2("texel", texel, their_texel, Tolerance::new(0.0, 0.0));
        comparison.settle(
            findings,
            || &U_ROUNDING,
            |jitter| {
                // Any texel whose sums rounding may lead to; ours is one of them.
                let (at, pdf) = exact.sample_in(u.as_dvec2(), ours.texel, jitter)?;
                let texel = DVec2::new(ours.texel[0] as f64, ours.texel[1] as f64);
                let pdf = pdf / size.element_product();
                let p = low + at * size;
                Some(vec![p.extend(0.0), DVec3::X * pdf, texel.extend(0.0)])
            },
        );
    }
    for query in case.get("pdfs")?.items()? {
        let [x, y, pdf] = query.float_array()?;
        let p = Vec2::new(x, y);
        let mut comparison = Comparison::default();
        let ours = findings.ours("pdf", table.pdf(p));
        comparison.number("pdf", ours, Some(pdf), Tolerance::GENERAL);
        comparison.settle(
            findings,
            || &U_ROUNDING,
            |jitter| {
                let magnitude = f64::from(max.abs().max(min.abs()).max_element());
                let p = p.as_dvec2().map(|x| jitter.at_scale(x, magnitude));
                let pdf = exact.pdf((p - low) / size) / size.element_product();
                Some(vec![DVec3::X * pdf])
            },
        );
    }
    for inverse in case.get("inverts")?.items()? {
        let p = inverse.at(0)?.vec2()?;
        let theirs = inverse.at(1)?;
        check_inverse(
            p,
            table.invert(p),
            &theirs,
            Case::vec2,
            Findings::near2,
            findings,
        )?;
    }
    Ok(())
}
