//! FLIP: how different two pictures look to somebody who flips between them.
//!
//! The difference of a pixel is a number from 0, the same, to 1. Colours are compared as the eye
//! sees them from a distance, and edges and points add to it where only one picture has them. The
//! observer is that of the papers: 67 pixels a degree, a screen of 0.7 m and 3840 pixels seen from
//! 0.7 m.
//!
//! # Source
//! `[Andersson2020]` for what a screen shows, `[Andersson2021]` for radiance.

mod color;
mod contrast;
mod exposures;
mod features;
mod plane;

use lights::glam::Vec3;
use rayon::prelude::*;

use color::{hunt_lab, max_distance, opponent};
use contrast::Contrast;
use exposures::Exposures;
use features::{Derivatives, Features};
use plane::Plane;

/// Pixels a degree of the visual field.
const PIXELS_PER_DEGREE: f32 = 0.7 * 3840.0 / 0.7 * core::f32::consts::PI / 180.0;

/// What two pictures of the same size look like to somebody who flips between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Flip {
    /// The difference of each pixel, in `[0, 1]`, row by row.
    pub map: Vec<f32>,
}

impl Flip {
    /// Compares what a screen shows: linear radiance, clamped to `[0, 1]`, in rows of `width`
    /// pixels.
    ///
    /// `None` when the numbers of pixels differ, are zero, or make no whole rows.
    #[must_use]
    pub fn ldr(image: &[Vec3], reference: &[Vec3], width: u32) -> Option<Self> {
        expect_same_size(image, reference, width)?;
        let shown = |pixels: &[Vec3]| -> Vec<Vec3> {
            // NaN becomes black.
            let clamp = |x: f32| if x > 0.0 { x.min(1.0) } else { 0.0 };
            pixels.iter().map(|pixel| pixel.map(clamp)).collect()
        };
        let observer = Observer::new(width as usize);
        Some(Self {
            map: observer.differences(&shown(image), &shown(reference)),
        })
    }

    /// Compares radiance at exposures from that which shows the brightest pixel of the reference
    /// to that which shows the median one; the largest difference of each pixel counts. Negative
    /// radiance is black.
    ///
    /// `None` when the numbers of pixels differ, are zero, or make no whole rows.
    #[must_use]
    pub fn hdr(image: &[Vec3], reference: &[Vec3], width: u32) -> Option<Self> {
        expect_same_size(image, reference, width)?;
        let observer = Observer::new(width as usize);
        let mut map = vec![0.0_f32; image.len()];
        for exposure in Exposures::for_reference(reference).factors() {
            let [image, reference] =
                [image, reference].map(|pixels| exposures::show(pixels, exposure));
            let differences = observer.differences(&image, &reference);
            for (largest, difference) in map.iter_mut().zip(differences) {
                *largest = largest.max(difference);
            }
        }
        Some(Self { map })
    }

    /// The mean difference.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.map.iter().map(|&x| f64::from(x)).sum::<f64>() / self.map.len().max(1) as f64
    }
}

fn expect_same_size(image: &[Vec3], reference: &[Vec3], width: u32) -> Option<()> {
    let is_whole = width > 0 && image.len().is_multiple_of(width as usize);
    (image.len() == reference.len() && !image.is_empty() && is_whole).then_some(())
}

/// The filters of the observer.
struct Observer {
    width: usize,
    contrast: Contrast,
    derivatives: Derivatives,
}

/// What the observer makes of a picture.
struct Seen {
    /// Hunt-adjusted colours.
    colors: Vec<Vec3>,
    features: Features,
}

impl Observer {
    fn new(width: usize) -> Self {
        Self {
            width,
            contrast: Contrast::new(PIXELS_PER_DEGREE),
            derivatives: Derivatives::new(PIXELS_PER_DEGREE),
        }
    }

    fn see(&self, pixels: &[Vec3]) -> Seen {
        let opponents: Vec<Vec3> = pixels.par_iter().map(|&p| opponent(p)).collect();
        let planes = [0, 1, 2].map(|channel| {
            let values = opponents.iter().map(|color| color[channel]);
            Plane::new(self.width, values.collect())
        });
        let filtered = self.contrast.filter(&planes);
        let [achromatic, ..] = planes;
        let gray = achromatic.map(|y| (y + 16.0) / 116.0);
        Seen {
            colors: filtered.par_iter().map(|&color| hunt_lab(color)).collect(),
            features: self.derivatives.features(&gray),
        }
    }

    /// The difference of each pixel.
    ///
    /// # Source
    /// `[Andersson2020]`, sections 4.1.3, 4.2 and 4.3.
    fn differences(&self, image: &[Vec3], reference: &[Vec3]) -> Vec<f32> {
        let (image, reference) = (self.see(image), self.see(reference));
        let max = max_distance();
        let colors = image.colors.par_iter().zip(&reference.colors);
        colors
            .enumerate()
            .map(|(i, (&a, &b))| {
                let color = color::difference(a, b, max);
                let feature = image.features.difference(&reference.features, i);
                color.powf(1.0 - feature)
            })
            .collect()
    }
}
