use core::str::FromStr;

use light_scene::Crop;

use super::arguments::numbers;

/// A part of a picture, as shares of its width and height: `x0,x1,y0,y1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Window {
    /// Left and right end.
    pub(crate) x: [f64; 2],
    /// Upper and lower end.
    pub(crate) y: [f64; 2],
}

impl Window {
    /// The pixels whose left upper corners lie in the window.
    ///
    /// # Source
    /// `[PBRT4]`, section 5.4.2, with room for the rounding of a share that represents a whole
    /// number of pixels.
    pub(crate) fn pixels(&self, width: u32, height: u32) -> Crop {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "shares of a size, from 0 to 1"
        )]
        let pixel = |share: f64, size: u32| (share * f64::from(size) - 1e-6).ceil() as u32;
        Crop {
            min: [pixel(self.x[0], width), pixel(self.y[0], height)],
            max: [pixel(self.x[1], width), pixel(self.y[1], height)],
        }
    }
}

impl FromStr for Window {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let [x0, x1, y0, y1] = numbers::<4>(text)?.map(f64::from);
        let is_range = |a: f64, b: f64| 0.0 <= a && a < b && b <= 1.0;
        if is_range(x0, x1) && is_range(y0, y1) {
            Ok(Self {
                x: [x0, x1],
                y: [y0, y1],
            })
        } else {
            Err("expected x0 below x1 and y0 below y1, all from 0 to 1".into())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_are_parts_of_the_picture() {
        let window: Window = "0.25,0.75,0,0.5".parse().expect("a window");
        let crop = Crop {
            min: [25, 0],
            max: [75, 10],
        };
        assert_eq!(window.pixels(100, 20), crop, "the middle, the upper half");
        for bad in [
            "0,1,0",
            "1,0,0,1",
            "0,1,0.5,0.5",
            "0,2,0,1",
            "-1,1,0,1",
            "nan,1,0,1",
        ] {
            assert!(bad.parse::<Window>().is_err(), "{bad}");
        }
    }
}
