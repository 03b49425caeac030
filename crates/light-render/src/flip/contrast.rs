use core::f32::consts::PI;

use lights::glam::Vec3;

use super::plane::{Kernel, Plane};

/// The contrast sensitivity of the eye as filters, one for each opponent colour.
///
/// # Source
/// `[Andersson2020]`, section 4.1.1 and table 1: sums of Gaussians.
pub(super) struct Contrast {
    channels: [Vec<Term>; 3],
}

/// A Gaussian of a filter.
struct Term {
    kernel: Kernel,
    /// Its share of the filter.
    share: f32,
}

/// Weights `a` and spreads `b` of the Gaussians of each channel; spreads in square degrees.
const TERMS: [&[(f32, f32)]; 3] = [
    &[(1.0, 0.0047)],
    &[(1.0, 0.0053)],
    &[(34.1, 0.04), (13.5, 0.025)],
];

/// The largest spread, which the size of all filters follows.
const WIDEST: f32 = 0.04;

impl Contrast {
    pub(super) fn new(pixels_per_degree: f32) -> Self {
        let deviation = (WIDEST / (2.0 * PI * PI)).sqrt();
        let radius = whole(3.0 * deviation * pixels_per_degree);
        let gaussian = |b: f32| {
            Kernel::new(radius, |pixels| {
                let degrees = pixels / pixels_per_degree;
                (-PI * PI * degrees * degrees / b).exp()
            })
        };
        let channels = TERMS.map(|terms| {
            let terms: Vec<(Kernel, f32)> = terms
                .iter()
                .map(|&(a, b)| {
                    let kernel = gaussian(b);
                    let volume = a * (PI / b).sqrt() * kernel.sum() * kernel.sum();
                    (kernel.normalized(), volume)
                })
                .collect();
            let sum: f32 = terms.iter().map(|(_, volume)| volume).sum();
            let share = |(kernel, volume)| Term {
                kernel,
                share: volume / sum,
            };
            terms.into_iter().map(share).collect()
        });
        Self { channels }
    }

    /// The filtered opponent colours.
    pub(super) fn filter(&self, planes: &[Plane; 3]) -> Vec<Vec3> {
        let [y, cx, cz] = [0, 1, 2].map(|channel| {
            let parts = self.channels[channel].iter().map(|Term { kernel, share }| {
                planes[channel]
                    .along_rows(kernel)
                    .along_columns(kernel, *share)
            });
            parts
                .reduce(|a, b| a.plus(&b))
                .map_or(Vec::new(), |plane| plane.values().to_vec())
        });
        let chroma = cx.into_iter().zip(cz);
        let colors = y.into_iter().zip(chroma);
        colors.map(|(y, (cx, cz))| Vec3::new(y, cx, cz)).collect()
    }
}

/// The next whole number of pixels.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "tens of pixels"
)]
pub(super) fn whole(pixels: f32) -> usize {
    pixels.ceil() as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn filters_keep_constant_pictures() {
        let contrast = Contrast::new(67.0);
        let plane = Plane::new(3, vec![5.0; 12]);
        for color in contrast.filter(&[plane.clone(), plane.clone(), plane]) {
            assert!(color.distance(Vec3::splat(5.0)) < 1e-4, "{color}");
        }
    }
}
