//! The lights: power, bounds, samples toward a point and outward, densities of both.

mod build;
mod description;
mod differences;
mod exact;
mod outward;
mod portal;
mod projection;
mod rules;
mod toward;

use crate::conformance::{Case, Checker, Findings, Malformed};
use lights::bounds::LightId;
use lights::math::glam::{Vec2, Vec3};
use lights::sources::{LightRef, LightSet, Rgb};

/// Checks lights; the first line tells the spectrum of white.
#[derive(Debug, Default)]
pub(super) struct Lights {
    white: Vec<f32>,
}

/// A light of ours and the line that describes it.
struct LightCase<'a> {
    light: LightRef<'a, Rgb>,
    case: Case<'a>,
    kind: &'a str,
    /// 1, or -1 where the reference's normals are the opposite of ours.
    orientation: f32,
    is_two_sided: bool,
    is_annulus: bool,
    /// Whether the reference's picture in portal space differs from ours.
    is_wrapped: bool,
}

impl Checker for Lights {
    fn check(&mut self, case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        if case.get("kind")?.text() == Some("header") {
            self.white = case.get("srgb_illuminant")?.floats()?;
            findings.equal("wavelengths", self.white.len(), 4);
            return Ok(());
        }
        let set = build::light_set(case)?;
        let mut light = LightCase::new(case, &set)?;
        light.is_wrapped = light.check_rectified(findings)?;
        light.check_description(&self.white, findings)?;
        light.check_toward(findings)?;
        light.check_outward(findings)
    }
}

impl<'a> LightCase<'a> {
    fn new(case: &Case<'a>, set: &'a LightSet<Rgb>) -> Result<Self, Malformed> {
        let is_reversed = build::is_reversed(case)?;
        let inner_radius = case.find("inner_radius").map(|r| r.float());
        Ok(Self {
            light: set
                .get(LightId(0))
                .ok_or(Malformed("no light".to_owned()))?,
            case: *case,
            kind: case.get("type")?.text().unwrap_or_default(),
            orientation: if is_reversed { -1.0 } else { 1.0 },
            is_two_sided: case
                .find("two_sided")
                .is_some_and(|f| f.flag().unwrap_or(false)),
            is_annulus: inner_radius.transpose()?.is_some_and(|r| r > 0.0),
            is_wrapped: false,
        })
    }

    /// Whether the light is a picture, of which each texel is a step.
    fn has_texels(&self) -> bool {
        self.case.find("image").is_some()
    }

    /// Whether `theirs` is the answer of some direction beside `w`, as far as the reference's inverse map is off.
    fn is_beside(&self, w: Vec3, theirs: f32, ours: impl Fn(Vec3) -> f32) -> bool {
        const OFF: f32 = 3e-4;
        let steps =
            (0..27).map(|i| Vec3::new((i % 3) as f32, (i / 3 % 3) as f32, (i / 9) as f32) - 1.0);
        let near = |answer: f32| (answer - theirs).abs() <= 2e-3 * theirs.abs();
        self.has_texels()
            && steps
                .map(|s| (w + s * OFF).normalize())
                .any(|w| near(ours(w)))
    }
}

/// The entries of a list that some lights have.
fn entries<'a>(case: &Case<'a>, name: &str) -> Result<Vec<Case<'a>>, Malformed> {
    match case.find(name) {
        Some(list) => Ok(list.items()?.collect()),
        None => Ok(Vec::new()),
    }
}

/// A number, or the three of a colour, as a colour.
fn color(case: Case<'_>) -> Result<Vec3, Malformed> {
    case.float().map(Vec3::splat).or_else(|_| case.vec3())
}

/// `uv` whose u, an angle, is moved by a full turn if that is nearer to `reference`.
fn unwound(uv: Vec2, reference: Vec2) -> Vec2 {
    let turns = (reference.x - uv.x).round();
    Vec2::new(uv.x + turns, uv.y)
}
