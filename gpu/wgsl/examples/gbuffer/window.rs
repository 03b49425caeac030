//! A window for the picture.

use core::error::Error;

use light_math::glam::Vec3;
use minifb::{Key, Scale, Window, WindowOptions};

/// Shows a picture of `width` columns and `height` rows, of 1 frame, then of twice as many again
/// and again, until the window is closed or Escape is pressed. `picture` makes that of so many
/// frames.
///
/// # Errors
/// Where there is no display, or what `picture` returns.
pub fn show(
    [width, height]: [u32; 2],
    picture: impl Fn(u32) -> Result<Vec<Vec3>, Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let size = [width as usize, height as usize];
    let options = WindowOptions { scale: Scale::X2, ..WindowOptions::default() };
    let mut window = Window::new("gbuffer", size[0], size[1], options)
        .map_err(|why| format!("no window can be opened here: {why}"))?;
    window.set_target_fps(30);
    let mut frames = 1;
    while window.is_open() && !window.is_key_down(Key::Escape) {
        if frames <= MOST_FRAMES {
            let shown = picture(frames)?;
            let words: Vec<u32> = shown.iter().map(|&color| word(color)).collect();
            window.set_title(&format!("gbuffer: {frames} frames"));
            window.update_with_buffer(&words, size[0], size[1])?;
            frames *= 2;
        } else {
            window.update();
        }
    }
    Ok(())
}

/// After so many frames the picture stays as it is.
const MOST_FRAMES: u32 = 1 << 12;

/// A colour of the screen in sRGB, as 0RGB.
fn word(color: Vec3) -> u32 {
    let encode = |linear: f32| {
        let linear = linear.clamp(0.0, 1.0);
        let encoded = if linear <= 0.003_130_8 {
            12.92 * linear
        } else {
            1.055 * linear.powf(1.0 / 2.4) - 0.055
        };
        (255.0 * encoded + 0.5) as u32
    };
    color.to_array().into_iter().fold(0, |word, channel| word << 8 | encode(channel))
}
