use super::LightCase;
use super::differences::Differences;
use super::portal;
use super::projection;
use super::rules::{COLORS, LOOSE_BOX, PATCH_AREA, PICTURE_POWER, PORTAL_POWER, WIDE_NORMALS};
use crate::conformance::{Case, Findings, Malformed, Tolerance};
use lights::bounds::LightBounds;
use lights::sources::{Light, LightType, Radiance};

const CLOSE: Tolerance = Tolerance::new(1e-5, 1e-5);
const POWER: Tolerance = Tolerance::new(1e-4, 1e-6);

impl LightCase<'_> {
    /// Type, power and bounds.
    pub(super) fn check_description(
        &self,
        white: &[f32],
        findings: &mut Findings,
    ) -> Result<(), Malformed> {
        let kind = match self.light.light_type() {
            LightType::DeltaPosition => "delta_position",
            LightType::DeltaDirection => "delta_direction",
            LightType::Area => "area",
            LightType::Infinite => "infinite",
        };
        findings.equal("type", Some(kind), self.case.get("light_type")?.text());
        self.check_power(white, findings)?;
        match (self.light.bounds(), self.case.find("bounds")) {
            (Some(ours), Some(theirs)) => self.check_bounds(&ours, theirs, findings),
            (ours, theirs) => {
                findings.equal("bounded", ours.is_some(), theirs.is_some());
                Ok(())
            }
        }
    }

    fn check_power(&self, white: &[f32], findings: &mut Findings) -> Result<(), Malformed> {
        let ours = self.light.phi(&());
        let theirs = self.case.get("phi")?;
        if self.is_colored()? {
            findings.exempt(&COLORS);
        } else if self.kind == "portal_infinite" {
            let power = portal::reference_power(&self.case)?;
            for (theirs, white) in theirs.floats()?.into_iter().zip(white) {
                findings.near("phi", power * white, theirs, POWER);
            }
            findings.exempt(&PORTAL_POWER);
        } else if self.kind == "projection" {
            let [centers, exact] = projection::powers(&self.case)?;
            for (theirs, white) in theirs.floats()?.into_iter().zip(white) {
                findings.near("phi by centres", centers * white, theirs, POWER);
            }
            findings.near("phi", ours.average(), exact, POWER);
            findings.exempt(&PICTURE_POWER);
        } else if let Ok(theirs) = theirs.float() {
            let mut differences = Differences::default();
            differences.near("phi", ours.average(), theirs, POWER);
            differences.settle(findings, || self.patch_area(ours.average(), theirs));
        } else {
            for (theirs, white) in theirs.floats()?.into_iter().zip(white) {
                findings.near("phi", ours.average() * white, theirs, POWER);
            }
        }
        Ok(())
    }

    fn check_bounds(
        &self,
        ours: &LightBounds,
        theirs: Case<'_>,
        findings: &mut Findings,
    ) -> Result<(), Malformed> {
        let corner = |i| theirs.get("bounds")?.at(i)?.vec3();
        let (min, max) = (corner(0)?, corner(1)?);
        let mut differences = Differences::default();
        differences.near3("bounds.min", ours.bounds.min, min, CLOSE);
        differences.near3("bounds.max", ours.bounds.max, max, CLOSE);
        let center = ours.bounds.center().distance(0.5 * (min + max));
        let inside =
            (min - 1e-5).cmple(ours.bounds.min).all() && ours.bounds.max.cmple(max + 1e-5).all();
        let is_round = self.kind == "area_sphere" || self.kind == "area_disk";
        differences.settle(findings, || {
            (is_round && inside && center < 1e-5).then_some(&LOOSE_BOX)
        });

        let float = |name| theirs.get(name)?.float();
        let mut differences = Differences::default();
        let w = theirs.get("w")?.vec3()?;
        // The axis of two opposite sides has no direction.
        let sign = if self.is_two_sided {
            w.dot(ours.w).signum()
        } else {
            1.0
        };
        let cos_theta_o = float("cos_theta_o")?;
        differences.near3("bounds.w", ours.w * sign, w, CLOSE);
        differences.near("cos_theta_o", ours.cos_theta_o, cos_theta_o, CLOSE);
        let is_wide = ours.cos_theta_o == -1.0 && cos_theta_o < 0.0;
        differences.settle(findings, || is_wide.then_some(&WIDE_NORMALS));

        let phi = float("phi")?;
        let mut differences = Differences::default();
        differences.near("bounds.phi", ours.phi, phi, POWER);
        differences.settle(findings, || self.patch_area(ours.phi, phi));
        findings.near(
            "cos_theta_e",
            ours.cos_theta_e,
            float("cos_theta_e")?,
            CLOSE,
        );
        findings.equal(
            "two_sided",
            ours.two_sided,
            theirs.get("two_sided")?.flag()?,
        );
        Ok(())
    }

    fn patch_area(&self, ours: f32, theirs: f32) -> Option<&'static crate::conformance::Rule> {
        (self.kind == "area_patch" && (ours - theirs).abs() < 0.02 * theirs).then_some(&PATCH_AREA)
    }

    /// Whether the light is a picture whose channels differ.
    fn is_colored(&self) -> Result<bool, Malformed> {
        let Some(image) = self.case.find("image") else {
            return Ok(false);
        };
        let texels = image.get("texels")?.floats()?;
        let is_rgb = image.get("channels")?.index()? == 3;
        Ok(is_rgb && texels.chunks(3).any(|t| t.iter().any(|c| *c != t[0])))
    }
}
