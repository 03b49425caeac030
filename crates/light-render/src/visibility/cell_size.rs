use lights::bounds::LightSampleContext;
use lights::bvh::visibility::CellKey;
use lights::glam::Vec3;

use crate::View;

/// How large cells are: so many pixels of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct CellSize {
    camera: Vec3,
    /// Edge of a coarse cell at distance 1.
    edge: f32,
}

impl CellSize {
    /// Edge of a coarse cell, in pixels.
    const PIXELS: f32 = 20.0;

    pub(super) fn of(view: &View) -> Self {
        Self {
            camera: view.camera().position,
            edge: Self::PIXELS * view.pixel_angle(),
        }
    }

    #[inline]
    pub(super) fn fine_key(&self, ctx: &LightSampleContext) -> CellKey {
        CellKey::fine(ctx, self.edge * ctx.p.distance(self.camera))
    }
}
