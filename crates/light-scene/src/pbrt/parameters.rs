use alloc::rc::Rc;
use core::cell::Cell;
use std::path::Path;

use super::spectrum;
use super::tokens::{Token, Tokens, number_of};
use crate::glam::{Vec2, Vec3};
use crate::text::{shown, text_of};
use crate::{Diagnostic, Files, Place};

/// The parameter list of a directive, which remembers what was asked for.
#[derive(Debug)]
pub(super) struct Parameters {
    list: Vec<Parameter>,
    /// What `Attribute` directives have said before, the last one first.
    inherited: Vec<Rc<Self>>,
}

#[derive(Debug)]
struct Parameter {
    kind: String,
    name: String,
    line: usize,
    numbers: Vec<f64>,
    words: Vec<String>,
    used: Cell<bool>,
}

impl Parameters {
    /// Takes all parameters that follow.
    pub(super) fn read(tokens: &mut Tokens<'_>) -> Result<Self, Diagnostic> {
        let mut list = Vec::new();
        while let Some(Token::Quoted(declaration)) = tokens.peek()? {
            tokens.next()?;
            let mut words = declaration.split_whitespace();
            let (Some(kind), Some(name), None) = (words.next(), words.next(), words.next()) else {
                let declaration = shown(&declaration);
                let message = format!("expected \"TYPE NAME\", found \"{declaration}\"");
                return Err(tokens.diagnostic(message));
            };
            let mut parameter = Parameter {
                kind: kind.to_owned(),
                name: name.to_owned(),
                line: tokens.line(),
                numbers: Vec::new(),
                words: Vec::new(),
                used: Cell::new(false),
            };
            if tokens.peek()? == Some(Token::Open) {
                tokens.next()?;
                loop {
                    let value = tokens.next()?;
                    if value == Some(Token::Close) {
                        break;
                    }
                    parameter.push(tokens, value)?;
                }
            } else {
                let value = tokens.next()?;
                parameter.push(tokens, value)?;
            }
            list.push(parameter);
        }
        let inherited = Vec::new();
        Ok(Self { list, inherited })
    }

    /// Takes over what the directive itself does not say.
    pub(super) fn inherit(&mut self, earlier: impl Iterator<Item = Rc<Self>>) {
        self.inherited.extend(earlier);
    }

    /// Reads the files that spectra are in, whose names start from `root`; a word without an ending is the name of a spectrum.
    pub(super) fn load_spectra(
        &mut self,
        path: &Path,
        root: &Path,
        files: Files<'_>,
    ) -> Result<(), Diagnostic> {
        for parameter in self.list.iter_mut().filter(|p| p.kind == "spectrum") {
            let Some(file) = parameter.words.first() else {
                continue;
            };
            let file = root.with_file_name(file);
            if file.extension().is_none() {
                continue;
            }
            let refuse =
                |message: String| Diagnostic::at(path, Place::Line(parameter.line), message);
            let bytes = files
                .read(&file)
                .map_err(|error| refuse(error.to_string()))?;
            let pairs = spectrum::pairs_of(&text_of(&bytes)).ok_or_else(|| {
                let file = file.display();
                refuse(format!(
                    "{file}: expected pairs of a wavelength and a value"
                ))
            })?;
            parameter.numbers = pairs;
        }
        Ok(())
    }

    /// Names and lines of the parameters that nobody asked for.
    pub(super) fn unused(&self) -> impl Iterator<Item = (&str, usize)> {
        let unused = self.list.iter().filter(|p| !p.used.get());
        unused.map(|p| (p.name.as_str(), p.line))
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.find(name).is_some()
    }

    /// Marks a parameter as known, though it has no say here.
    pub(super) fn accept(&self, name: &str) {
        self.value(name, Some);
    }

    pub(super) fn number(&self, name: &str) -> Option<f32> {
        self.value(name, |p| p.numbers.first().map(|&n| single(n)))
    }

    pub(super) fn number_or(&self, name: &str, default: f32) -> f32 {
        self.number(name).unwrap_or(default)
    }

    /// All numbers; outside `None` if there is no such parameter, inside if there are not `N`.
    pub(super) fn numbers<const N: usize>(&self, name: &str) -> Option<Option<[f32; N]>> {
        self.value(name, |p| Some(p.singles().try_into().ok()))
    }

    pub(super) fn string(&self, name: &str) -> Option<&str> {
        self.value(name, |p| p.words.first().map(String::as_str))
    }

    /// All words.
    pub(super) fn strings(&self, name: &str) -> &[String] {
        self.value(name, |p| Some(&p.words[..])).unwrap_or_default()
    }

    /// Whether a parameter says `true` or, where it is not given, whether `default` does.
    pub(super) fn is_true(&self, name: &str, default: bool) -> bool {
        self.value(name, |p| match p.words.first()?.as_str() {
            "true" => Some(true),
            "false" => Some(false),
            _ => None,
        })
        .unwrap_or(default)
    }

    /// The name of the texture that a parameter refers to.
    pub(super) fn texture(&self, name: &str) -> Option<&str> {
        self.value(name, |p| {
            let word = p.words.first().filter(|_| p.kind == "texture")?;
            Some(word.as_str())
        })
    }

    /// Whole numbers of at least 0.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked to be whole and in range"
    )]
    pub(super) fn indices(&self, name: &str) -> Option<Vec<u32>> {
        let whole = |&n: &f64| {
            (n >= 0.0 && n <= f64::from(u32::MAX) && n.fract() == 0.0).then_some(n as u32)
        };
        self.value(name, |p| p.numbers.iter().map(whole).collect())
    }

    /// All numbers, however many.
    pub(super) fn list(&self, name: &str) -> Option<Vec<f32>> {
        self.value(name, |p| Some(p.singles()))
    }

    /// A colour that may exceed 1: a coefficient per unit length.
    pub(super) fn unbounded(&self, name: &str) -> Option<Vec3> {
        self.value(name, |p| match p.kind.as_str() {
            "rgb" => p.rgb(),
            "spectrum" => spectrum::unbounded(&p.singles()),
            _ => None,
        })
    }

    /// Points of the plane; none if their coordinates do not come in twos.
    pub(super) fn vec2s(&self, name: &str) -> Option<Vec<Vec2>> {
        self.value(name, |p| {
            let vec2 = |c: &[f64]| Vec2::new(single(c[0]), single(c[1]));
            let chunks = p.numbers.chunks_exact(2);
            chunks
                .remainder()
                .is_empty()
                .then(|| chunks.map(vec2).collect())
        })
    }

    /// Points; none if their coordinates do not come in threes.
    pub(super) fn vec3s(&self, name: &str) -> Option<Vec<Vec3>> {
        self.value(name, |p| {
            let vec3 = |c: &[f64]| Vec3::new(single(c[0]), single(c[1]), single(c[2]));
            let chunks = p.numbers.chunks_exact(3);
            chunks
                .remainder()
                .is_empty()
                .then(|| chunks.map(vec3).collect())
        })
    }

    pub(super) fn vec3_or(&self, name: &str, default: Vec3) -> Vec3 {
        let all = self.vec3s(name).unwrap_or_default();
        all.first().copied().unwrap_or(default)
    }

    /// A colour that light is multiplied with.
    pub(super) fn reflectance(&self, name: &str) -> Option<Vec3> {
        self.value(name, |p| match p.kind.as_str() {
            "rgb" => p.rgb(),
            "spectrum" => spectrum::reflectance(&p.singles()),
            _ => p.numbers.first().map(|&n| Vec3::splat(single(n))),
        })
    }

    /// The colour of a light, of luminance 1 unless it is given as RGB.
    pub(super) fn emission(&self, name: &str) -> Option<Vec3> {
        self.value(name, |p| match p.kind.as_str() {
            "rgb" => p.rgb(),
            "blackbody" => spectrum::blackbody(single(*p.numbers.first()?)),
            "spectrum" => match p.words.first() {
                Some(name) if p.numbers.is_empty() => spectrum::named_emission(name),
                _ => spectrum::emission(&p.singles()),
            },
            _ => None,
        })
    }

    /// What `value` makes of a parameter, which counts as used if that is something.
    fn value<'a, T>(
        &'a self,
        name: &str,
        value: impl FnOnce(&'a Parameter) -> Option<T>,
    ) -> Option<T> {
        let found = self.find(name)?;
        let value = value(found)?;
        found.used.set(true);
        Some(value)
    }

    fn find(&self, name: &str) -> Option<&Parameter> {
        let own = self.list.iter().find(|p| p.name == name);
        own.or_else(|| self.inherited.iter().find_map(|earlier| earlier.find(name)))
    }
}

impl Parameter {
    fn push(&mut self, tokens: &Tokens<'_>, value: Option<Token<'_>>) -> Result<(), Diagnostic> {
        match value {
            Some(Token::Word(word @ ("true" | "false"))) => self.words.push(word.to_owned()),
            Some(Token::Word(word)) if number_of(word).is_some() => {
                self.numbers.extend(word.parse::<f64>().ok());
            }
            Some(Token::Quoted(text)) => self.words.push(text.into_owned()),
            other => {
                let what = format!("a value of `{}`", shown(&self.name));
                return Err(tokens.expected(&what, other.as_ref()));
            }
        }
        Ok(())
    }

    fn rgb(&self) -> Option<Vec3> {
        let [r, g, b] = self.singles()[..] else {
            return None;
        };
        Some(Vec3::new(r, g, b))
    }

    fn singles(&self) -> Vec<f32> {
        self.numbers.iter().map(|&n| single(n)).collect()
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "checked to be finite as f32"
)]
const fn single(number: f64) -> f32 {
    number as f32
}
