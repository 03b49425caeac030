use super::differences::Differences;
use super::rules::{ANNULUS, AXIS, HORIZON, NO_SIDES, PORTAL_RAYS, TEXEL_EDGE, WRAP};
use super::{LightCase, color, entries, unwound};
use crate::conformance::{Case, Findings, Malformed, Rule, Tolerance};
use lights::math::glam::{Vec2, Vec3};
use lights::sources::{EmittedRay, LePdf, Light, LightLeSample, SurfacePoint};

const PLACE: Tolerance = Tolerance::new(1e-5, 2e-5);
const VALUE: Tolerance = Tolerance::new(1e-4, 1e-6);

impl LightCase<'_> {
    /// Rays that leave the light and their densities, and radiance.
    pub(super) fn check_outward(&self, findings: &mut Findings) -> Result<(), Malformed> {
        for query in self.case.get("sample_le")?.items()? {
            self.check_sample_le(query, findings)?;
        }
        for query in entries(&self.case, "pdf_le")? {
            self.check_pdf_le(query, findings)?;
        }
        for query in entries(&self.case, "radiance")? {
            self.check_radiance(query, findings)?;
        }
        Ok(())
    }

    fn check_pdf_le(&self, query: Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        let [o, d] = [query.get("o")?.vec3()?, query.get("d")?.vec3()?];
        let ours = self.light.pdf_le(&EmittedRay::from_point(o, d));
        let theirs = LePdf {
            pos: query.get("pdf_pos")?.float()?,
            dir: query.get("pdf_dir")?.float()?,
        };
        self.compare_densities("pdf_le", ours, theirs, d, findings);
        Ok(())
    }

    fn compare_densities(
        &self,
        what: &str,
        ours: LePdf,
        theirs: LePdf,
        direction: Vec3,
        findings: &mut Findings,
    ) {
        let mut differences = Differences::default();
        differences.near(&format!("{what}, position"), ours.pos, theirs.pos, VALUE);
        differences.settle(findings, || {
            (self.kind == "portal_infinite").then_some(&PORTAL_RAYS)
        });
        let mut differences = Differences::default();
        differences.near(&format!("{what}, direction"), ours.dir, theirs.dir, VALUE);
        differences.settle(findings, || {
            let dir = |d| {
                self.light
                    .pdf_le(&EmittedRay::from_point(Vec3::ZERO, d))
                    .dir
            };
            if self.is_beside(direction, theirs.dir, dir) {
                Some(&TEXEL_EDGE)
            } else if self.kind.starts_with("area") && ours.dir.max(theirs.dir) < 3e-4 {
                Some(&HORIZON)
            } else {
                self.is_wrapped.then_some(&WRAP)
            }
        });
    }

    fn check_sample_le(&self, query: Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        if self.is_annulus {
            findings.exempt(&ANNULUS);
            return Ok(());
        }
        let [u1, u2] = [query.get("u1")?.vec2()?, query.get("u2")?.vec2()?];
        let ours = self.light.sample_le(u1, u2, &());
        let (ours, theirs) = match (ours, query.find("out")) {
            (Some(ours), Some(theirs)) => (ours, theirs),
            (Some(ours), None) if self.kind.starts_with("area") && ours.pdf.dir < 3e-4 => {
                findings.exempt(&HORIZON);
                return Ok(());
            }
            (ours, theirs) => {
                findings.equal("sample_le", ours.is_some(), theirs.is_some());
                return Ok(());
            }
        };
        let pdf = LePdf {
            pos: theirs.get("pdf_pos")?.float()?,
            dir: theirs.get("pdf_dir")?.float()?,
        };
        let mut differences = Differences::default();
        differences.near3("d", ours.ray.direction, theirs.get("d")?.vec3()?, PLACE);
        differences.near("sample_le, direction", ours.pdf.dir, pdf.dir, VALUE);
        if let Some(l) = theirs.get("L")?.float().ok().filter(|_| !self.has_texels()) {
            differences.near3("L", ours.l, Vec3::splat(l), VALUE);
        }
        let excuse = self.excuse_direction(&ours, theirs, pdf)?;
        differences.settle(findings, || excuse);
        let is_portal = self.kind == "portal_infinite";
        let mut differences = Differences::default();
        differences.near3("o", ours.ray.origin, theirs.get("o")?.vec3()?, PLACE);
        differences.near("sample_le, position", ours.pdf.pos, pdf.pos, VALUE);
        if let Some(n) = theirs.find("n_light") {
            let uv = theirs.get("uv_light")?.vec2()?;
            differences.near3(
                "n_light",
                ours.ray.normal * self.orientation,
                n.vec3()?,
                PLACE,
            );
            differences.near2(
                "uv",
                unwound(ours.ray.uv, uv),
                uv,
                Tolerance::new(1e-4, 1e-4),
            );
        }
        differences.settle(findings, || is_portal.then_some(&PORTAL_RAYS));

        // The densities of that ray, asked for.
        let again = self.light.pdf_le(&ours.ray);
        let theirs = theirs.get("pdf_le")?.float_array::<2>()?;
        let theirs = LePdf {
            pos: theirs[0],
            dir: theirs[1],
        };
        if excuse != Some(&AXIS) {
            self.compare_densities(
                "pdf_le of the sample",
                again,
                theirs,
                ours.ray.direction,
                findings,
            );
        }
        Ok(())
    }

    /// Why the direction of a ray may differ.
    fn excuse_direction(
        &self,
        ours: &LightLeSample<Vec3>,
        theirs: Case<'_>,
        pdf: LePdf,
    ) -> Result<Option<&'static Rule>, Malformed> {
        let apart = ours.ray.direction.distance(theirs.get("d")?.vec3()?);
        let is_area = self.kind.starts_with("area");
        let is_horizontal = ours.pdf.dir.max(pdf.dir) < 3e-4 && apart < 1e-3;
        // What a rounded cosine does to the direction: its inverse.
        let cosine = std::f32::consts::PI * pdf.dir;
        Ok(if is_area && self.is_two_sided && self.orientation < 0.0 {
            Some(&NO_SIDES)
        } else if is_area && (is_horizontal || apart < 4.0 * f32::EPSILON / cosine) {
            Some(&HORIZON)
        } else if self.kind == "spot" && apart < 1e-3 {
            Some(&AXIS)
        } else {
            self.is_wrapped.then_some(&WRAP)
        })
    }

    fn check_radiance(&self, query: Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        let mut differences = Differences::default();
        if let Some(w) = query.find("w") {
            let at = SurfacePoint {
                p: Vec3::ZERO,
                n: query.get("n")?.vec3()? * self.orientation,
                uv: Vec2::ZERO,
            };
            let ours = self.light.l(&at, w.vec3()?, &());
            differences.near3("radiance", ours, color(query.get("L")?)?, VALUE);
            differences.settle(findings, || None);
            return Ok(());
        }
        let [o, d] = [query.get("o")?.vec3()?, query.get("d")?.vec3()?];
        let le = |d| self.light.le(o, d, &());
        let theirs = query.get("L")?;
        let is_dark = theirs
            .items()
            .is_ok_and(|mut l| l.all(|l| l.float().is_ok_and(|l| l == 0.0)));
        let theirs = match query.find("rgb_unwindowed") {
            _ if is_dark => Vec3::ZERO,
            Some(rgb) => rgb.vec3()?,
            None => color(theirs)?,
        };
        differences.near3("radiance", le(d), theirs, VALUE);
        differences.settle(findings, || {
            let is_beside = self.is_beside(d, theirs.length(), |d| le(d).length());
            is_beside.then_some(&TEXEL_EDGE)
        });
        Ok(())
    }
}
