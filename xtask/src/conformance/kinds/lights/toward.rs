use super::differences::Differences;
use super::rules::{
    ANNULUS, CLOSER, DARK, MISSED, OWN_SAMPLE, SILHOUETTE, TEXEL_EDGE, WINDOW, WRAP,
};
use super::{LightCase, color, unwound};
use crate::conformance::{Case, Findings, Malformed, Rule, Tolerance};
use lights::bounds::LightSampleContext;
use lights::math::glam::Vec3;
use lights::sources::{Light, LightLiSample, PdfCoverage};
use std::f32::consts::TAU;

const PLACE: Tolerance = Tolerance::new(1e-5, 2e-5);
const VALUE: Tolerance = Tolerance::new(1e-4, 1e-6);

impl LightCase<'_> {
    /// Samples toward a point and their density.
    pub(super) fn check_toward(&self, findings: &mut Findings) -> Result<(), Malformed> {
        for query in self.case.get("sample_li")?.items()? {
            self.check_sample_li(query, findings)?;
        }
        for query in self.case.get("pdf_li")?.items()? {
            self.check_pdf_li(query, findings)?;
        }
        Ok(())
    }

    fn check_pdf_li(&self, query: Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        let (ctx, coverage) = asker(query)?;
        let wi = query.get("wi")?.vec3()?;
        let pdf = |wi| self.light.pdf_li(&ctx, wi, coverage);
        let (ours, theirs) = (pdf(wi), query.get("pdf")?.float()?);
        let mut differences = Differences::default();
        differences.near("pdf_li", ours, theirs, VALUE);
        differences.settle(findings, || {
            // One minus a cosine, rounded near 1.
            let cancellation = TAU * theirs * f32::EPSILON * theirs;
            if self.kind == "area_sphere" && (ours - theirs).abs() <= cancellation {
                Some(&CLOSER)
            } else if ours == 0.0 && self.kind.starts_with("area") {
                Some(&MISSED)
            } else if ours == 0.0 && self.kind == "portal_infinite" {
                Some(&WINDOW)
            } else if self.is_beside(wi, theirs, pdf) {
                Some(&TEXEL_EDGE)
            } else {
                self.is_wrapped.then_some(&WRAP)
            }
        });
        Ok(())
    }

    fn check_sample_li(&self, query: Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        if self.is_annulus {
            findings.exempt(&ANNULUS);
            return Ok(());
        }
        let (ctx, coverage) = asker(query)?;
        let u = query.get("u")?.vec2()?;
        let ours = self.light.sample_li(&ctx, u, &(), coverage);
        let (ours, theirs) = match (ours, query.find("out")) {
            (Some(ours), Some(theirs)) => (ours, theirs),
            (None, Some(theirs)) => {
                match excuse_of_none(theirs)? {
                    Some(rule) => findings.exempt(rule),
                    None => findings.fail(format!("sample_li: none at {ctx:?}, reference has one")),
                }
                return Ok(());
            }
            (ours, theirs) => {
                findings.equal("sample_li", ours.is_some(), theirs.is_some());
                return Ok(());
            }
        };
        let mut differences = Differences::default();
        self.compare_sample(&ours, theirs, &mut differences)?;
        let excuse = if self.is_wrapped {
            Some(&WRAP)
        } else if self.has_texels() {
            let theirs = color(theirs.find("rgb").unwrap_or(theirs.get("L")?))?;
            self.is_lit_beside(&ctx, &ours, theirs)
                .then_some(&TEXEL_EDGE)
        } else {
            self.excuse_by_truth(&ctx, u, &ours, theirs)?
        };
        let is_excused = excuse.is_some();
        differences.settle(findings, || excuse);

        // The density of that direction, asked for.
        let again = self.light.pdf_li(&ctx, ours.wi, coverage);
        let theirs_again = theirs.get("pdf_li")?.float()?;
        let mut differences = Differences::default();
        differences.near("pdf_li of the sample", again, theirs_again, VALUE);
        let is_own = (again - ours.pdf).abs() <= 1e-3 * ours.pdf;
        differences.settle(findings, || {
            if theirs_again == 0.0 && is_own {
                Some(&OWN_SAMPLE)
            } else if self.is_beside(ours.wi, theirs_again, |wi| {
                self.light.pdf_li(&ctx, wi, coverage)
            }) {
                Some(&TEXEL_EDGE)
            } else {
                excuse.filter(|_| is_excused && is_own)
            }
        });
        Ok(())
    }

    fn compare_sample(
        &self,
        ours: &LightLiSample<Vec3>,
        theirs: Case<'_>,
        differences: &mut Differences,
    ) -> Result<(), Malformed> {
        differences.near3("wi", ours.wi, theirs.get("wi")?.vec3()?, PLACE);
        differences.near3(
            "p_light",
            ours.p_light,
            theirs.get("p_light")?.vec3()?,
            PLACE,
        );
        if let Some(n) = theirs.find("n_light") {
            differences.near3("n_light", ours.n_light * self.orientation, n.vec3()?, PLACE);
        }
        if let Some(uv) = theirs.find("uv_image") {
            differences.near2("uv", ours.uv, uv.vec2()?, PLACE);
        }
        // The reference leaves out the place on a sphere that is seen from outside.
        if let Some(uv) = theirs.find("uv_light") {
            let uv = uv.vec2()?;
            differences.near2("uv", unwound(ours.uv, uv), uv, Tolerance::new(1e-4, 1e-4));
        }
        differences.near("pdf", ours.pdf, theirs.get("pdf")?.float()?, VALUE);
        let l = color(theirs.find("rgb").unwrap_or(theirs.get("L")?))?;
        differences.near3("L", ours.l, l, VALUE);
        Ok(())
    }

    /// Whether a point beside the one that asks gets what the reference says.
    fn is_lit_beside(
        &self,
        ctx: &LightSampleContext,
        ours: &LightLiSample<Vec3>,
        theirs: Vec3,
    ) -> bool {
        let distance = ours.p_light.distance(ctx.p);
        self.is_beside(ours.wi, theirs.length(), |wi| {
            let ctx = LightSampleContext::medium(ours.p_light - wi * distance);
            match self.kind {
                "projection" | "goniometric" => {
                    let sample = self.light.sample_li(
                        &ctx,
                        lights::math::glam::Vec2::ZERO,
                        &(),
                        PdfCoverage::Complete,
                    );
                    sample.map_or(0.0, |s| s.l.length())
                }
                _ => self.light.le(ctx.p, wi, &()).length(),
            }
        })
    }
}

/// Why the reference may have a sample where we have none.
fn excuse_of_none(theirs: Case<'_>) -> Result<Option<&'static Rule>, Malformed> {
    if color(theirs.get("L")?).is_ok_and(|l| l == Vec3::ZERO) {
        return Ok(Some(&DARK));
    }
    let Some(n) = theirs.find("n_light") else {
        return Ok(None);
    };
    let cosine = n.vec3()?.dot(theirs.get("wi")?.vec3()?);
    Ok((cosine.abs() < 1e-3).then_some(&SILHOUETTE))
}

/// Who asks, and for what.
fn asker(query: Case<'_>) -> Result<(LightSampleContext, PdfCoverage), Malformed> {
    let vec3 = |name| query.get(name)?.vec3();
    let coverage = match query.get("incomplete")?.flag()? {
        true => PdfCoverage::Incomplete,
        false => PdfCoverage::Complete,
    };
    let ctx = LightSampleContext::surface(vec3("p")?, vec3("n")?, vec3("ns")?);
    Ok((ctx, coverage))
}
