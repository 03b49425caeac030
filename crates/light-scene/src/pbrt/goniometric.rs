use core::f32::consts::PI;
use std::path::Path;

use lights::math::spectrum::photometric::Lumen;
use lights::math::spectrum::rec709_luminance;
use lights::sources::{Channels, GoniometricLightDesc, Image, IntensityAmount, LightDesc, Rgb};

use super::file_loc::Typed;
use super::lights::stated_luminance;
use super::state::Reader;
use crate::glam::{Affine3A, Mat3A, Vec3};
use crate::text::text_of;
use crate::{Camera, Diagnostic, goniometric_light, in_luminaire, parse_luminaire};

impl Reader {
    /// A light with a measured distribution: an equal-area image or, here only, the file of a
    /// luminaire.
    ///
    /// # Source
    /// `[PBRT4]`: images have z up where the light's space has y up.
    pub(super) fn goniometric(
        &mut self,
        typed: &Typed<'_>,
        transform: Affine3A,
        scale: f32,
    ) -> Result<LightDesc<Rgb>, Diagnostic> {
        let color = self.emission(typed, "I");
        let name = typed.parameters.string("filename");
        if let Some(name) = name.filter(|name| is_luminaire_name(name)) {
            return self.luminaire(typed, name, transform, color * scale);
        }
        let image = match name {
            Some(_) => self.light_image(typed)?,
            None => return Err(typed.at.diagnostic("expected \"string filename\"")),
        };
        let [width, height] = image.size();
        if width != height {
            let message = "expected a square, equal-area image for a goniometric light";
            return Err(typed.at.diagnostic(message));
        }
        let gray: Vec<f32> = image
            .texels()
            .map(Vec3::element_sum)
            .map(|sum| sum / 3.0)
            .collect();
        let distribution = Image::from_f32([width, height], Channels::Gray, gray);
        let distribution = distribution.map_err(|error| typed.at.diagnostic(error.to_string()))?;
        let scale = match typed.parameters.positive("power") {
            Some(power) => {
                scale * power / (4.0 * PI * distribution.mean().x * stated_luminance(typed, "I"))
            }
            None => scale,
        };
        let z_up = Affine3A::from_mat3(
            Mat3A::from_cols(Vec3::X.into(), Vec3::Z.into(), Vec3::Y.into()).into(),
        );
        Ok(LightDesc::Goniometric(GoniometricLightDesc {
            transform: transform * z_up,
            distribution,
            emission: color,
            amount: IntensityAmount::Radiometric(scale),
            media: self.light_media(),
        }))
    }

    /// A luminaire has the power of its file, times the colour. Its nadir is along -y and its
    /// photometric horizontal along x; its distribution is not mirrored in the picture.
    fn luminaire(
        &mut self,
        typed: &Typed<'_>,
        name: &str,
        transform: Affine3A,
        color: Vec3,
    ) -> Result<LightDesc<Rgb>, Diagnostic> {
        let path = self.resolve(name);
        let read = self.files.read(&path);
        let luminaire = read.and_then(|bytes| parse_luminaire(&path, &text_of(&bytes), self.files));
        let luminaire = luminaire.map_err(|error| typed.at.diagnostic(error.to_string()))?;
        let warnings = luminaire.warnings.iter();
        let warnings = warnings.map(|warning| in_luminaire(&path, warning));
        self.scene.warnings.extend(warnings);
        let power = typed
            .parameters
            .positive("power")
            .map(|watts| watts * 683.0);
        let lumens = power.unwrap_or_else(|| luminaire.web.total_lumens());
        let transform = transform * self.web_to_light();
        let mut light = goniometric_light(&luminaire.web, transform, color);
        let tint = rec709_luminance(color);
        light.amount = IntensityAmount::LuminousPower(Lumen(lumens * tint));
        light.media = self.light_media();
        Ok(LightDesc::Goniometric(light))
    }

    /// From the space of a web, which is right-handed, to that of the scene: left-handed unless the
    /// camera mirrors it.
    fn web_to_light(&self) -> Affine3A {
        let is_mirrored = |camera: Camera| camera.right.cross(camera.up).dot(camera.forward) < 0.0;
        if self.camera.is_some_and(is_mirrored) {
            Affine3A::IDENTITY
        } else {
            Affine3A::from_scale(Vec3::new(1.0, 1.0, -1.0))
        }
    }
}

fn is_luminaire_name(name: &str) -> bool {
    let ending = Path::new(name).extension().unwrap_or_default();
    ending.eq_ignore_ascii_case("ies") || ending.eq_ignore_ascii_case("ldt")
}

#[cfg(test)]
mod tests {
    use std::fs;

    use lights::math::equal_area::sphere_to_square;

    use super::*;
    use crate::test_folder::TestFolder;
    use crate::{Image as Picture, read_pbrt, write_exr};

    fn light(folder: &TestFolder, parameters: &str) -> GoniometricLightDesc<Rgb> {
        let path = folder.path("a.pbrt");
        let text = format!("WorldBegin LightSource \"goniometric\" {parameters}");
        fs::write(&path, text).expect("written");
        let scene = read_pbrt(&path).expect("a scene");
        assert_eq!(scene.warnings, [], "all understood");
        match &scene.lights[..] {
            [LightDesc::Goniometric(light)] => light.clone(),
            other => panic!("one light, not {other:?}"),
        }
    }

    fn toward(light: &GoniometricLightDesc<Rgb>, w: Vec3) -> f32 {
        let local = light.transform.inverse().transform_vector3(w);
        light.distribution.nearest(sphere_to_square(local)).x
    }

    #[test]
    fn images_have_z_up_and_the_mean_of_their_channels() {
        let folder = TestFolder::new("pbrt_goniometric");
        // The middle of the square is +z of the image.
        let mut texels = vec![Vec3::ZERO; 64];
        for at in [27, 28, 35, 36] {
            texels[at] = Vec3::new(3.0, 6.0, 0.0);
        }
        let picture = Picture::new(8, 8, texels).expect("an image");
        write_exr(&folder.path("a.exr"), &picture).expect("written");
        let plain = light(&folder, "\"string filename\" \"a.exr\" \"float scale\" 2");
        assert_eq!(toward(&plain, Vec3::Y), 3.0, "up is the middle");
        assert_eq!(toward(&plain, Vec3::Z), 0.0, "z is not");
        assert_eq!(plain.amount, IntensityAmount::Radiometric(2.0), "scale");
        let powered = light(&folder, "\"string filename\" \"a.exr\" \"float power\" 10");
        let IntensityAmount::Radiometric(scale) = powered.amount else {
            panic!("a factor");
        };
        let power = 4.0 * PI * scale * powered.distribution.mean().x;
        assert!((power - 10.0).abs() < 1e-4, "10 W, not {power}");
    }

    #[test]
    fn luminaires_hang_down_and_keep_their_lumens() {
        let folder = TestFolder::new("pbrt_luminaire");
        let file =
            "IESNA:LM-63-2002\nTILT=NONE\n1 2000 1 3 1 1 2 0 0 0\n1 1 100\n0 60 90\n0\n500 250 0\n";
        fs::write(folder.path("a.ies"), file).expect("written");
        let web = parse_luminaire(Path::new("a.ies"), file, crate::Files::NONE)
            .expect("a luminaire")
            .web;
        let lamp = light(&folder, "\"string filename\" \"a.ies\" \"float scale\" 2");
        assert!(toward(&lamp, Vec3::NEG_Y) > 0.97, "down");
        assert_eq!(toward(&lamp, Vec3::Y), 0.0, "nothing above");
        let IntensityAmount::LuminousPower(Lumen(lumens)) = lamp.amount else {
            panic!("lumens");
        };
        let expected = 2.0 * web.total_lumens();
        assert!(
            (lumens / expected - 1.0).abs() < 1e-5,
            "{lumens} of {expected} lm"
        );
    }
}
