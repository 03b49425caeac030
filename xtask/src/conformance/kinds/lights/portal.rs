use super::LightCase;
use super::rules::WRAP;
use crate::conformance::{Case, Findings, Malformed};
use lights::math::glam::{Vec2, Vec3};
use lights::sources::LightRef;
use std::f32::consts::PI;

impl LightCase<'_> {
    /// Compares the picture in portal space; answers whether some texel differs for the one reason that there is.
    pub(super) fn check_rectified(&self, findings: &mut Findings) -> Result<bool, Malformed> {
        let LightRef::PortalInfinite(light) = self.light else {
            return Ok(false);
        };
        let theirs = self.case.get("rectified_texels")?.floats()?;
        let frame = frame(&self.case)?;
        let to_light = super::build::rotation(&self.case)?.transpose();
        let n = light.rectified().size()[0];
        let sky_texels = self.case.get("image")?.get("texels")?.floats()?;
        let brightest = sky_texels.into_iter().fold(0.0, f32::max);
        let mut is_wrapped = false;
        for (i, ours) in (0..n * n).zip(light.rectified().texels()) {
            let (w, _) = direction(texel_center(i, n));
            let w = to_light * (frame[0] * w.x + frame[1] * w.y + frame[2] * w.z);
            let sky = lights::math::equal_area::sphere_to_square(w.normalize());
            let k = 3 * i as usize;
            let theirs = Vec3::new(theirs[k], theirs[k + 1], theirs[k + 2]);
            // The reference's inverse map is off by up to 2e-5.
            let near = ours.distance(theirs) <= 2e-5 * n as f32 * brightest;
            // Within half a texel of an edge, the other half comes from beyond.
            let at = sky * n as f32;
            let is_at_edge = at.min_element() < 0.5 || at.min_element() > n as f32 - 0.5;
            if !near && is_at_edge {
                is_wrapped = true;
            } else {
                findings.check(near, || {
                    format!("rectified texel {i}: {ours:?}, reference {theirs:?}")
                });
            }
        }
        if is_wrapped {
            findings.exempt(&WRAP);
        }
        Ok(is_wrapped)
    }
}

/// What the reference takes for the power of a portal, for a white of 1.
pub(super) fn reference_power(case: &Case<'_>) -> Result<f32, Malformed> {
    let texels = case.get("rectified_texels")?.floats()?;
    let n = (texels.len() as f32 / 3.0).sqrt().round();
    let sum: f32 = (0..)
        .zip(texels.chunks(3))
        .map(|(i, texel)| {
            let (_, solid_angle) = direction(texel_center(i, n as u32));
            (texel[0] + texel[1] + texel[2]) / 3.0 / solid_angle
        })
        .sum();
    let corner = |i| case.get("portal")?.at(i)?.vec3();
    let area = corner(0)?.distance(corner(1)?) * corner(0)?.distance(corner(3)?);
    Ok(case.get("scale")?.float()? * area * sum / (n * n))
}

fn frame(case: &Case<'_>) -> Result<[Vec3; 3], Malformed> {
    let axis = |i| case.get("portal_frame")?.at(i)?.vec3();
    Ok([axis(0)?, axis(1)?, axis(2)?])
}

fn texel_center(i: u32, n: u32) -> Vec2 {
    (Vec2::new((i % n) as f32, (i / n) as f32) + 0.5) / n as f32
}

/// The direction of a point of the portal's square, in its own frame, and the solid angle per area there.
fn direction(uv: Vec2) -> (Vec3, f32) {
    let [x, y] = [uv.x, uv.y].map(|t| ((t - 0.5) * PI).tan());
    let w = Vec3::new(x, y, 1.0).normalize();
    (w, PI * PI * (1.0 - w.x * w.x) * (1.0 - w.y * w.y) / w.z)
}
