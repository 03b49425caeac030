//! The lights: power, bounds, samples toward a point and outward, densities of both.

mod build;
mod description;
mod outward;
mod rectified;
mod rules;
mod toward;

use crate::oracle::lights::{ExactLight, light};
use crate::{Case, Checker, Findings, Malformed};
use glam::{DVec2, DVec3, Vec2, Vec3};
use lights::bounds::LightId;
use lights::sources::{LightRef, LightSet, Rgb};

/// Checks lights; the first line holds the spectrum of white.
#[derive(Debug, Default)]
pub(super) struct Lights {
    white: Vec<f32>,
}

/// A light of ours, the same in double precision, and the line that describes both.
struct LightCase<'a> {
    light: LightRef<'a, Rgb>,
    exact: Box<dyn ExactLight>,
    case: Case<'a>,
    kind: &'a str,
    /// 1, or -1 where the reference's normals are the opposite of ours.
    orientation: f32,
    is_two_sided: bool,
    is_annulus: bool,
}

impl Checker for Lights {
    fn check(&mut self, case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        if case.get("kind")?.text() == Some("header") {
            self.white = case.get("srgb_illuminant")?.floats()?;
            findings.equal("wavelengths", self.white.len(), 4);
            return Ok(());
        }
        let set = build::light_set(case)?;
        let light = LightCase::new(case, &set)?;
        light.check_rectified(findings)?;
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
            exact: light(case)?,
            case: *case,
            kind: case.get("type")?.text().unwrap_or_default(),
            orientation: if is_reversed { -1.0 } else { 1.0 },
            is_two_sided: case
                .find("two_sided")
                .is_some_and(|f| f.flag().unwrap_or(false)),
            is_annulus: inner_radius.transpose()?.is_some_and(|r| r > 0.0),
        })
    }

    /// Whether the light is a picture, of which each texel is a step.
    fn has_texels(&self) -> bool {
        self.case.find("image").is_some()
    }

    /// Whether the light is a patch that is no rectangle: its samples carry the density of their
    /// direction, rounded as it is, to the bit. At a grazing angle that is far from the density at
    /// the point of `u`.
    fn is_twisted(&self) -> bool {
        let is_rectangle = self.case.find("rectangle").and_then(|f| f.flag().ok());
        self.kind == "area_patch" && is_rectangle == Some(false)
    }

    fn is_area(&self) -> bool {
        self.kind.starts_with("area")
    }

    /// `uv` of the truth or the reference as it can be compared with `ours`: an angle around an
    /// axis is moved by a full turn if that is nearer, and counts as right on the axis.
    fn unwound(&self, uv: DVec2, ours: Vec2) -> DVec2 {
        let x = f64::from(ours.x);
        let on_axis = match self.kind {
            "area_sphere" => uv.y.min(1.0 - uv.y) < 1e-6,
            "area_disk" => !self.is_annulus && 1.0 - uv.y < 1e-6,
            _ => return uv,
        };
        DVec2::new(
            if on_axis {
                x
            } else {
                uv.x + (x - uv.x).round()
            },
            uv.y,
        )
    }

    /// A normal of ours as the reference turns it.
    fn turned(&self, n: DVec3) -> DVec3 {
        n * f64::from(self.orientation)
    }
}

/// The entries of a list that some lights have.
fn entries<'a>(case: &Case<'a>, name: &str) -> Result<Vec<Case<'a>>, Malformed> {
    match case.find(name) {
        Some(list) => Ok(list.items()?.collect()),
        None => Ok(Vec::new()),
    }
}

/// A number, or the three of a colour, as a colour; none for four wavelengths.
fn color(case: Case<'_>) -> Option<Vec3> {
    case.float().map(Vec3::splat).or_else(|_| case.vec3()).ok()
}

/// A number as a part of an answer.
fn number(x: f64) -> DVec3 {
    DVec3::new(x, 0.0, 0.0)
}

/// A field as a vector, none if there is none.
fn vec3_of(case: Option<Case<'_>>, name: &str) -> Result<Option<Vec3>, Malformed> {
    let field = case.and_then(|case| case.find(name));
    field.map(|v| v.vec3()).transpose()
}

/// A field as a number, none if there is none.
fn number_of(case: Option<Case<'_>>, name: &str) -> Result<Option<f32>, Malformed> {
    let field = case.and_then(|case| case.find(name));
    field.map(|x| x.float()).transpose()
}
