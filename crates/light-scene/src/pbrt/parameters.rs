use alloc::rc::Rc;
use core::cell::RefCell;
use std::collections::HashSet;
use std::path::Path;

use super::parameter::{Parameter, ParameterType, wrong_type};
use super::spectrum;
use super::tokens::{Token, Tokens};
use crate::glam::{Vec2, Vec3};
use crate::text::text_of;
use crate::{Diagnostic, Files, Location};

/// The parameter list of a directive, which records which parameters were read and the first error.
///
/// A parameter of the wrong type, of a wrong number of values or outside of its domain is read as
/// if it were missing; [`check`](Self::check) then refuses the directive.
#[derive(Debug)]
pub(super) struct Parameters {
    path: Rc<Path>,
    list: Vec<Parameter>,
    /// Parameters of earlier `Attribute` directives, the last one first.
    inherited: Vec<Rc<Self>>,
    /// The first error.
    fault: RefCell<Option<Diagnostic>>,
}

impl Parameters {
    /// Takes all parameters that follow.
    pub(super) fn read(tokens: &mut Tokens<'_>) -> Result<Self, Diagnostic> {
        let mut list = Vec::new();
        let mut names = HashSet::new();
        while let Some(Token::Quoted(declaration)) = tokens.peek()? {
            tokens.next()?;
            let parameter = Parameter::read(tokens, &declaration)?;
            if !names.insert(parameter.name.clone()) {
                let message = format!("expected one `{}`, found another", parameter.shown());
                let location = Location::Line(parameter.line);
                return Err(Diagnostic::at(tokens.path(), location, message));
            }
            list.push(parameter);
        }
        Ok(Self {
            path: tokens.path().into(),
            list,
            inherited: Vec::new(),
            fault: RefCell::default(),
        })
    }

    /// Adds the parameters that the directive itself does not state.
    pub(super) fn inherit(&mut self, earlier: impl Iterator<Item = Rc<Self>>) {
        self.inherited.extend(earlier);
    }

    /// Reads the files that spectra are in, whose names start from `root`; a word without an ending
    /// is the name of a spectrum.
    pub(super) fn load_spectra(&mut self, root: &Path, files: Files<'_>) -> Result<(), Diagnostic> {
        let spectra = |p: &&mut Parameter| p.kind == ParameterType::Spectrum;
        for parameter in self.list.iter_mut().filter(spectra) {
            let Some(file) = parameter.words.first() else {
                continue;
            };
            let file = root.with_file_name(file);
            if file.extension().is_none() {
                continue;
            }
            let location = Location::Line(parameter.line);
            let refuse = |message: String| Diagnostic::at(&self.path, location, message);
            let bytes = files
                .read(&file)
                .map_err(|error| refuse(error.to_string()))?;
            let pairs = spectrum::pairs_of(&text_of(&bytes)).ok_or_else(|| {
                let file = file.display();
                refuse(format!(
                    "{file}: expected pairs of a wavelength and a value"
                ))
            })?;
            parameter.words.clear();
            parameter.numbers = pairs;
        }
        Ok(())
    }

    /// Refuses the list if a parameter that was asked for is invalid.
    pub(super) fn check(&self) -> Result<(), Diagnostic> {
        self.fault.borrow().clone().map_or(Ok(()), Err)
    }

    /// Names and lines of the parameters that were not read.
    pub(super) fn unused(&self) -> impl Iterator<Item = (&str, usize)> {
        let unused = self.list.iter().filter(|p| !p.used.get());
        unused.map(|p| (p.name.as_str(), p.line))
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.find(name).is_some()
    }

    pub(super) fn kind(&self, name: &str) -> Option<ParameterType> {
        self.find(name).map(|(parameter, _)| parameter.kind)
    }

    /// Marks a parameter as known, although it has no effect here.
    pub(super) fn accept(&self, name: &str) {
        if let Some((parameter, _)) = self.find(name) {
            parameter.used.set(true);
        }
    }

    /// Marks all parameters as known.
    pub(super) fn accept_all(&self) {
        self.list
            .iter()
            .for_each(|parameter| parameter.used.set(true));
    }

    pub(super) fn number(&self, name: &str) -> Option<f32> {
        self.number_where(name, |_| true, "")
    }

    pub(super) fn number_or(&self, name: &str, default: f32) -> f32 {
        self.number(name).unwrap_or(default)
    }

    /// A number above 0.
    pub(super) fn positive(&self, name: &str) -> Option<f32> {
        self.number_where(name, |n| n > 0.0, "above 0")
    }

    pub(super) fn positive_or(&self, name: &str, default: f32) -> f32 {
        self.positive(name).unwrap_or(default)
    }

    /// A number of at least 0.
    pub(super) fn amount_or(&self, name: &str, default: f32) -> f32 {
        let amount = self.number_where(name, |n| n >= 0.0, "of at least 0");
        amount.unwrap_or(default)
    }

    /// A number for which `fits` holds, as `domain` says in words.
    pub(super) fn number_where(
        &self,
        name: &str,
        fits: impl Fn(f32) -> bool,
        domain: &str,
    ) -> Option<f32> {
        self.value(name, &[ParameterType::Float], |p| {
            let [number] = p.exactly()?;
            let message = || format!("expected `{}` {domain}, found {number}", p.shown());
            fits(number).then_some(number).ok_or_else(message)
        })
    }

    /// `N` numbers.
    pub(super) fn numbers<const N: usize>(
        &self,
        name: &str,
        kind: ParameterType,
    ) -> Option<[f32; N]> {
        self.value(name, &[kind], Parameter::exactly)
    }

    /// A whole number from 1 to `most`.
    pub(super) fn count(&self, name: &str, most: u32) -> Option<u32> {
        self.value(name, &[ParameterType::Integer], |p| {
            let [_] = p.exactly()?;
            let number = whole(p.numbers[0]).filter(|n| (1..=most).contains(n));
            let found = p.numbers[0];
            number.ok_or_else(|| format!("expected `{name}` from 1 to {most}, found {found}"))
        })
    }

    /// A whole number from 0 to `most`.
    pub(super) fn whole(&self, name: &str, most: u32) -> Option<u32> {
        self.value(name, &[ParameterType::Integer], |p| {
            let [_] = p.exactly()?;
            let number = whole(p.numbers[0]).filter(|&n| n <= most);
            let found = p.numbers[0];
            number.ok_or_else(|| format!("expected `{name}` from 0 to {most}, found {found}"))
        })
    }

    pub(super) fn string(&self, name: &str) -> Option<&str> {
        self.value(name, &[ParameterType::String], Parameter::word)
    }

    /// All words.
    pub(super) fn strings(&self, name: &str) -> &[String] {
        let words = self.value(name, &[ParameterType::String], |p| Ok(&p.words[..]));
        words.unwrap_or_default()
    }

    /// The name of a spectrum, if one is named.
    pub(super) fn spectrum_name(&self, name: &str) -> Option<&str> {
        let (parameter, _) = self.find(name)?;
        if parameter.kind != ParameterType::Spectrum || parameter.words.is_empty() {
            return None;
        }
        self.value(name, &[ParameterType::Spectrum], Parameter::word)
    }

    /// Whether a parameter says `true` or, where it is not given, whether `default` does.
    pub(super) fn is_true(&self, name: &str, default: bool) -> bool {
        let truth = self.value(name, &[ParameterType::Bool], Parameter::word);
        truth.map_or(default, |word| word == "true")
    }

    /// The name of the texture that a parameter refers to; `None` if it is none.
    pub(super) fn texture(&self, name: &str) -> Option<&str> {
        let (parameter, _) = self.find(name)?;
        if parameter.kind != ParameterType::Texture {
            return None;
        }
        self.value(name, &[ParameterType::Texture], Parameter::word)
    }

    /// Whole numbers of at least 0.
    pub(super) fn indices(&self, name: &str) -> Option<Vec<u32>> {
        self.value(name, &[ParameterType::Integer], |p| {
            let index = |&n: &f64| {
                let message = || format!("expected `{}` of at least 0, found {n}", p.shown());
                whole(n).ok_or_else(message)
            };
            p.numbers.iter().map(index).collect()
        })
    }

    /// All numbers, however many.
    pub(super) fn list(&self, name: &str, kind: ParameterType) -> Option<Vec<f32>> {
        self.value(name, &[kind], |p| Ok(p.singles()))
    }

    /// Points of the plane.
    pub(super) fn vec2s(&self, name: &str) -> Option<Vec<Vec2>> {
        self.value(name, &[ParameterType::Pair], |p| {
            let numbers = p.singles();
            Ok(numbers.chunks_exact(2).map(Vec2::from_slice).collect())
        })
    }

    /// Points.
    pub(super) fn vec3s(&self, name: &str) -> Option<Vec<Vec3>> {
        self.value(name, &[ParameterType::Triple], |p| {
            let numbers = p.singles();
            Ok(numbers.chunks_exact(3).map(Vec3::from_slice).collect())
        })
    }

    pub(super) fn vec3_or(&self, name: &str, default: Vec3) -> Vec3 {
        let point = self.value(name, &[ParameterType::Triple], Parameter::exactly::<3>);
        point.map_or(default, Vec3::from)
    }

    /// What `value` makes of a parameter that is of one of these types.
    pub(super) fn value<'a, T>(
        &'a self,
        name: &str,
        kinds: &[ParameterType],
        value: impl FnOnce(&'a Parameter) -> Result<T, String>,
    ) -> Option<T> {
        let (found, path) = self.find(name)?;
        found.used.set(true);
        let made = if kinds.contains(&found.kind) {
            value(found)
        } else {
            Err(wrong_type(found, kinds))
        };
        let refuse = |message| self.keep(path, found.line, message);
        made.map_err(refuse).ok()
    }

    /// Refuses the directive for what a parameter says.
    pub(super) fn refuse(&self, name: &str, message: String) {
        if let Some((parameter, path)) = self.find(name) {
            self.keep(path, parameter.line, message);
        }
    }

    /// Refuses the directive, at this line of a file.
    pub(super) fn keep(&self, path: &Path, line: usize, message: String) {
        let mut fault = self.fault.borrow_mut();
        fault.get_or_insert_with(|| Diagnostic::at(path, Location::Line(line), message));
    }

    fn find(&self, name: &str) -> Option<(&Parameter, &Path)> {
        let own = self.list.iter().find(|p| p.name == name);
        own.map(|p| (p, &*self.path))
            .or_else(|| self.inherited.iter().find_map(|earlier| earlier.find(name)))
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be whole and in range"
)]
fn whole(n: f64) -> Option<u32> {
    (n >= 0.0 && n <= f64::from(u32::MAX) && n.fract() == 0.0).then_some(n as u32)
}
