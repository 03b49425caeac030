//! Every phase function against its own samples: chi-squared over the whole sphere, from a slanted direction.

use light_media::Phase;
use light_media::glam::Vec3;
use light_media::phase::{HenyeyGreenstein, Isotropic, MieHazy, MieMurky, Rayleigh, Schlick};
use light_testkit::DensityTest;

#[test]
fn samples_have_their_density() {
    let hg = |g| Phase::HenyeyGreenstein(HenyeyGreenstein::new(g).expect("in range"));
    let schlick = |g| Phase::Schlick(Schlick::from_asymmetry(g).expect("in range"));
    let all = [
        Phase::Isotropic(Isotropic),
        Phase::Rayleigh(Rayleigh),
        Phase::MieHazy(MieHazy),
        Phase::MieMurky(MieMurky),
        hg(0.0),
        hg(0.85),
        hg(-0.5),
        hg(1e-4),
        schlick(0.7),
        schlick(-0.9),
    ];
    let wo = Vec3::new(0.48, -0.6, 0.64);
    for phase in all {
        let outcome = DensityTest::default().sphere(
            |rng| Some(phase.sample(wo, rng.vec2()).wi),
            |wi| phase.pdf(wo, wi),
        );
        assert_eq!(outcome.fault(all.len()), None, "{phase:?}: {outcome:?}");
    }
}
