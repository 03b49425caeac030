use std::path::{Component, Path};

use lights::math::spectrum::photometric::Lumen;
use lights::photometry::{self, Luminaire, PhotometricWeb, parse_eulumdat, parse_lm63};
use lights::sources::{Channels, ColorModel, GoniometricLightDesc, Image, IntensityAmount};

use crate::glam::Affine3A;
use crate::text::{read_text, text_of};
use crate::{Diagnostic, Files, Location};

/// The luminaire that a file describes: EULUMDAT if its name ends in `.ldt`, LM-63 otherwise.
///
/// A file that `TILT=` names is searched in the same folder; a name that leads out of it is refused.
///
/// # Errors
/// When a file cannot be read or is malformed: file, line and what was expected there.
pub fn read_luminaire(path: &Path) -> Result<Luminaire, Diagnostic> {
    parse_luminaire(path, &read_text(path)?, Files::DISK)
}

/// As [`read_luminaire`], from the text of the file; `path` says by its ending which format it has,
/// and names it in messages. A file that `TILT=` names is read from `files`.
///
/// # Errors
/// As [`read_luminaire`].
pub fn parse_luminaire(path: &Path, text: &str, files: Files<'_>) -> Result<Luminaire, Diagnostic> {
    let extension = path.extension().unwrap_or_default();
    let luminaire = if extension.eq_ignore_ascii_case("ldt") {
        parse_eulumdat(text)
    } else {
        parse_lm63(text, |name| read_next_to(path, name, files))
    };
    luminaire.map_err(|error| in_luminaire(path, &error))
}

/// The text of the file `name` in the folder of `path`, or why there is none. Nothing outside of
/// that folder is opened: the file may come from anywhere, and messages show what they found.
pub(crate) fn read_next_to(path: &Path, name: &str, files: Files<'_>) -> Result<String, String> {
    let mut parts = Path::new(name).components();
    if !parts.all(|part| matches!(part, Component::Normal(_) | Component::CurDir)) {
        return Err("expected a file in the same folder".into());
    }
    let bytes = files.read(&path.with_file_name(name));
    bytes
        .map(|bytes| text_of(&bytes).into_owned())
        .map_err(|error| error.message)
}

/// A message about the luminaire whose file is `path`.
#[must_use]
pub fn in_luminaire(path: &Path, message: &photometry::Diagnostic) -> Diagnostic {
    let beside = message
        .tilt_file
        .as_ref()
        .map(|name| path.with_file_name(name));
    let location = message.line.map_or(Location::File, Location::Line);
    Diagnostic::at(
        beside.as_deref().unwrap_or(path),
        location,
        &message.message,
    )
}

/// Texels per side of the map of a luminaire: 0.8 degrees each, and twice and four times as fine for
/// beams whose peak that would flatten.
const MAP_SIZES: [u32; 3] = [256, 512, 1024];

/// The least part of its peak that a web keeps in a map, unless the map is the largest.
const KEPT: f32 = 0.97;

/// A goniometric light with the distribution and the luminous power of `web`, in an equal-area map as
/// fine as its beam needs.
#[must_use]
pub(crate) fn goniometric_light<C: ColorModel>(
    web: &PhotometricWeb,
    transform: Affine3A,
    emission: C::Emission,
) -> GoniometricLightDesc<C> {
    // A dark one has no peak to keep.
    let least = if web.peak_candelas() > 0.0 { KEPT } else { 0.0 };
    let (mut size, mut parts) = (0, Vec::new());
    for finer in MAP_SIZES {
        (size, parts) = (finer, web.distribution(finer));
        if parts.iter().any(|&part| part >= least) {
            break;
        }
    }
    let distribution = Image::from_f32([size, size], Channels::Gray, parts);
    let distribution = distribution.expect("a square of parts of the peak");
    let amount = IntensityAmount::LuminousPower(Lumen(web.total_lumens()));
    GoniometricLightDesc::new(transform, distribution, emission, amount)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use lights::bounds::{LightId, LightSampleContext};
    use lights::photometry::WebType;
    use lights::sources::{Light, LightDesc, LightSetBuilder, PdfCoverage, Rgb, SceneSphere};

    use super::*;
    use crate::glam::{Vec2, Vec3};
    use crate::test_folder::TestFolder;

    fn near(value: f32, expected: f32, part: f32, what: &str) {
        let error = (value - expected).abs();
        assert!(error <= part * expected, "{what}: {value} for {expected}");
    }

    #[test]
    fn a_tilt_file_comes_from_the_files_of_the_caller() {
        let folder = TestFolder::new("luminaire_tilt");
        let text = "TILT=lamp.tlt\n1 1000 1 2 1 1 1 0 0 0\n1 1 12\n0 90\n0\n10 5\n";
        fs::write(folder.path("a.ies"), text).expect("written");
        let missing = read_luminaire(&folder.path("a.ies")).expect_err("no file");
        assert!(
            missing
                .message
                .starts_with("TILT names `lamp.tlt`: cannot be read"),
            "{missing}"
        );
        fs::write(folder.path("lamp.tlt"), "1\n3\n0 45 90\n1 0.9 0.7\n").expect("written");
        let lamp = read_luminaire(&folder.path("a.ies")).expect("well-formed");
        assert_eq!(lamp.tilt.expect("a tilt").factor(0.0), 1.0, "beside");
        let refused = parse_luminaire(&folder.path("a.ies"), text, Files::NONE);
        assert!(
            refused
                .expect_err("no files")
                .message
                .ends_with("not allowed"),
            "the file is there, but must not be read"
        );
        fs::write(folder.path("lamp.tlt"), "1\n2\n0 0\n1 1\n").expect("written");
        let broken = read_luminaire(&folder.path("a.ies")).expect_err("no tilt");
        assert_eq!(
            broken.path,
            folder.path("lamp.tlt"),
            "the file that is wrong"
        );
        assert_eq!(broken.location, Location::Line(4), "and the line");
    }

    #[test]
    fn a_tilt_file_is_in_the_folder() {
        let folder = TestFolder::new("luminaire_tilt_out");
        fs::create_dir_all(folder.path("sub")).expect("a folder");
        fs::write(folder.path("lamp.tlt"), "1\n3\n0 45 90\n1 0.9 0.7\n").expect("written");
        let read = |folder_name: &str, name: &str| {
            let text = format!("TILT={name}\n1 1000 1 2 1 1 1 0 0 0\n1 1 12\n0 90\n0\n10 5\n");
            let path = folder.path(folder_name).join("a.ies");
            parse_luminaire(&path, &text, Files::DISK)
        };
        assert!(read("", "./lamp.tlt").is_ok(), "in the folder");
        let whole = folder.path("lamp.tlt").display().to_string();
        for name in ["../lamp.tlt", "../sub/../lamp.tlt", &whole] {
            let error = read("sub", name).expect_err("outside");
            let is_refused = error
                .message
                .ends_with("expected a file in the same folder");
            assert!(is_refused, "{name}: {error}");
        }
    }

    #[test]
    fn a_web_becomes_a_light_of_its_power_and_shape() {
        let steps: Vec<f32> = (0..=18u8).map(|i| 10.0 * f32::from(i)).collect();
        let turn: Vec<f32> = (0..=24u8).map(|i| 15.0 * f32::from(i)).collect();
        let candelas: Vec<f32> = (turn.iter())
            .flat_map(|h| {
                steps
                    .iter()
                    .map(|v| (200.0 - v) * (2.0 + h.to_radians().sin()))
            })
            .collect();
        let web = PhotometricWeb::new(WebType::C, &steps, &turn, &candelas).expect("a web");
        let mut builder =
            LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere"));
        let desc = goniometric_light::<Rgb>(&web, Affine3A::IDENTITY, Vec3::ONE);
        builder.add(LightDesc::Goniometric(desc)).expect("a light");
        let set = builder.build();
        let light = set.get(LightId(0)).expect("one");
        near(683.0 * light.phi(&()).x, web.total_lumens(), 1e-4, "lumens");
        for w in [
            Vec3::new(0.3, -0.8, 0.2),
            Vec3::new(-0.5, 0.1, 0.7),
            Vec3::new(0.1, 0.9, -0.3),
        ] {
            let w = w.normalize();
            let ctx = LightSampleContext::medium(w);
            let sample = light
                .sample_li(&ctx, Vec2::ZERO, &(), PdfCoverage::Complete)
                .expect("in sight");
            near(
                683.0 * sample.l.x,
                web.toward(w),
                0.03,
                "candela at 1 m are lux",
            );
        }
    }

    /// Beams as narrow as a step of their table, and a wide one with a fine table.
    #[test]
    fn maps_are_as_fine_as_their_beams() {
        for (step, reach, size, part) in [
            (1.0f32, 60.0, 256, 0.02),
            (10.0, 10.0, 512, 0.05),
            (5.0, 5.0, 1024, 0.03),
            (2.5, 2.5, 1024, 0.05),
            (1.0, 1.0, 1024, 0.12),
        ] {
            let rows = (0..=90u8).map(|i| step * f32::from(i));
            let vertical: Vec<f32> = rows.take_while(|&angle| angle <= 90.0).collect();
            let candelas: Vec<f32> = vertical
                .iter()
                .map(|x| (1.0 - x / reach).max(0.0))
                .collect();
            let web = PhotometricWeb::new(WebType::C, &vertical, &[0.0], &candelas);
            let web = web.expect("a web");
            let light = goniometric_light::<Rgb>(&web, Affine3A::IDENTITY, Vec3::ONE);
            assert_eq!(light.distribution.size(), [size; 2], "{step}, {reach}");
            let peak = light.distribution.texels().map(|texel| texel.x);
            let relative = peak.fold(0.0, f32::max) / light.distribution.mean().x;
            let exact = 4.0 * core::f32::consts::PI * web.peak_candelas() / web.total_lumens();
            near(relative, exact, part, "peak");
        }
    }
}
