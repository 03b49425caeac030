//! The picture that an example writes.

use core::error::Error;

use lights::glam::Vec3;

/// Writes `out/NAME.png` from the light of each pixel, by column and row, where 1 is white.
pub(crate) fn save(
    name: &str,
    [width, height]: [u32; 2],
    pixel: impl Fn(u32, u32) -> Vec3,
) -> Result<(), Box<dyn Error>> {
    // The gamma of a screen.
    let shown = |l: Vec3| (255.0 * l.powf(1.0 / 2.2)).to_array().map(to_byte);
    let picture = image::RgbImage::from_fn(width, height, |x, y| image::Rgb(shown(pixel(x, y))));
    std::fs::create_dir_all("out")?;
    let file = format!("out/{name}.png");
    picture.save(&file)?;
    println!("{file}");
    Ok(())
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates, as a screen does"
)]
const fn to_byte(x: f32) -> u8 {
    x as u8
}
