use core::str::FromStr;

use clap::{Args, ValueEnum};
use light_scene::Image;

use crate::{ToneCurve, ToneMap};

/// How the picture is shown: in .png files, never in .exr.
#[derive(Args, Debug, Default)]
pub(crate) struct DisplayArgs {
    /// Show it 2^EV times as bright, or as bright as its mean asks for (auto); without it as the
    /// scene's file says, or auto.
    #[arg(long, value_name = "EV|auto", allow_hyphen_values = true)]
    exposure: Option<Exposure>,
    /// How bright parts become white: gradually above a knee (soft), from black on (reinhard), or
    /// where they are 1 (clip).
    #[arg(long, value_name = "NAME", value_enum, default_value_t)]
    tone_map: ToneMapName,
}

/// The exposure on the command line.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Exposure {
    /// What brings the mean to middle grey.
    Auto,
    /// The base-2 logarithm of the factor.
    Stops(f32),
}

/// The names of the curves on the command line.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum ToneMapName {
    #[default]
    Soft,
    Reinhard,
    Clip,
}

impl DisplayArgs {
    /// Whether the exposure is fitted to the picture, whose file asks for the factor `of_file`.
    pub(crate) fn is_auto(&self, of_file: Option<f32>) -> bool {
        match self.exposure {
            Some(exposure) => exposure == Exposure::Auto,
            None => of_file.is_none(),
        }
    }

    /// How `image` is shown, whose file asks for the factor `of_file`.
    pub(crate) fn tone_map(&self, image: &Image, of_file: Option<f32>) -> ToneMap {
        let fit = || ToneMap::fit(image.texels());
        let map = match self.exposure {
            Some(Exposure::Auto) => fit(),
            Some(Exposure::Stops(stops)) => ToneMap::new(stops.exp2()),
            None => of_file.map_or_else(fit, ToneMap::new),
        };
        map.with_curve(match self.tone_map {
            ToneMapName::Soft => ToneCurve::Soft,
            ToneMapName::Reinhard => ToneCurve::Reinhard,
            ToneMapName::Clip => ToneCurve::Clip,
        })
    }
}

impl FromStr for Exposure {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "auto" {
            return Ok(Self::Auto);
        }
        let stops = text.parse().ok();
        let stops = stops.filter(|stops: &f32| (-100.0..=100.0).contains(stops));
        let stops = stops.ok_or("expected auto, or a number of stops from -100 to 100")?;
        Ok(Self::Stops(stops))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exposures_are_stops_or_automatic() {
        assert_eq!("auto".parse(), Ok(Exposure::Auto), "automatic");
        assert_eq!("-1.5".parse(), Ok(Exposure::Stops(-1.5)), "darker");
        for bad in ["", "x", "nan", "inf", "101"] {
            assert!(bad.parse::<Exposure>().is_err(), "{bad}");
        }
    }
}
