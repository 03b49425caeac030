use core::cell::Cell;
use core::fmt;
use std::path::Path;

use super::tokens::{Token, Tokens, number_of};
use super::upgrade::UPGRADE;
use crate::glam::Vec3;
use crate::text::shown;
use crate::{Diagnostic, Location};

/// One parameter of a directive; its values are of its type, and as many as that needs.
#[derive(Debug)]
pub(super) struct Parameter {
    pub(super) kind: ParameterType,
    pub(super) name: String,
    pub(super) line: usize,
    pub(super) numbers: Vec<f64>,
    pub(super) words: Vec<String>,
    /// Whether it was read.
    pub(super) used: Cell<bool>,
}

/// The type of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ParameterType {
    Bool,
    Integer,
    Float,
    /// A point or a vector of the plane.
    Pair,
    /// A point, a vector or a normal in space.
    Triple,
    Rgb,
    Blackbody,
    Spectrum,
    String,
    Texture,
}

impl ParameterType {
    /// The types of pbrt-v4, as an error lists them.
    const NAMES: &str = "bool, integer, float, point2, vector2, point3, vector3, normal, rgb, \
                         blackbody, spectrum, string and texture";

    fn of_name(name: &str) -> Option<Self> {
        Some(match name {
            "bool" => Self::Bool,
            "integer" => Self::Integer,
            "float" => Self::Float,
            "point2" | "vector2" => Self::Pair,
            "point3" | "vector3" | "normal3" | "point" | "vector" | "normal" => Self::Triple,
            "rgb" => Self::Rgb,
            "blackbody" => Self::Blackbody,
            "spectrum" => Self::Spectrum,
            "string" => Self::String,
            "texture" => Self::Texture,
            _ => return None,
        })
    }

    /// How many numbers belong together.
    const fn width(self) -> usize {
        match self {
            Self::Pair | Self::Spectrum => 2,
            Self::Triple | Self::Rgb => 3,
            _ => 1,
        }
    }

    /// A value.
    const fn value(self) -> &'static str {
        match self {
            Self::Bool => "`true` or `false`",
            Self::Integer => "a whole number below 2^31",
            Self::String | Self::Texture => "a name in quotes",
            Self::Spectrum => "a number or a name in quotes",
            _ => "a number",
        }
    }
}

impl Parameter {
    /// The parameter that `declaration` starts, whose values follow.
    pub(super) fn read(tokens: &mut Tokens<'_>, declaration: &str) -> Result<Self, Diagnostic> {
        let mut words = declaration.split_whitespace();
        let (Some(kind), Some(name), None) = (words.next(), words.next(), words.next()) else {
            let declaration = shown(declaration);
            let message = format!("expected \"TYPE NAME\", found \"{declaration}\"");
            return Err(tokens.diagnostic(message));
        };
        let kind = ParameterType::of_name(kind).ok_or_else(|| {
            let is_old = matches!(kind, "color" | "xyz");
            let (kind, name) = (shown(kind), shown(name));
            let message = format!("expected a type for `{name}`, found `{kind}`");
            tokens.diagnostic(if is_old {
                format!("{message}; {UPGRADE}")
            } else {
                format!("{message}; types are {}", ParameterType::NAMES)
            })
        })?;
        let mut parameter = Self {
            kind,
            name: name.to_owned(),
            line: tokens.line(),
            numbers: Vec::new(),
            words: Vec::new(),
            used: Cell::new(false),
        };
        let value = tokens.next()?;
        if value == Some(Token::Open) {
            loop {
                let value = tokens.next()?;
                if value == Some(Token::Close) {
                    break;
                }
                parameter.push(tokens, value)?;
            }
        } else {
            parameter.push(tokens, value)?;
        }
        parameter.check(tokens.path())?;
        Ok(parameter)
    }

    fn push(&mut self, tokens: &Tokens<'_>, value: Option<Token<'_>>) -> Result<(), Diagnostic> {
        use ParameterType::{Bool, Integer, Spectrum, String, Texture};
        let is_word = matches!(self.kind, String | Texture | Spectrum);
        let is_number = !matches!(self.kind, String | Texture | Bool);
        match &value {
            Some(Token::Word(word @ ("true" | "false"))) if self.kind == Bool => {
                self.words.push((*word).to_owned());
            }
            // As older files write it.
            Some(Token::Quoted(word))
                if self.kind == Bool && matches!(&**word, "true" | "false") =>
            {
                self.words.push(word.to_string());
            }
            Some(Token::Quoted(text)) if is_word => self.words.push(text.to_string()),
            // A normal that is no number is dropped with the mesh in hand.
            Some(Token::Word(word)) if self.is_normal() && is_broken_number(word) => {
                self.numbers.push(f64::NAN);
            }
            Some(Token::Word(word)) if is_number && number_of(word).is_some() => {
                let number: f64 = word.parse().unwrap_or_default();
                let fits = number.fract() == 0.0 && number.abs() < f64::from(1u32 << 31);
                if self.kind == Integer && !fits {
                    return Err(self.expected(tokens, value.as_ref()));
                }
                self.numbers.push(number);
            }
            other => return Err(self.expected(tokens, other.as_ref())),
        }
        Ok(())
    }

    /// Whether these are normals of a mesh.
    fn is_normal(&self) -> bool {
        self.kind == ParameterType::Triple && self.name == "N"
    }

    fn expected(&self, tokens: &Tokens<'_>, found: Option<&Token<'_>>) -> Diagnostic {
        let what = format!(
            "{} as a value of `{}`",
            self.kind.value(),
            shown(&self.name)
        );
        tokens.expected(&what, found)
    }

    /// Whether there are as many values as belong together.
    fn check(&self, path: &Path) -> Result<(), Diagnostic> {
        let (count, width) = (self.numbers.len(), self.kind.width());
        let refuse =
            |message: String| Err(Diagnostic::at(path, Location::Line(self.line), message));
        let name = shown(&self.name);
        if !self.words.is_empty() && !self.numbers.is_empty() {
            return refuse(format!(
                "expected numbers or a name for `{name}`, found both"
            ));
        }
        if count % width != 0 {
            return refuse(format!(
                "expected a multiple of {width} numbers for `{name}`, found {count}"
            ));
        }
        Ok(())
    }

    /// The three numbers of a colour.
    pub(super) fn rgb(&self) -> Result<Vec3, String> {
        let rgb = Vec3::from(self.exactly::<3>()?);
        if rgb.min_element() < 0.0 {
            return Err(format!(
                "expected a colour of at least 0 for `{}`",
                self.shown()
            ));
        }
        Ok(rgb)
    }

    /// All numbers, if they are `N`.
    pub(super) fn exactly<const N: usize>(&self) -> Result<[f32; N], String> {
        let numbers = self.singles();
        let found = numbers.len();
        let plural = if N == 1 { "" } else { "s" };
        numbers.try_into().map_err(|_| {
            format!(
                "expected {N} number{plural} for `{}`, found {found}",
                self.shown()
            )
        })
    }

    /// The only word.
    pub(super) fn word(&self) -> Result<&str, String> {
        match &self.words[..] {
            [word] => Ok(word),
            words => {
                let found = words.len();
                Err(format!(
                    "expected 1 name for `{}`, found {found}",
                    self.shown()
                ))
            }
        }
    }

    pub(super) fn shown(&self) -> String {
        shown(&self.name)
    }

    pub(super) fn singles(&self) -> Vec<f32> {
        self.numbers.iter().map(|&n| single(n)).collect()
    }
}

impl fmt::Display for ParameterType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Bool => "bool",
            Self::Integer => "integer",
            Self::Float => "float",
            Self::Pair => "point2",
            Self::Triple => "point3",
            Self::Rgb => "rgb",
            Self::Blackbody => "blackbody",
            Self::Spectrum => "spectrum",
            Self::String => "string",
            Self::Texture => "texture",
        })
    }
}

/// Whether a word is what programs print for numbers that are none.
fn is_broken_number(word: &str) -> bool {
    let word = word.trim_start_matches(['-', '+']).to_ascii_lowercase();
    word.starts_with("nan") || word.starts_with("inf")
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "checked to be finite as f32, or NaN"
)]
pub(super) const fn single(number: f64) -> f32 {
    number as f32
}

/// What is said of a parameter that is of none of `kinds`.
pub(super) fn wrong_type(found: &Parameter, kinds: &[ParameterType]) -> String {
    let name = shown(&found.name);
    let kinds: Vec<String> = kinds
        .iter()
        .map(|kind| format!("\"{kind} {name}\""))
        .collect();
    format!(
        "expected {}, found \"{} {name}\"",
        kinds.join(" or "),
        found.kind
    )
}
