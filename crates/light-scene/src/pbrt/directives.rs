use std::path::Path;

use super::file_loc::{FileLoc, Typed};
use super::state::Reader;
use super::tokens::{Token, Tokens};
use crate::Diagnostic;
use crate::glam::{Mat4, Vec3, Vec4};
use crate::text::shown;

/// The directives about the picture as a whole, before `WorldBegin`.
const OPTIONS: [&str; 6] = [
    "Camera",
    "Film",
    "PixelFilter",
    "Sampler",
    "Integrator",
    "Accelerator",
];

impl Reader {
    /// Carries out all directives of a file.
    pub(super) fn file(&mut self, path: &Path, text: &str, depth: usize) -> Result<(), Diagnostic> {
        let mut tokens = Tokens::new(path, text);
        while let Some(token) = tokens.next()? {
            let Token::Word(directive) = token else {
                return Err(tokens.expected("a directive", Some(&token)));
            };
            match directive {
                "Include" => self.include(&mut tokens, depth)?,
                "Import" => self.import(&mut tokens, depth)?,
                _ => self.directive(path, &mut tokens, directive)?,
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
        let at = FileLoc {
            path,
            line: tokens.line(),
        };
        if self.in_world && OPTIONS.contains(&directive) {
            let message = format!("expected `{directive}` before `WorldBegin`");
            return Err(at.diagnostic(message));
        }
        match directive {
            "AttributeBegin" => {
                self.save_state(at, "expected `AttributeEnd` after `AttributeBegin`")?;
            }
            "AttributeEnd" => {
                let saved = self.saved_state();
                self.state = saved.ok_or_else(|| at.unmatched("AttributeBegin"))?;
            }
            "TransformBegin" => self.save_transform(at)?,
            "TransformEnd" => {
                let saved = self.saved_transforms.pop();
                let saved = saved.ok_or_else(|| at.unmatched("TransformBegin"))?;
                self.state.transform = saved.state;
            }
            "WorldBegin" if self.in_world => {
                return Err(at.diagnostic("expected one `WorldBegin` only"));
            }
            "WorldBegin" => {
                self.in_world = true;
                self.state.transform = Mat4::IDENTITY;
                self.state.is_active = true;
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
            "Option" => self.option(at, tokens)?,
            "ActiveTransform" => self.active_transform(at, tokens)?,
            "TransformTimes" => {
                tokens.numbers::<2>("two times")?;
                self.warn_of_motion(at, "`TransformTimes`");
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
        at: FileLoc<'_>,
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
        let transform = self.state.transform;
        if !self.state.is_active {
            // It acts on the end of the motion alone.
            self.state.transform = now;
            return Ok(true);
        }
        if !transform.is_finite() {
            return Err(at.diagnostic("expected a transform of finite numbers"));
        }
        if transform.row(3) != Vec4::W {
            return Err(at.diagnostic("expected a transform whose last row is 0 0 0 1"));
        }
        Ok(true)
    }

    /// `ActiveTransform`: what follows moves the scene at the start of the motion, at its end, or
    /// at both.
    fn active_transform(
        &mut self,
        at: FileLoc<'_>,
        tokens: &mut Tokens<'_>,
    ) -> Result<(), Diagnostic> {
        let token = tokens.next()?;
        self.state.is_active = match token {
            Some(Token::Word("All" | "StartTime")) => true,
            Some(Token::Word("EndTime")) => {
                self.warn_of_motion(at, "`ActiveTransform`");
                false
            }
            other => return Err(tokens.expected("All, StartTime or EndTime", other.as_ref())),
        };
        Ok(())
    }

    fn warn_of_motion(&mut self, at: FileLoc<'_>, what: &str) {
        self.warn(
            at,
            what,
            "moves something; the picture shows it at its start time",
        );
    }

    /// `Option "name" value`, in older files `Option "type name" value`: no setting of pbrt itself
    /// has a part in this program.
    fn option(&mut self, at: FileLoc<'_>, tokens: &mut Tokens<'_>) -> Result<(), Diagnostic> {
        let name = tokens.quoted("the name of an option")?;
        let bracketed = tokens.peek()? == Some(Token::Open);
        if bracketed {
            tokens.next()?;
        }
        let value = tokens.next()?;
        if !matches!(value, Some(Token::Word(_) | Token::Quoted(_))) {
            return Err(tokens.expected("the value of an option", value.as_ref()));
        }
        if bracketed {
            let token = tokens.next()?;
            if token != Some(Token::Close) {
                return Err(tokens.expected("]", token.as_ref()));
            }
        }
        self.warn(at, &format!("`Option \"{name}\"`"), "was ignored");
        Ok(())
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
        if let Some(Token::Quoted(kind)) = tokens.peek()? {
            let line = tokens.line();
            self.look_for_version_3(FileLoc { path, line }, directive, &kind);
        }
        let typed = self.typed(path, tokens, directive)?;
        if directive == "Attribute" {
            return self.attribute(typed);
        }
        let done = self.carry_out(&typed, directive);
        // A faulty parameter explains the errors that follow from it.
        typed.parameters.check()?;
        done
    }

    fn carry_out(&mut self, typed: &Typed<'_>, directive: &str) -> Result<(), Diagnostic> {
        match directive {
            "Camera" => self.set_camera(typed)?,
            "Film" => self.film(typed)?,
            // Of all filters the program has the box of one pixel.
            "PixelFilter" | "Accelerator" => typed.parameters.accept_all(),
            "Sampler" => self.sampler(typed),
            "Integrator" => self.integrator(typed),
            "Shape" => self.shape(typed)?,
            "LightSource" => self.light(typed)?,
            "AreaLightSource" => self.area_light(typed)?,
            "Material" => {
                let material = self.make_material(&typed.kind, typed)?;
                self.state.material = Some(material);
            }
            "MakeNamedMaterial" => {
                let kind = typed.parameters.string("type").map(str::to_owned);
                let message = "expected \"string type\" of a named material";
                let kind = kind.ok_or_else(|| typed.at.diagnostic(message))?;
                self.look_for_version_3(typed.at, "Material", &kind);
                let material = self.make_material(&kind, typed)?;
                return self.name_material(typed.kind.clone(), material);
            }
            "MakeNamedMedium" => self.make_medium(typed)?,
            "ColorSpace" if typed.kind == "srgb" => {}
            _ => {
                self.warn(typed.at, &format!("`{directive}`"), "was ignored");
                return Ok(());
            }
        }
        // The file chose the names of media and materials: not each is a kind.
        let is_named = matches!(directive, "MakeNamedMedium" | "MakeNamedMaterial");
        let name = if is_named {
            directive.to_owned()
        } else {
            format!("{directive} \"{}\"", typed.kind)
        };
        self.warn_unused(typed.at, &name, &typed.parameters);
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
    let inverse = to_world.inverse();
    // Rounding must not make a projection of it.
    let column = |index, w| inverse.col(index).truncate().extend(w);
    let [x, y, z] = [0, 1, 2].map(|index| column(index, 0.0));
    Some(Mat4::from_cols(x, y, z, column(3, 1.0)))
}
