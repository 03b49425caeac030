//! A window for the picture.

use core::error::Error;

use light_scene::Image;
use minifb::{Key, Scale, Window, WindowOptions};

/// Shows a picture of `width` columns and `height` rows, of 1 frame, then of twice as many again
/// and again, until the window is closed or Escape is pressed. `picture` makes that of so many
/// frames.
///
/// # Errors
/// Where there is no display, or what `picture` returns.
pub fn show(
    [width, height]: [u32; 2],
    picture: impl Fn(u32) -> Result<Image, Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let size = [width as usize, height as usize];
    let options = WindowOptions { scale: Scale::X2, ..WindowOptions::default() };
    let mut window = Window::new("gbuffer", size[0], size[1], options)
        .map_err(|why| format!("no window can be opened here: {why}"))?;
    window.set_target_fps(30);
    let mut frames = 1;
    while window.is_open() && !window.is_key_down(Key::Escape) {
        if frames <= MOST_FRAMES {
            let shown = picture(frames)?.to_srgb();
            let word = |[r, g, b]: [u8; 3]| u32::from_be_bytes([0, r, g, b]);
            let words: Vec<u32> = shown.into_iter().map(word).collect();
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
