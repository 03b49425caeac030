use lights::bounds::LightSampleContext;
use lights::glam::{Vec2, Vec3};
use lights::media::{Medium, Phase};
use lights::sources::MediumId;

use super::direct::Scatters;
use super::path_state::PathVertex;
use crate::bsdf::{BsdfSample, Scattering};
use crate::{PrimitiveId, Ray, Surface, World};

/// A point at which a path through media scatters: on a surface or in a medium.
#[derive(Clone, Copy, Debug)]
pub(super) enum VolumeVertex {
    Surface {
        surface: Surface,
        scattering: Scattering,
        /// The medium of the segment that arrived.
        medium: Option<MediumId>,
    },
    Medium {
        p: Vec3,
        phase: Phase,
        medium: MediumId,
    },
}

/// A ray that leaves a vertex, with the primitive and the medium of its origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct VolumeRay {
    pub(super) ray: Ray,
    pub(super) from: Option<PrimitiveId>,
    pub(super) medium: Option<MediumId>,
}

impl VolumeVertex {
    /// The vertex on a surface that a segment in `medium` hit.
    pub(super) fn on_surface(world: &World, surface: Surface, medium: Option<MediumId>) -> Self {
        Self::Surface {
            surface,
            scattering: world.scattering(&surface),
            medium,
        }
    }

    /// The vertex at a point of a medium; `None` in vacuum.
    pub(super) fn in_medium(world: &World, p: Vec3, medium: MediumId) -> Option<Self> {
        let phase = *world.media().get(Some(medium))?.phase();
        Some(Self::Medium { p, phase, medium })
    }

    /// The ray that leaves in the direction `wi`.
    pub(super) fn spawn(&self, world: &World, wi: Vec3) -> VolumeRay {
        match self {
            Self::Surface {
                surface, medium, ..
            } => VolumeRay {
                ray: surface.spawn(wi),
                from: Some(surface.primitive),
                medium: world.medium_toward(surface, wi, *medium),
            },
            Self::Medium { p, medium, .. } => VolumeRay {
                ray: Ray {
                    origin: *p,
                    direction: wi,
                },
                from: None,
                medium: Some(*medium),
            },
        }
    }
}

impl Scatters for VolumeVertex {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        match self {
            Self::Surface { scattering, .. } => scattering.eval(wo, wi),
            Self::Medium { phase, .. } => Vec3::splat(phase.pdf(wo, wi)),
        }
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        match self {
            Self::Surface { scattering, .. } => scattering.pdf(wo, wi),
            Self::Medium { phase, .. } => phase.pdf(wo, wi),
        }
    }
}

impl PathVertex for VolumeVertex {
    fn is_dirac(&self) -> bool {
        match self {
            Self::Surface { scattering, .. } => scattering.bsdf().is_dirac(),
            Self::Medium { .. } => false,
        }
    }

    fn light_context(&self, world: &World, wo: Vec3) -> LightSampleContext {
        match self {
            Self::Surface {
                surface,
                scattering,
                ..
            } => world.light_context(surface, scattering, wo),
            Self::Medium { p, .. } => LightSampleContext::medium(*p),
        }
    }

    fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        match self {
            Self::Surface { scattering, .. } => scattering.sample(wo, u_lobe, u),
            Self::Medium { phase, .. } => {
                let sample = phase.sample(wo, u);
                Some(BsdfSample {
                    wi: sample.wi,
                    weight: Vec3::ONE,
                    pdf: Some(sample.pdf),
                    eta: 1.0,
                })
            }
        }
    }
}
