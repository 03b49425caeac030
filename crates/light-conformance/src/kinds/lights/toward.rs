use super::rules::{
    ANNULUS, DARK, MISSED, NO_SAMPLE, OWN_DIRECTION, OWN_SAMPLE, SINGLE, SMALL_RECTANGLE,
    TEXEL_EDGE, WINDOW, WRAP,
};
use super::{LightCase, color, number, number_of, vec3_of};
use crate::comparison::{Comparison, settle_none};
use crate::oracle::Jitter;
use crate::oracle::lights::Receiver;
use crate::{Case, Findings, Malformed, Rule, Tolerance};
use glam::{DVec3, Vec2, Vec3};
use lights::bounds::LightSampleContext;
use lights::sources::{Light, PdfCoverage};

const PLACE: Tolerance = Tolerance::new(1e-5, 2e-5);
const UV: Tolerance = Tolerance::new(1e-4, 1e-4);
const VALUE: Tolerance = Tolerance::new(1e-4, 1e-6);

/// The receiver, for us and for the oracle.
struct QueryContext {
    ctx: LightSampleContext,
    coverage: PdfCoverage,
    at: Receiver,
}

impl LightCase<'_> {
    /// Samples toward a point and their density.
    pub(super) fn check_toward(&self, findings: &mut Findings) -> Result<(), Malformed> {
        for query in self.case.get("sample_li")?.items()? {
            self.check_sample_li(query, findings)?;
        }
        for query in self.case.get("pdf_li")?.items()? {
            let (query_ctx, wi) = (QueryContext::read(query)?, query.get("wi")?.vec3()?);
            let theirs = query.get("pdf")?.float()?;
            self.check_pdf_li("pdf_li", &query_ctx, wi, theirs, &MISSED, findings);
        }
        Ok(())
    }

    fn check_pdf_li(
        &self,
        name: &'static str,
        QueryContext { ctx, coverage, at }: &QueryContext,
        wi: Vec3,
        theirs: f32,
        rule: &'static Rule,
        findings: &mut Findings,
    ) {
        let ours = findings.ours(name, self.light.pdf_li(ctx, wi, *coverage));
        let mut comparison = Comparison::default();
        comparison.number(name, ours, Some(theirs), VALUE);
        let rule = || match self.kind {
            "portal_infinite" if ours == 0.0 => &WINDOW,
            "portal_infinite" => &WRAP,
            "image_infinite" => &TEXEL_EDGE,
            _ if ours == 0.0 || theirs == 0.0 => rule,
            _ => &SINGLE,
        };
        comparison.settle(findings, rule, |jitter| {
            Some(vec![number(self.exact.pdf_li(at, wi.as_dvec3(), jitter))])
        });
    }

    fn check_sample_li(&self, query: Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        let query_ctx = QueryContext::read(query)?;
        let u = query.get("u")?.vec2()?;
        let ours = self
            .light
            .sample_li(&query_ctx.ctx, u, &(), query_ctx.coverage);
        let theirs = query.find("out");
        let Some(ours) = findings.ours_if_any("sample_li", ours) else {
            let is_dark = theirs.and_then(|t| color(t.find("L")?)) == Some(Vec3::ZERO);
            let rule = if is_dark { &DARK } else { &NO_SAMPLE };
            let rule = theirs.map(|_| rule);
            let truth =
                |jitter: &mut Jitter| self.exact.sample_li(&query_ctx.at, u.as_dvec2(), jitter);
            settle_none(findings, "sample_li", rule, truth);
            return Ok(());
        };

        let wi = findings.ours("sample_li wi", ours.wi);
        let uv = findings.ours("sample_li uv", ours.uv);
        let mut comparison = Comparison::default();
        let mut part = |name, ours, field| -> Result<(), Malformed> {
            comparison.vec3(name, ours, vec3_of(theirs, field)?, PLACE);
            Ok(())
        };
        part("wi", wi, "wi")?;
        part("p", findings.ours("sample_li p", ours.p_light), "p_light")?;
        let n = findings.ours("sample_li n", ours.n_light);
        // Lights without a surface have no normal in the vectors.
        part("n", n * self.orientation, "n_light")?;
        let their_uv = theirs.and_then(|t| t.find("uv_image").or(t.find("uv_light")));
        let their_uv = their_uv.map(|uv| uv.vec2()).transpose()?;
        let their_uv = their_uv.map(|v| self.unwound(v.as_dvec2(), uv).as_vec2());
        comparison.vec2("uv", uv, their_uv, UV);
        let pdf = findings.ours("sample_li pdf", ours.pdf);
        comparison.number("pdf", pdf, number_of(theirs, "pdf")?, VALUE);
        let l = theirs.and_then(|t| color(t.find("rgb").or(t.find("L"))?));
        comparison.vec3("L", findings.ours("sample_li L", ours.l), l, VALUE);
        comparison.settle(
            findings,
            || self.rule_toward(theirs, pdf),
            |jitter| self.exact_sample(&query_ctx.at, u, uv, ours.wi, jitter),
        );

        // The density of that direction, asked for.
        let name = "pdf_li of the sample";
        match number_of(theirs, "pdf_li")? {
            Some(theirs) => {
                self.check_pdf_li(name, &query_ctx, ours.wi, theirs, &OWN_SAMPLE, findings)
            }
            None => self.check_pdf_li(name, &query_ctx, ours.wi, f32::NAN, &OWN_SAMPLE, findings),
        }
        Ok(())
    }

    fn exact_sample(
        &self,
        at: &Receiver,
        u: Vec2,
        uv: Vec2,
        wi: Vec3,
        jitter: &mut Jitter,
    ) -> Option<Vec<DVec3>> {
        let mut exact = self.exact.sample_li(at, u.as_dvec2(), jitter)?;
        if self.is_twisted() {
            exact.pdf = self.exact.pdf_li(at, wi.as_dvec3(), jitter);
        }
        Some(vec![
            exact.wi,
            exact.p,
            self.turned(exact.n),
            self.unwound(exact.uv, uv).extend(0.0),
            number(exact.pdf),
            exact.l,
        ])
    }

    fn rule_toward(&self, theirs: Option<Case<'_>>, pdf: f32) -> &'static Rule {
        match self.kind {
            "portal_infinite" => &WRAP,
            _ if theirs.is_none() => &NO_SAMPLE,
            _ if self.has_texels() => &TEXEL_EDGE,
            "area_disk" if self.is_annulus => &ANNULUS,
            _ if self.is_twisted() => &OWN_DIRECTION,
            "area_patch" if pdf > 1e3 => &SMALL_RECTANGLE,
            _ => &SINGLE,
        }
    }
}

impl QueryContext {
    fn read(query: Case<'_>) -> Result<Self, Malformed> {
        let vec3 = |name| query.get(name)?.vec3();
        let is_incomplete = query.get("incomplete")?.flag()?;
        let (p, n, ns) = (vec3("p")?, vec3("n")?, vec3("ns")?);
        Ok(Self {
            ctx: LightSampleContext::surface(p, n, ns),
            coverage: if is_incomplete {
                PdfCoverage::Incomplete
            } else {
                PdfCoverage::Complete
            },
            at: Receiver {
                p: p.as_dvec3(),
                ns: ns.as_dvec3(),
                is_incomplete,
            },
        })
    }
}
