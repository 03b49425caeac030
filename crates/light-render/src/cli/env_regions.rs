use crate::ToneMap;
use light_scene::{Image, ImageError};
use lights::glam::{Vec2, Vec3};
use lights::math::SphereMap;
use lights::sources::{self, MedianCutLight};

/// Maps are drawn at least this wide.
const WIDTH: u32 = 1024;

/// Unless that would make them higher than this.
const HEIGHT: u32 = 4096;

const BORDER: Vec3 = Vec3::new(0.05, 0.9, 0.1);
const LIGHT: Vec3 = Vec3::new(1.0, 0.05, 0.05);

/// What a screen shows of a map, with the borders of regions and a dot for each light.
pub(super) fn draw_regions(
    map: &sources::Image,
    layout: SphereMap,
    lights: &[MedianCutLight],
) -> Result<Image, ImageError> {
    let radiance: Vec<Vec3> = map.texels().collect();
    let tone_map = ToneMap::fit(&radiance);
    // A tall map is drawn smaller, as is one of few columns and many rows.
    let [columns, rows] = map.size();
    let scale = WIDTH.div_ceil(columns).min(HEIGHT.div_ceil(rows));
    let [width, height] = map.size().map(|side| side * scale);
    let mut canvas = Canvas {
        texels: (0..height)
            .flat_map(|y| (0..width).map(move |x| [x / scale, y / scale]))
            .map(|[x, y]| tone_map.apply(map.texel(x, y)))
            .collect(),
        size: [width, height],
    };
    for light in lights {
        let [x0, y0] = light.region.min.map(|at| at * scale);
        let [x1, y1] = light.region.max.map(|at| at * scale);
        (x0..x1).for_each(|x| canvas.set(x, y0, BORDER));
        (y0..y1).for_each(|y| canvas.set(x0, y, BORDER));
    }
    for light in lights {
        let at = layout.point(light.direction) * Vec2::new(width as f32, height as f32);
        canvas.dot(at);
    }
    Image::new(width, height, canvas.texels)
}

struct Canvas {
    texels: Vec<Vec3>,
    size: [u32; 2],
}

impl Canvas {
    /// Colours a texel, if it is in the picture.
    fn set(&mut self, x: u32, y: u32, color: Vec3) {
        let [width, height] = self.size;
        if x < width && y < height {
            self.texels[y as usize * width as usize + x as usize] = color;
        }
    }

    /// Draws a dot of 3 by 3 texels.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "in the picture"
    )]
    fn dot(&mut self, at: Vec2) {
        let (x, y) = (at.x as u32, at.y as u32);
        for dy in 0..3 {
            for dx in 0..3 {
                self.set(
                    (x + dx).saturating_sub(1),
                    (y + dy).saturating_sub(1),
                    LIGHT,
                );
            }
        }
    }
}
