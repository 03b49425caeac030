use core::time::Duration;

use crate::{
    LightLayers, PictureIdentity, RenderSettings, SamplerKind, SceneDigest, View, Visibility, World,
};

use super::render_settings::FileSettings;

/// All that a picture depends on.
#[derive(Debug)]
pub(super) struct PreparedPicture {
    pub(super) world: World,
    pub(super) view: View,
    pub(super) settings: RenderSettings,
    pub(super) sampler: SamplerKind,
    pub(super) visibility: Visibility,
    /// Parts of its light that are wanted apart.
    pub(super) layers: Option<LightLayers>,
    /// How bright the file wants it shown.
    pub(super) exposure: Option<f32>,
    /// What else the file asks for.
    pub(super) file: FileSettings,
    pub(super) digest: SceneDigest,
}

impl PreparedPicture {
    /// Takes `time` away from the budget, if there is one.
    pub(super) fn spend(&mut self, time: Duration) {
        let limit = &mut self.settings.time_limit;
        *limit = limit.map(|limit| limit.saturating_sub(time));
    }

    /// Its identity, for files that hold parts of it. Takes the digest of the whole scene.
    pub(super) fn identity(&self) -> PictureIdentity {
        let Self {
            world,
            view,
            settings,
            ..
        } = self;
        self.digest
            .identity(world, view, settings, self.sampler, self.visibility)
    }
}
