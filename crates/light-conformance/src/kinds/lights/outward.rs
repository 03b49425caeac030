use super::rules::{ANNULUS, AXIS, HORIZON, NO_SAMPLE, NO_SIDES, PORTAL_RAYS, SINGLE, TEXEL_EDGE};
use super::{LightCase, color, entries, number, number_of, vec3_of};
use crate::comparison::{Comparison, settle_none};
use crate::oracle::Jitter;
use crate::oracle::lights::Leaving;
use crate::{Case, Findings, Malformed, Rule, Tolerance};
use glam::{DVec2, DVec3, Vec2, Vec3};
use lights::sources::{EmittedRay, LePdf, Light, SurfacePoint};

const PLACE: Tolerance = Tolerance::new(1e-5, 2e-5);
const UV: Tolerance = Tolerance::new(1e-4, 1e-4);
const VALUE: Tolerance = Tolerance::new(1e-4, 1e-6);

impl LightCase<'_> {
    /// Rays that leave the light and their densities, and radiance.
    pub(super) fn check_outward(&self, findings: &mut Findings) -> Result<(), Malformed> {
        for query in self.case.get("sample_le")?.items()? {
            self.check_sample_le(query, findings)?;
        }
        for query in entries(&self.case, "pdf_le")? {
            let [o, d] = [query.get("o")?.vec3()?, query.get("d")?.vec3()?];
            let theirs = ["pdf_pos", "pdf_dir"].map(|name| number_of(Some(query), name));
            let [pos, dir] = theirs;
            let ray = EmittedRay::from_point(o, d);
            let names = ["pdf_le pos", "pdf_le dir"];
            self.check_pdf_le(names, &ray, [pos?, dir?], findings);
        }
        for query in entries(&self.case, "radiance")? {
            self.check_radiance(query, findings)?;
        }
        Ok(())
    }

    fn check_pdf_le(
        &self,
        [pos, dir]: [&'static str; 2],
        ray: &EmittedRay,
        theirs: [Option<f32>; 2],
        findings: &mut Findings,
    ) {
        let ours: LePdf = self.light.pdf_le(ray);
        let mut comparison = Comparison::default();
        comparison.number(pos, findings.ours(pos, ours.pos), theirs[0], VALUE);
        if self.is_along_the_portal(ray.direction) {
            comparison.ill_conditioned();
        }
        comparison.number(dir, findings.ours(dir, ours.dir), theirs[1], VALUE);
        if self.is_along_the_portal(ray.direction) {
            comparison.ill_conditioned();
        }
        comparison.settle(
            findings,
            || self.rule_outward(None),
            |jitter| Some(self.exact.pdf_le(&leaving(ray), jitter).map(number).into()),
        );
    }

    fn check_sample_le(&self, query: Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        let [u1, u2] = [query.get("u1")?.vec2()?, query.get("u2")?.vec2()?];
        let exact = |jitter: &mut Jitter| {
            let exact = self.exact.sample_le(u1.as_dvec2(), u2.as_dvec2(), jitter)?;
            // No sample where no light is sent.
            let (l, [_, dir]) = self.exact.sent(&exact, jitter);
            (l != DVec3::ZERO && dir > 0.0).then_some(exact)
        };
        let ours = self.light.sample_le(u1, u2, &());
        let theirs = query.find("out");
        let Some(ours) = findings.ours_if_any("sample_le", ours) else {
            let rule = theirs.map(|_| &NO_SAMPLE);
            settle_none(findings, "sample_le", rule, exact);
            return Ok(());
        };

        let uv = findings.ours("sample_le uv", ours.ray.uv);
        let d = findings.ours("sample_le d", ours.ray.direction);
        let o = findings.ours("sample_le o", ours.ray.origin);
        let n = findings.ours("sample_le n", ours.ray.normal);
        let mut comparison = Comparison::default();
        comparison.vec3("o", o, vec3_of(theirs, "o")?, PLACE);
        let their_d = vec3_of(theirs, "d")?;
        comparison.vec3("d", d, their_d, PLACE);
        let their_n = vec3_of(theirs, "n_light")?;
        comparison.vec3("n", n * self.orientation, their_n, PLACE);
        let their_uv = theirs.and_then(|t| t.find("uv_light"));
        let their_uv = their_uv.map(|uv| uv.vec2()).transpose()?;
        let their_uv = their_uv.map(|v| self.unwound(v.as_dvec2(), uv).as_vec2());
        comparison.vec2("uv", uv, their_uv, UV);
        comparison.settle(
            findings,
            || self.rule_outward(theirs),
            |jitter| {
                let Leaving {
                    o, d, n, uv: exact, ..
                } = exact(jitter)?;
                let exact = self.unwound(exact, uv).extend(0.0);
                Some(vec![o, d, self.turned(n), exact])
            },
        );

        // What our own ray carries, and its densities.
        let ray = leaving(&ours.ray);
        let mut comparison = Comparison::default();
        let l = theirs.and_then(|t| color(t.find("L")?));
        comparison.vec3("L", findings.ours("sample_le L", ours.l), l, VALUE);
        let their_pos = number_of(theirs, "pdf_pos")?;
        let pos = findings.ours("sample_le pos", ours.pdf.pos);
        comparison.number("pos", pos, their_pos, VALUE);
        if self.is_along_the_portal(ours.ray.direction) {
            comparison.ill_conditioned();
        }
        let their_dir = number_of(theirs, "pdf_dir")?;
        let dir = findings.ours("sample_le dir", ours.pdf.dir);
        comparison.number("dir", dir, their_dir, VALUE);
        if self.is_along_the_portal(ours.ray.direction) {
            comparison.ill_conditioned();
        }
        comparison.settle(
            findings,
            || self.rule_outward(theirs),
            |jitter| {
                let (l, [pos, dir]) = self.exact.sent(&ray, jitter);
                Some(vec![l, number(pos), number(dir)])
            },
        );

        // The densities of that ray, asked for.
        let asked = theirs.map(|t| t.get("pdf_le")?.float_array::<2>());
        let asked = asked.transpose()?.map_or([None; 2], |pdf| pdf.map(Some));
        let names = ["pdf_le of the sample pos", "pdf_le of the sample dir"];
        self.check_pdf_le(names, &ours.ray, asked, findings);
        Ok(())
    }

    /// Whether a ray runs along a portal: the cosine there is what rounding leaves of it.
    fn is_along_the_portal(&self, d: Vec3) -> bool {
        let frame = self.case.find("portal_frame");
        let z = frame.and_then(|frame| frame.at(2).ok()?.vec3().ok());
        z.is_some_and(|z| z.dot(d).abs() < 1e-4)
    }

    fn rule_outward(&self, theirs: Option<Case<'_>>) -> &'static Rule {
        match self.kind {
            "spot" => &AXIS,
            "portal_infinite" => &PORTAL_RAYS,
            "area_disk" if self.is_annulus => &ANNULUS,
            _ if self.has_texels() => &TEXEL_EDGE,
            _ if self.is_two_sided && self.orientation < 0.0 => &NO_SIDES,
            _ if self.is_area() || theirs.is_none() => &HORIZON,
            _ => &SINGLE,
        }
    }

    fn check_radiance(&self, query: Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        let (ours, theirs, ray) = if let Some(w) = query.find("w") {
            let at = SurfacePoint {
                p: Vec3::ZERO,
                n: query.get("n")?.vec3()? * self.orientation,
                uv: Vec2::ZERO,
            };
            let ray = EmittedRay {
                normal: at.n,
                ..EmittedRay::from_point(at.p, w.vec3()?)
            };
            let ours = self.light.l(&at, ray.direction, &());
            (ours, color(query.get("L")?), ray)
        } else {
            let ray = EmittedRay::from_point(query.get("o")?.vec3()?, query.get("d")?.vec3()?);
            let theirs = query.get("L")?;
            let is_dark = theirs
                .items()
                .is_ok_and(|mut l| l.all(|l| l.float().is_ok_and(|l| l == 0.0)));
            let theirs = match query.find("rgb_unwindowed") {
                _ if is_dark => Some(Vec3::ZERO),
                Some(rgb) => Some(rgb.vec3()?),
                None => color(theirs),
            };
            (self.light.le(ray.origin, ray.direction, &()), theirs, ray)
        };
        let mut comparison = Comparison::default();
        comparison.vec3("radiance", findings.ours("radiance", ours), theirs, VALUE);
        comparison.settle(
            findings,
            || self.rule_outward(None),
            |jitter| Some(vec![self.exact.radiance(&leaving(&ray), jitter)]),
        );
        Ok(())
    }
}

/// A ray of ours for the oracle.
fn leaving(ray: &EmittedRay) -> Leaving {
    Leaving {
        o: ray.origin.as_dvec3(),
        d: ray.direction.as_dvec3(),
        n: ray.normal.as_dvec3(),
        uv: DVec2::new(f64::from(ray.uv.x), f64::from(ray.uv.y)),
    }
}
