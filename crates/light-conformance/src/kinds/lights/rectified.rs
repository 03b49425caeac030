use super::LightCase;
use super::rules::WRAP;
use crate::comparison::Comparison;
use crate::oracle::lights::PortalSky;
use crate::{Findings, Malformed, Tolerance};
use lights::sources::LightRef;

impl LightCase<'_> {
    /// Compares the picture in portal space.
    pub(super) fn check_rectified(&self, findings: &mut Findings) -> Result<(), Malformed> {
        let LightRef::PortalInfinite(light) = self.light else {
            return Ok(());
        };
        let exact = PortalSky::new(&self.case)?;
        let theirs = self.case.get("rectified_texels")?.floats()?;
        let [n, _] = light.rectified().size();
        findings.equal(
            "size of the rectified picture",
            3 * n * n,
            theirs.len() as u32,
        );
        let sky_texels = self.case.get("image")?.get("texels")?.floats()?;
        let brightest = sky_texels.into_iter().fold(0.0, f32::max);
        // The reference's inverse map is off by up to 2e-5.
        let theirs_off = Tolerance::new(0.0, 2e-5 * n as f32 * brightest);
        let ours_off = Tolerance::new(1e-5, 1e-6 * n as f32 * brightest);
        let texels = light.rectified().texels().zip(theirs.chunks(3));
        for ((ours, theirs), exact) in texels.zip(exact.rectified()) {
            let ours = findings.ours("rectified texel", ours);
            let mut comparison = Comparison::default();
            comparison.vec3("texel", ours, None, ours_off);
            comparison.settle(findings, || &WRAP, |_| Some(vec![*exact]));
            let is_near = (0..3).all(|i| theirs_off.accepts(ours[i], theirs[i]));
            if !is_near {
                findings.exempt(&WRAP);
            }
        }
        Ok(())
    }
}
