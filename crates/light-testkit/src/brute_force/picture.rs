use light_math::glam::{Affine2, DVec2, DVec3, Vec2};
use light_sources::{AlphaMask, Channels, Image, TextureMapping, Wrap};

use crate::Rng;

/// An image of light, of up to `most` texels along each side. A third of the texels are black, few
/// are bright.
pub(super) fn random_image(rng: &mut Rng, size: [u32; 2], channels: Channels) -> Image {
    let count = channels.count() * size[0] as usize * size[1] as usize;
    let brightest = rng.log_range(1.0, 100.0);
    let mut texel = |_| match rng.below(8) {
        0..=2 => 0.0,
        3 => brightest,
        _ => rng.f32(),
    };
    let mut texels: Vec<f32> = (0..count).map(&mut texel).collect();
    texels[0] = texels[0].max(0.25);
    Image::from_f32(size, channels, texels).expect("texels of light")
}

/// How an image lies on a surface: scaled, mirrored, turned, moved, and with any rule beyond its
/// edges.
pub(super) fn random_mapping(rng: &mut Rng) -> TextureMapping {
    let wraps = [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Black];
    let wrap = [0, 1].map(|_| wraps[rng.below(4)]);
    if rng.below(4) == 0 {
        return TextureMapping {
            wrap,
            ..TextureMapping::default()
        };
    }
    let mut scale = || rng.log_range(0.1, 4.0) * [1.0, -1.0][rng.below(2)];
    let scale = Vec2::new(scale(), scale());
    let turn = match rng.below(2) {
        0 => 0.0,
        _ => rng.range(0.0, 6.3),
    };
    let reach = [0.5, 3.0, 100.0][rng.below(3)];
    let offset = Vec2::new(rng.range(-reach, reach), rng.range(-reach, reach));
    TextureMapping {
        transform: Affine2::from_scale_angle_translation(scale, turn, offset),
        wrap,
    }
}

/// A mask with a cutoff or none, and a mapping of its own or none.
pub(super) fn random_mask(rng: &mut Rng) -> AlphaMask {
    let size = [1 + rng.below(8) as u32, 1 + rng.below(8) as u32];
    let mapping = match rng.below(3) {
        0 => Some(random_mapping(rng)),
        _ => None,
    };
    let cutoff = match rng.below(3) {
        0 => Some(rng.range(0.0, 1.0)),
        _ => None,
    };
    AlphaMask {
        scale: [1.0, rng.log_range(0.1, 10.0)][rng.below(2)],
        mapping,
        cutoff,
        ..random_image(rng, size, Channels::Gray).into()
    }
}

/// The colour of an image at the surface parameters `uv`, between the centres of four texels.
pub(super) fn color_at(image: &Image, mapping: &TextureMapping, uv: DVec2) -> DVec3 {
    let transform = mapping.transform;
    let [x, y, origin] = [
        transform.matrix2.x_axis,
        transform.matrix2.y_axis,
        transform.translation,
    ]
    .map(|v| v.as_dvec2());
    let place = x * uv.x + y * uv.y + origin;
    let place = DVec2::new(place.x, 1.0 - place.y);
    let [columns, rows] = [0, 1].map(|axis| {
        let n = image.size()[axis];
        let at = place[axis] * f64::from(n) - 0.5;
        let first = at.floor();
        let part = at - first;
        let texel = |i| texel_of(mapping.wrap[axis], i, n);
        [(texel(first), 1.0 - part), (texel(first + 1.0), part)]
    });
    let mut sum = DVec3::ZERO;
    for (y, y_part) in rows {
        for (x, x_part) in columns {
            if let (Some(x), Some(y)) = (x, y) {
                sum += image.texel(x, y).as_dvec3() * (x_part * y_part);
            }
        }
    }
    sum
}

/// The texel in place of the one at `i`, which may lie anywhere beside a row of `n`.
fn texel_of(wrap: Wrap, i: f64, n: u32) -> Option<u32> {
    let count = f64::from(n);
    let inside = match wrap {
        Wrap::Clamp => i.clamp(0.0, count - 1.0),
        Wrap::Repeat => i.rem_euclid(count),
        Wrap::Mirror => {
            let turn = i.rem_euclid(2.0 * count);
            turn.min(2.0 * count - 1.0 - turn)
        }
        Wrap::Black if i < 0.0 || i >= count => return None,
        Wrap::Black => i,
    };
    Some((inside as u32).min(n - 1))
}

/// The part of a surface that emits at `uv`.
pub(super) fn opacity(mask: &AlphaMask, mapping: &TextureMapping, uv: DVec2) -> f64 {
    let mapping = mask.mapping.as_ref().unwrap_or(mapping);
    let alpha = color_at(mask.texture.image(), mapping, uv).x * f64::from(mask.scale);
    match mask.cutoff {
        Some(cutoff) => f64::from(u8::from(alpha >= f64::from(cutoff))),
        None => alpha.min(1.0),
    }
}
