use std::collections::HashMap;

use lights::sources::{TextureMapping, Wrap};

use crate::glam::{Affine2, Vec2};
use crate::image::{IMAGE_ENDINGS, TexelBudget, is_image_name, parse_image, parse_opacity};
use crate::text::{Line, shown};
use crate::{ColorImage, Diagnostic, Files, ImageId, Scene};

/// The options that a file name may follow, and how many words each takes at most.
const OPTIONS: [(&str, usize); 14] = [
    ("-blendu", 1),
    ("-blendv", 1),
    ("-bm", 1),
    ("-boost", 1),
    ("-cc", 1),
    ("-clamp", 1),
    ("-colorspace", 1),
    ("-imfchan", 1),
    ("-mm", 2),
    ("-o", 3),
    ("-s", 3),
    ("-t", 3),
    ("-texres", 1),
    ("-type", 1),
];

/// The quantity that a texture gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Content {
    Color,
    /// The alpha channel of an image that has one, the brightness of others.
    Opacity,
}

/// The images of a library, each read once.
#[derive(Debug)]
pub(super) struct Textures<'a> {
    files: Files<'a>,
    by_name: HashMap<(String, Content), ImageId>,
    budget: TexelBudget,
}

/// What a line names.
#[derive(Debug, Default)]
pub(super) struct Texture {
    /// `None` if its format is not supported.
    pub(super) image: Option<ColorImage>,
    pub(super) warnings: Vec<Diagnostic>,
}

impl<'a> Textures<'a> {
    pub(super) fn new(files: Files<'a>) -> Self {
        Self {
            files,
            by_name: HashMap::new(),
            budget: TexelBudget::default(),
        }
    }

    /// The options and the file that are left of a line.
    pub(super) fn load(
        &mut self,
        content: Content,
        line: &mut Line<'_>,
        scene: &mut Scene,
    ) -> Result<Texture, Diagnostic> {
        let mut texture = Texture::default();
        let mapping = mapping(line, &mut texture.warnings)?;
        let name = line.rest("a file name")?;
        let path = line.path().with_file_name(name.replace('\\', "/"));
        if !is_image_name(&path) {
            let name = shown(&name);
            let message = format!("`{name}` was ignored: expected {IMAGE_ENDINGS}");
            texture.warnings.push(line.diagnostic(message));
            return Ok(texture);
        }
        let key = (name, content);
        let image = match self.by_name.get(&key) {
            Some(&known) => known,
            None => {
                let bytes = match self.files.read(&path) {
                    Ok(bytes) => bytes,
                    Err(error) => {
                        let message = format!("{error}; the texture was left out");
                        texture.warnings.push(line.diagnostic(message));
                        return Ok(texture);
                    }
                };
                let file = match content {
                    Content::Color => parse_image(&path, &bytes),
                    Content::Opacity => parse_opacity(&path, &bytes),
                };
                let file = file.and_then(|file| {
                    self.budget.take(&path, file.image.size())?;
                    Ok(file)
                });
                let file = file.map_err(|error| line.diagnostic(error.to_string()))?;
                texture.warnings.extend(file.warning);
                let image = scene.add_image(file.image);
                *self.by_name.entry(key).or_insert(image)
            }
        };
        texture.image = Some(ColorImage {
            mapping,
            ..ColorImage::new(image)
        });
        Ok(texture)
    }
}

/// Reads the options before a file name.
fn mapping(
    line: &mut Line<'_>,
    warnings: &mut Vec<Diagnostic>,
) -> Result<TextureMapping, Diagnostic> {
    let (mut scale, mut offset) = (Vec2::ONE, Vec2::ZERO);
    let mut wrap = Wrap::Repeat;
    while let Some((option, words)) = option(line) {
        match option {
            "-s" => scale = one_to_three(line, Vec2::ONE)?,
            "-o" => offset = one_to_three(line, Vec2::ZERO)?,
            "-clamp" => wrap = clamp(line)?,
            // Neighbouring texels blend here whatever the file wants.
            "-blendu" | "-blendv" => skip(line, words),
            _ => {
                let message = format!("option `{option}` is not understood and was ignored");
                warnings.push(line.diagnostic(message));
                skip(line, words);
            }
        }
    }
    Ok(TextureMapping {
        transform: Affine2::from_scale_angle_translation(scale, 0.0, offset),
        wrap: [wrap; 2],
    })
}

/// The next word, if it is an option, and how many words it takes at most.
fn option(line: &mut Line<'_>) -> Option<(&'static str, usize)> {
    let mut after = line.clone();
    let word = after.word()?;
    let known = OPTIONS.into_iter().find(|(option, _)| *option == word)?;
    *line = after;
    Some(known)
}

/// A number for u, which may be followed by ones for v and for the depth of a solid texture.
fn one_to_three(line: &mut Line<'_>, default: Vec2) -> Result<Vec2, Diagnostic> {
    let mut numbers = Vec2::new(line.number("a number")?, default.y);
    if let Some(v) = next_number(line) {
        numbers.y = v;
        next_number(line);
    }
    Ok(numbers)
}

fn clamp(line: &mut Line<'_>) -> Result<Wrap, Diagnostic> {
    match line.word() {
        Some("on") => Ok(Wrap::Clamp),
        Some("off") => Ok(Wrap::Repeat),
        _ => Err(line.diagnostic("expected `-clamp on` or `-clamp off`")),
    }
}

/// Leaves out a word and then numbers, as long as there are some, up to `most` words.
fn skip(line: &mut Line<'_>, most: usize) {
    line.word();
    for _ in 1..most {
        next_number(line);
    }
}

/// The next word, if it is a number.
fn next_number(line: &mut Line<'_>) -> Option<f32> {
    let mut after = line.clone();
    let number = after.number("a number").ok()?;
    *line = after;
    Some(number)
}
