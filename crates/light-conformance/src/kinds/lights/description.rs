use super::rules::{LOOSE_BOX, PATCH_AREA, PICTURE_POWER, PORTAL_POWER, SINGLE, WIDE_NORMALS};
use super::{LightCase, number};
use crate::comparison::Comparison;
use crate::oracle::lights::ExactBounds;
use crate::{Case, Findings, Malformed, Rule, Tolerance};
use lights::bounds::LightBounds;
use lights::math::glam::Vec3;
use lights::sources::{Light, LightType};

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
        let ours = findings.ours_if_any("bounds", self.light.bounds());
        match (ours, self.case.find("bounds"), self.exact.bounds()) {
            (Some(ours), Some(theirs), Some(exact)) => {
                self.check_bounds(&ours, theirs, &exact, findings)
            }
            (ours, theirs, _) => {
                findings.equal("bounded", ours.is_some(), theirs.is_some());
                Ok(())
            }
        }
    }

    fn check_power(&self, white: &[f32], findings: &mut Findings) -> Result<(), Malformed> {
        let ours = findings.ours("phi", self.light.phi(&()));
        let mut comparison = Comparison::default();
        let theirs = self.reference_power(white)?;
        comparison.vec3("phi", ours, theirs.map(Vec3::splat), POWER);
        let rule = || match self.kind {
            "portal_infinite" => &PORTAL_POWER,
            _ if self.has_texels() => &PICTURE_POWER,
            _ => self.power_rule(),
        };
        let exact = self.exact.phi();
        comparison.settle(findings, rule, |_| Some(vec![exact]));
        Ok(())
    }

    /// The reference's power for a white of 1; none of coloured pictures, which it gives at four
    /// wavelengths.
    fn reference_power(&self, white: &[f32]) -> Result<Option<f32>, Malformed> {
        let phi = self.case.get("phi")?;
        if let Ok(phi) = phi.float() {
            return Ok(Some(phi));
        }
        if self.is_colored()? {
            return Ok(None);
        }
        let grey = phi.floats()?.into_iter().zip(white).map(|(phi, w)| phi / w);
        Ok(Some(grey.sum::<f32>() / white.len() as f32))
    }

    fn power_rule(&self) -> &'static Rule {
        if self.kind == "area_patch" {
            &PATCH_AREA
        } else {
            &SINGLE
        }
    }

    fn check_bounds(
        &self,
        ours: &LightBounds,
        theirs: Case<'_>,
        exact: &ExactBounds,
        findings: &mut Findings,
    ) -> Result<(), Malformed> {
        let corner = |i| theirs.get("bounds")?.at(i)?.vec3();
        let float = |name| theirs.get(name)?.float();
        let mut comparison = Comparison::default();
        let min = findings.ours("bounds min", ours.bounds.min);
        comparison.vec3("bounds min", min, Some(corner(0)?), CLOSE);
        let max = findings.ours("bounds max", ours.bounds.max);
        comparison.vec3("bounds max", max, Some(corner(1)?), CLOSE);
        let truth = vec![exact.min, exact.max];
        comparison.settle(findings, || &LOOSE_BOX, |_| Some(truth.clone()));

        // The axis of two opposite sides has no direction.
        let their_w = theirs.get("w")?.vec3()?;
        let toward_theirs = |v: Vec3| {
            if self.is_two_sided && v.dot(their_w) < 0.0 {
                -v
            } else {
                v
            }
        };
        let w = findings.ours("bounds w", toward_theirs(ours.w));
        let exact_w = toward_theirs(exact.w.as_vec3());
        let mut comparison = Comparison::default();
        comparison.vec3("w", w, Some(their_w), CLOSE);
        let cos_theta_o = findings.ours("bounds cos_theta_o", ours.cos_theta_o);
        comparison.number(
            "cos_theta_o",
            cos_theta_o,
            Some(float("cos_theta_o")?),
            CLOSE,
        );
        let cos_theta_e = findings.ours("bounds cos_theta_e", ours.cos_theta_e);
        comparison.number(
            "cos_theta_e",
            cos_theta_e,
            Some(float("cos_theta_e")?),
            CLOSE,
        );
        let truth = vec![
            exact_w.as_dvec3(),
            number(exact.cos_theta_o),
            number(exact.cos_theta_e),
        ];
        comparison.settle(findings, || &WIDE_NORMALS, |_| Some(truth.clone()));

        let mut comparison = Comparison::default();
        let phi = findings.ours("bounds phi", ours.phi);
        comparison.number("bounds phi", phi, Some(float("phi")?), POWER);
        let truth = vec![number(exact.phi)];
        comparison.settle(findings, || self.power_rule(), |_| Some(truth.clone()));
        let two_sided = findings.ours("bounds two_sided", ours.two_sided);
        findings.equal("two_sided", two_sided, theirs.get("two_sided")?.flag()?);
        findings.equal("two_sided", two_sided, exact.two_sided);
        Ok(())
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
