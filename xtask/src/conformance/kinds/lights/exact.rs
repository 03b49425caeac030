//! Samples toward triangles, rectangles and spheres in double precision, where single precision is in doubt.

use super::LightCase;
use super::rules::{CLOSER, SMALL_RECTANGLE};
use crate::conformance::exact::{ExactRectangle, ExactTriangle};
use crate::conformance::{Case, Malformed, Rule};
use lights::bounds::LightSampleContext;
use lights::math::Frame;
use lights::math::glam::{Vec2, Vec3};
use lights::math::warp::bilinear;
use lights::sources::LightLiSample;

/// How much farther from the truth than the reference we may be: rounding of what is compared.
const ROUNDING: f64 = 4e-6;

/// The place on the light and the density of a sample.
#[derive(Clone, Copy)]
struct Answer {
    p: Vec3,
    pdf: f32,
}

impl LightCase<'_> {
    /// The rule by which a sample may differ from the reference's: that ours is at least as near to the truth.
    pub(super) fn excuse_by_truth(
        &self,
        ctx: &LightSampleContext,
        u: Vec2,
        ours: &LightLiSample<Vec3>,
        theirs: Case<'_>,
    ) -> Result<Option<&'static Rule>, Malformed> {
        let size = self.size();
        let ours = Answer {
            p: ours.p_light,
            pdf: ours.pdf,
        };
        let theirs = Answer {
            p: theirs.get("p_light")?.vec3()?,
            pdf: theirs.get("pdf")?.float()?,
        };
        let (truth, rule) = match self.kind {
            "area_triangle" => (self.triangle(ctx, u)?, &CLOSER),
            "area_patch" => match self.rectangle(ctx, u)? {
                Some((truth, omega)) => (
                    truth,
                    if omega < 1e-3 {
                        &SMALL_RECTANGLE
                    } else {
                        &CLOSER
                    },
                ),
                None => return Ok(None),
            },
            "area_sphere" => (self.sphere(ctx, u)?, &CLOSER),
            _ => return Ok(None),
        };
        let error = |answer: Answer| {
            let p = f64::from(answer.p.distance(truth.p) / size);
            let pdf = f64::from((answer.pdf - truth.pdf).abs() / truth.pdf);
            [p, pdf]
        };
        let (our_error, their_error) = (error(ours), error(theirs));
        let is_closer = our_error[0]
            <= their_error[0] + ROUNDING * f64::from(ctx.p.distance(truth.p) / size).max(1.0)
            && our_error[1] <= their_error[1] + 1e-4;
        Ok(is_closer.then_some(rule))
    }

    /// How long the light is.
    fn size(&self) -> f32 {
        use lights::sources::Light;
        self.light
            .bounds()
            .map_or(1.0, |b| b.bounds.diagonal().length())
    }

    fn triangle(&self, ctx: &LightSampleContext, u: Vec2) -> Result<Answer, Malformed> {
        let v = self.case.get("v")?;
        let v = [v.at(0)?.vec3()?, v.at(1)?.vec3()?, v.at(2)?.vec3()?];
        let exact = ExactTriangle::new(v, ctx.p);
        let (u, pdf) = toward_cosine(ctx, u, [v[1], v[1], v[0], v[2]]);
        let b = exact.sample(u);
        Ok(Answer {
            p: v[0] * b.x + v[1] * b.y + v[2] * b.z,
            pdf: (f64::from(pdf) / exact.solid_angle()) as f32,
        })
    }

    /// The truth and the solid angle; none if the patch is no rectangle.
    fn rectangle(
        &self,
        ctx: &LightSampleContext,
        u: Vec2,
    ) -> Result<Option<(Answer, f64)>, Malformed> {
        if !self.case.get("rectangle")?.flag()? {
            return Ok(None);
        }
        let [p00, p10, p01, p11] =
            ["p00", "p10", "p01", "p11"].map(|name| self.case.get(name)?.vec3());
        let (p00, p10, p01, p11) = (p00?, p10?, p01?, p11?);
        let exact = ExactRectangle::new(p00, p10 - p00, p01 - p00, ctx.p);
        let (u, pdf) = toward_cosine(ctx, u, [p00, p10, p01, p11]);
        let at = exact.sample(u);
        let truth = Answer {
            p: p00 + (p10 - p00) * at.x + (p01 - p00) * at.y,
            pdf: (f64::from(pdf) / exact.solid_angle()) as f32,
        };
        Ok(Some((truth, exact.solid_angle())))
    }

    fn sphere(&self, ctx: &LightSampleContext, u: Vec2) -> Result<Answer, Malformed> {
        let m = self.case.get("render_from_object")?.float_array::<16>()?;
        let center = Vec3::new(m[3], m[7], m[11]);
        let radius = f64::from(self.case.get("radius")?.float()?);
        let to_center = (center - ctx.p).to_array().map(f64::from);
        let distance = to_center.iter().map(|x| x * x).sum::<f64>().sqrt();
        let sin_max = radius / distance;
        let one_minus_cos_max = sin_max * sin_max / (1.0 + (1.0 - sin_max * sin_max).sqrt());
        let theta = (1.0 - one_minus_cos_max * f64::from(u.x)).acos();
        let alpha = (theta.sin() / sin_max).min(1.0).asin() - theta;
        let (sin_phi, cos_phi) = (std::f64::consts::TAU * f64::from(u.y)).sin_cos();
        let local = [alpha.sin() * cos_phi, alpha.sin() * sin_phi, alpha.cos()]
            .map(|x| (-x * radius) as f32);
        let frame = Frame::from_z((center - ctx.p).normalize());
        Ok(Answer {
            p: center + frame.from_local(Vec3::from_array(local)),
            pdf: (1.0 / (std::f64::consts::TAU * one_minus_cos_max)) as f32,
        })
    }
}

/// The numbers of a sample after the map to the receiver's cosine, and their density, as published.
fn toward_cosine(ctx: &LightSampleContext, u: Vec2, points: [Vec3; 4]) -> (Vec2, f32) {
    if ctx.is_medium() {
        return (u, 1.0);
    }
    let weights = points.map(|p| (p - ctx.p).normalize().dot(ctx.ns).abs().max(0.01));
    let u = bilinear::sample(u, weights);
    (u, bilinear::pdf(u, weights))
}
