use lights::bounds::LightId;
use lights::glam::Vec2;
use lights::samplers::LightSampler;
use rayon::prelude::*;

use super::scene_receiver::{SceneReceiver, points, receiver_at};
use super::variance_split::{LightMoments, VarianceSplit};
use crate::{AnyLightSampler, View, World};

/// The variance of one choice of a light at what a pixel shows.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelVariance {
    /// Column and row of the pixel, from the top left corner.
    pub pixel: [u32; 2],
    /// The lights that would give something if nothing were in the way.
    pub lights: usize,
    /// Of what they would give, the share that arrives.
    pub arriving: f64,
    /// For each sampler its variance, in the order of the samplers.
    pub splits: Vec<VarianceSplit>,
    /// The variance of the best choice there is.
    pub best: VarianceSplit,
}

/// The variance of one choice at each of `pixels`, by the light samples and rays of the renderer:
/// every light is tried with `strata` times `strata` points of it. Pixels that show nothing, a
/// light or a mirror are left out.
#[must_use]
pub fn pixel_variance(
    world: &World,
    view: &View,
    pixels: &[[u32; 2]],
    samplers: &[&AnyLightSampler],
    strata: u16,
) -> Vec<PixelVariance> {
    let at = |&pixel: &[u32; 2]| {
        let receiver = receiver_at(world, view, pixel, 0)?;
        let lights = moments(&receiver, world, &points(strata.max(1), receiver.key));
        let all: Vec<LightMoments> = lights.iter().map(|(_, light)| *light).collect();
        let unoccluded: f64 = all.iter().map(|light| light.unoccluded).sum();
        let by = |sampler: &&AnyLightSampler| {
            let pmf = |id| f64::from(sampler.pmf(&receiver.ctx, id));
            VarianceSplit::of(lights.iter().map(|&(id, light)| (light, pmf(id))))
        };
        let best = VarianceSplit::best(&all);
        Some(PixelVariance {
            pixel,
            lights: lights.len(),
            arriving: if unoccluded > 0.0 {
                best.total / unoccluded
            } else {
                0.0
            },
            splits: samplers.iter().map(by).collect(),
            best,
        })
    };
    pixels.iter().filter_map(at).collect()
}

/// As [`SceneReceiver::moments`], on all threads.
fn moments(
    receiver: &SceneReceiver,
    world: &World,
    points: &[Vec2],
) -> Vec<(LightId, LightMoments)> {
    let count = u32::try_from(world.lights().len()).unwrap_or(u32::MAX);
    let of = |id| (LightId(id), receiver.moments_of(world, LightId(id), points));
    let all = (0..count).into_par_iter().map(of);
    all.filter(|(_, light)| light.unoccluded > 0.0).collect()
}

impl VarianceSplit {
    /// The variance over the squared light that arrives; `None` in the dark.
    #[must_use]
    pub fn relative(&self) -> Option<f64> {
        (self.total > 0.0).then(|| self.sum() / (self.total * self.total))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SamplerKind;
    use light_scene::BuiltinScene;

    #[test]
    fn pixels_of_the_picture_see_the_lamp() {
        let scene = BuiltinScene::CornellBox.load();
        let view = View::new(&scene.camera_or_default(), 32, 32).expect("a view");
        let world = World::new(scene).expect("valid");
        let samplers = [SamplerKind::Uniform, SamplerKind::Bvh]
            .map(|kind| AnyLightSampler::new(kind, world.lights()).expect("lights"));
        let samplers = samplers.each_ref();
        // A column of the picture, and a pixel outside of it.
        let pixels: Vec<[u32; 2]> = (0..32).map(|y| [6, y]).chain([[5000, 0]]).collect();
        let found = pixel_variance(&world, &view, &pixels, &samplers, 4);
        assert!(found.iter().all(|at| at.pixel[0] == 6), "{found:?}");
        let lit: Vec<&PixelVariance> = found.iter().filter(|at| at.arriving > 0.0).collect();
        assert!(lit.len() > 8, "wall and floor: {found:?}");
        for at in lit {
            assert_eq!(at.lights, 2, "both triangles");
            let best = at.best.relative().expect("lit");
            for split in &at.splits {
                assert_eq!(split.lost, 0.0, "{split:?}");
                let v = split.relative().expect("lit");
                assert!(v >= best * (1.0 - 1e-12), "{v}, {best}");
            }
        }
    }
}
