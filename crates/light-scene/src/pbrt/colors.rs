//! Parameters that are colours.

use super::parameter::{Parameter, ParameterType, single};
use super::parameters::Parameters;
use super::spectrum;
use crate::glam::Vec3;

use ParameterType::{Blackbody, Rgb, Spectrum};

impl Parameters {
    /// A colour that may exceed 1: a coefficient per unit length. `None` for a spectrum by name.
    pub(super) fn unbounded(&self, name: &str) -> Option<Vec3> {
        self.value(name, &[Rgb, Blackbody, Spectrum], |p| match p.kind {
            Rgb => p.rgb().map(Some),
            Blackbody => of_temperature(p, spectrum::blackbody_share).map(Some),
            _ => sampled(p, spectrum::unbounded),
        })
        .flatten()
    }

    /// A colour that light is multiplied with, as RGB at most `most`. `None` for a spectrum by
    /// name.
    pub(super) fn reflectance(&self, name: &str, most: f32) -> Option<Vec3> {
        self.value(name, &[Rgb, Blackbody, Spectrum], |p| match p.kind {
            Blackbody => {
                let share = of_temperature(p, spectrum::blackbody_share)?;
                Ok(Some(share.min(Vec3::ONE)))
            }
            Rgb => {
                let rgb = p.rgb()?;
                if rgb.max_element() > most {
                    let name = p.shown();
                    return Err(format!("expected a colour of at most {most} for `{name}`"));
                }
                Ok(Some(rgb))
            }
            _ => sampled(p, spectrum::reflectance),
        })
        .flatten()
    }

    /// The colour of a light, of luminance 1 unless it is given as RGB. `None` for a spectrum whose
    /// name is not known.
    pub(super) fn emission(&self, name: &str) -> Option<Vec3> {
        self.value(name, &[Rgb, Blackbody, Spectrum], |p| match p.kind {
            Rgb => p.rgb().map(Some),
            Blackbody => of_temperature(p, spectrum::blackbody).map(Some),
            _ => match p.words.first() {
                Some(_) => p.word().map(spectrum::named_emission),
                None => sampled(p, spectrum::emission),
            },
        })
        .flatten()
    }
}

/// What `color` makes of a temperature in kelvin.
fn of_temperature(
    parameter: &Parameter,
    color: impl Fn(f32) -> Option<Vec3>,
) -> Result<Vec3, String> {
    let [kelvin] = parameter.exactly()?;
    color(kelvin).ok_or_else(|| {
        let name = parameter.shown();
        format!("expected a temperature in kelvin for `{name}`, found {kelvin}")
    })
}

/// What `color` makes of a table of wavelengths and values; nothing of a name.
fn sampled(
    parameter: &Parameter,
    color: impl Fn(&[f32]) -> Option<Vec3>,
) -> Result<Option<Vec3>, String> {
    if !parameter.words.is_empty() {
        return parameter.word().map(|_| None);
    }
    let name = parameter.shown();
    let values = parameter.numbers.iter().skip(1).step_by(2);
    if let Some(value) = values.map(|&n| single(n)).find(|&value| value < 0.0) {
        return Err(format!(
            "expected values of at least 0 for `{name}`, found {value}"
        ));
    }
    let found = color(&parameter.singles()).map(Some);
    found.ok_or_else(|| {
        format!("expected ascending wavelengths for `{name}`, each with its value, not all 0")
    })
}
