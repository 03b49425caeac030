use lights::bounds::LightSampleContext;
use lights::bvh::visibility::CellKey;
use lights::glam::Vec3;

use crate::View;

/// How large cells are: so many pixels of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct CellSize {
    camera: Vec3,
    /// Edge of a coarse cell at distance 0.
    fixed: f32,
    /// What each unit of distance adds to the edge.
    edge: f32,
}

impl CellSize {
    /// Edge of a coarse cell, in pixels.
    const PIXELS: f32 = 20.0;

    pub(super) fn of(view: &View) -> Self {
        let [fixed, edge] = view.pixel_width().map(|width| Self::PIXELS * width);
        Self {
            camera: view.camera().position,
            fixed,
            edge,
        }
    }

    #[inline]
    pub(super) fn fine_key(&self, ctx: &LightSampleContext) -> CellKey {
        CellKey::fine(ctx, self.coarse_edge(ctx))
    }

    /// The edge of the coarse cell at `ctx`, to the nearest power of two.
    #[inline]
    pub(super) fn coarse_edge(&self, ctx: &LightSampleContext) -> f32 {
        self.fixed + self.edge * ctx.p.distance(self.camera)
    }
}
