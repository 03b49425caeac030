use lights::glam::Vec3;

/// A direction that [`Bsdf::sample`](super::Bsdf::sample) chose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// Where the light comes from.
    pub wi: Vec3,
    /// The scattering function times the cosine, over the density: the factor by which the path's
    /// throughput is multiplied by.
    pub weight: Vec3,
    /// Density of `wi` in sr^-1; `None` for a Dirac, which no other strategy can choose.
    pub pdf: Option<f32>,
    /// Index of refraction on the side of `wi` over that on the side of `wo`: radiance is
    /// scaled by its square.
    pub eta: f32,
}

impl BsdfSample {
    /// A reflection towards `wi`, of which the scattering function is `eval` and the density `pdf`;
    /// `None` where that is 0.
    #[inline]
    pub(super) fn reflected(wi: Vec3, eval: impl FnOnce() -> Vec3, pdf: f32) -> Option<Self> {
        (pdf > 0.0).then(|| Self {
            wi,
            weight: eval() / pdf,
            pdf: Some(pdf),
            eta: 1.0,
        })
    }
}
