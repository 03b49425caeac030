use std::path::Path;

use super::state::{At, Reader};
use super::tokens::{Token, Tokens};
use crate::Diagnostic;
use crate::glam::{Mat4, Vec3};
use crate::gunzip::gunzipped;
use crate::text::{shown, text_of};

/// Files that include each other deeper than this include themselves.
const DEEPEST: usize = 32;

impl Reader {
    /// Carries out all directives of a file.
    pub(super) fn file(&mut self, path: &Path, text: &str, depth: usize) -> Result<(), Diagnostic> {
        let mut tokens = Tokens::new(path, text);
        while let Some(token) = tokens.next()? {
            let Token::Word(directive) = token else {
                return Err(tokens.expected("a directive", Some(&token)));
            };
            if matches!(directive, "Include" | "Import") {
                let name = tokens.quoted("a file name")?.into_owned();
                if depth == DEEPEST {
                    return Err(tokens.diagnostic("expected a file that does not include itself"));
                }
                let file = self.beside(&name);
                let refuse = |error: Diagnostic| tokens.diagnostic(error.to_string());
                let bytes = self.files.read(&file).map_err(refuse)?;
                let plain = gunzipped(&file, &bytes).map_err(refuse)?;
                // What an imported file does to the state ends with it.
                let before = (directive == "Import").then(|| self.state.clone());
                self.file(&file, &text_of(&plain), depth + 1)?;
                self.state = before.unwrap_or_else(|| core::mem::take(&mut self.state));
            } else {
                self.directive(path, &mut tokens, directive)?;
            }
        }
        Ok(())
    }

    fn directive(
        &mut self,
        path: &Path,
        tokens: &mut Tokens<'_>,
        directive: &str,
    ) -> Result<(), Diagnostic> {
        let at = At {
            path,
            line: tokens.line(),
        };
        match directive {
            "AttributeBegin" => self.saved.push(self.state.clone()),
            "AttributeEnd" => {
                let saved = self.saved_state();
                self.state = saved.ok_or_else(|| at.unmatched("AttributeBegin"))?;
            }
            "TransformBegin" => self.saved_transforms.push(self.state.transform),
            "TransformEnd" => {
                let saved = self.saved_transforms.pop();
                self.state.transform = saved.ok_or_else(|| at.unmatched("TransformBegin"))?;
            }
            "WorldBegin" => {
                self.in_world = true;
                self.state.transform = Mat4::IDENTITY;
                self.coordinates.insert("world".to_owned(), Mat4::IDENTITY);
            }
            "ObjectBegin" => {
                let name = tokens.quoted("an object's name")?;
                self.object_begin(at, &name)?;
            }
            "ObjectEnd" => self.object_end(at)?,
            "ObjectInstance" => {
                let name = tokens.quoted("an object's name")?;
                self.object_instance(at, &name)?;
            }
            "ReverseOrientation" => self.state.reversed ^= true,
            "NamedMaterial" => {
                let name = tokens.quoted("a material's name")?;
                self.state.material = Some(self.named_material(at, &name));
            }
            "MediumInterface" => self.medium_interface(at, tokens)?,
            "Option" => {
                super::parameters::Parameters::read(tokens)?;
                self.warn(at, "`Option`", "was ignored");
            }
            "Texture" => self.texture(path, tokens)?,
            _ if self.transform_directive(at, tokens, directive)? => {}
            _ => self.typed_directive(path, tokens, directive)?,
        }
        Ok(())
    }

    /// The directives that change the transform; whether it was one.
    fn transform_directive(
        &mut self,
        at: At<'_>,
        tokens: &mut Tokens<'_>,
        directive: &str,
    ) -> Result<bool, Diagnostic> {
        let now = self.state.transform;
        self.state.transform = match directive {
            "Identity" => Mat4::IDENTITY,
            "Translate" => now * Mat4::from_translation(Vec3::from(tokens.numbers("a distance")?)),
            "Scale" => now * Mat4::from_scale(Vec3::from(tokens.numbers("a factor")?)),
            "Rotate" => {
                let [angle, x, y, z] = tokens.numbers("an angle and an axis")?;
                let axis = Vec3::new(x, y, z).try_normalize();
                let axis =
                    axis.ok_or_else(|| at.diagnostic("expected an axis other than 0 0 0"))?;
                now * Mat4::from_axis_angle(axis, angle.to_radians())
            }
            "LookAt" => {
                let [ex, ey, ez, tx, ty, tz, ux, uy, uz] = tokens.numbers("nine coordinates")?;
                let (eye, target) = (Vec3::new(ex, ey, ez), Vec3::new(tx, ty, tz));
                // Left-handed: x to the right, y up, z into the scene.
                now * look_at(eye, target, Vec3::new(ux, uy, uz)).ok_or_else(|| {
                    at.diagnostic("expected two points, and an up vector not along the view")
                })?
            }
            // Files list matrices column by column.
            "Transform" => Mat4::from_cols_array(&tokens.numbers("sixteen numbers")?),
            "ConcatTransform" => now * Mat4::from_cols_array(&tokens.numbers("sixteen numbers")?),
            "CoordinateSystem" => {
                let name = tokens.quoted("a name")?.into_owned();
                self.coordinates.insert(name, now);
                now
            }
            "CoordSysTransform" => {
                let name = tokens.quoted("a name")?;
                let known = self.coordinates.get(name.as_ref()).copied();
                let message =
                    || format!("expected a coordinate system, found \"{}\"", shown(&name));
                known.ok_or_else(|| at.diagnostic(message()))?
            }
            _ => return Ok(false),
        };
        if self.state.transform.is_finite() && self.state.transform.determinant() != 0.0 {
            return Ok(true);
        }
        Err(at.diagnostic("expected a transform that can be inverted"))
    }

    /// The directives with a type in quotes and parameters.
    fn typed_directive(
        &mut self,
        path: &Path,
        tokens: &mut Tokens<'_>,
        directive: &str,
    ) -> Result<(), Diagnostic> {
        match directive {
            "Camera" | "Film" | "Shape" | "LightSource" | "AreaLightSource" | "Material"
            | "MakeNamedMaterial" | "Sampler" | "Integrator" | "Accelerator" | "PixelFilter"
            | "ColorSpace" | "MakeNamedMedium" | "Attribute" => {}
            other => {
                let message = format!("expected a directive, found `{}`", shown(other));
                return Err(tokens.diagnostic(message));
            }
        }
        let typed = self.typed(path, tokens, directive)?;
        let at = typed.at;
        match directive {
            "Camera" => self.set_camera(&typed)?,
            "Film" => self.film(&typed)?,
            "PixelFilter" => self.pixel_filter(&typed),
            "Shape" => self.shape(&typed)?,
            "LightSource" => self.light(&typed)?,
            "AreaLightSource" => self.area_light(&typed)?,
            "Material" => {
                let material = self.make_material(&typed.kind, &typed)?;
                self.state.material = Some(material);
            }
            "MakeNamedMaterial" => {
                let kind = typed
                    .parameters
                    .string("type")
                    .unwrap_or("diffuse")
                    .to_owned();
                let material = self.make_material(&kind, &typed)?;
                return self.name_material(typed.kind, material);
            }
            "MakeNamedMedium" => self.make_medium(&typed)?,
            "Attribute" => return self.attribute(typed),
            "ColorSpace" if typed.kind == "srgb" => {}
            _ => {
                self.warn(at, &format!("`{directive}`"), "was ignored");
                return Ok(());
            }
        }
        let name = format!("{directive} \"{}\"", typed.kind);
        self.warn_unused(at, &name, &typed.parameters);
        Ok(())
    }
}

/// From the world to a camera at `eye`.
fn look_at(eye: Vec3, target: Vec3, up: Vec3) -> Option<Mat4> {
    let forward = (target - eye).try_normalize()?;
    let right = up.try_normalize()?.cross(forward).try_normalize()?;
    let up = forward.cross(right);
    let to_world = Mat4::from_cols(
        right.extend(0.0),
        up.extend(0.0),
        forward.extend(0.0),
        eye.extend(1.0),
    );
    Some(to_world.inverse())
}
