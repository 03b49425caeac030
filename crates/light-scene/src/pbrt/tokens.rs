use alloc::borrow::Cow;
use std::path::Path;

use crate::text::shown;
use crate::{Diagnostic, Location};

/// The words of a pbrt file, one after the other, each with its line.
#[derive(Clone, Debug)]
pub(super) struct Tokens<'a> {
    path: &'a Path,
    rest: &'a str,
    line: usize,
}

/// One word of a pbrt file.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token<'a> {
    /// A directive, a number, `true` or `false`.
    Word(&'a str),
    /// A quoted string.
    Quoted(Cow<'a, str>),
    /// `[`
    Open,
    /// `]`
    Close,
}

impl<'a> Tokens<'a> {
    pub(super) const fn new(path: &'a Path, text: &'a str) -> Self {
        let (rest, line) = (text, 1);
        Self { path, rest, line }
    }

    pub(super) const fn path(&self) -> &'a Path {
        self.path
    }

    /// The line of the token that came last.
    pub(super) const fn line(&self) -> usize {
        self.line
    }

    /// A message about the line of the token that came last.
    pub(super) fn diagnostic(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic::at(self.path, Location::Line(self.line), message)
    }

    /// The next token without taking it.
    pub(super) fn peek(&self) -> Result<Option<Token<'a>>, Diagnostic> {
        self.clone().next()
    }

    /// The next token; `None` at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<Token<'a>>, Diagnostic> {
        self.skip_blanks();
        let Some(first) = self.rest.chars().next() else {
            return Ok(None);
        };
        match first {
            '[' => {
                self.take(1);
                Ok(Some(Token::Open))
            }
            ']' => {
                self.take(1);
                Ok(Some(Token::Close))
            }
            '"' => {
                let end = end_of_quote(&self.rest[1..]);
                let end = end.ok_or_else(|| self.diagnostic("expected a closing quote"))?;
                let inner = &self.take(end + 2)[1..=end];
                Ok(Some(Token::Quoted(unescaped(inner))))
            }
            _ => {
                let stops = |c: char| c.is_whitespace() || "[]\"#".contains(c);
                let end = self.rest.find(stops).unwrap_or(self.rest.len());
                Ok(Some(Token::Word(self.take(end))))
            }
        }
    }

    /// The next token as a quoted word; `what` says what for.
    pub(super) fn quoted(&mut self, what: &str) -> Result<Cow<'a, str>, Diagnostic> {
        match self.next()? {
            Some(Token::Quoted(text)) => Ok(text),
            other => Err(self.expected(&format!("{what} in quotes"), other.as_ref())),
        }
    }

    /// As many numbers as the array has, with or without brackets around them.
    pub(super) fn numbers<const N: usize>(&mut self, what: &str) -> Result<[f32; N], Diagnostic> {
        let bracketed = self.peek()? == Some(Token::Open);
        if bracketed {
            self.next()?;
        }
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            let token = self.next()?;
            let parsed = match &token {
                Some(Token::Word(word)) => number_of(word),
                _ => None,
            };
            *number = parsed.ok_or_else(|| self.expected(what, token.as_ref()))?;
        }
        if bracketed {
            let token = self.next()?;
            if token != Some(Token::Close) {
                return Err(self.expected("]", token.as_ref()));
            }
        }
        Ok(numbers)
    }

    /// The error that something else was expected.
    pub(super) fn expected(&self, what: &str, found: Option<&Token<'_>>) -> Diagnostic {
        let found = match found {
            None => "the end of the file".to_owned(),
            Some(Token::Word(word)) => format!("`{}`", shown(word)),
            Some(Token::Quoted(text)) => format!("\"{}\"", shown(text)),
            Some(Token::Open) => "`[`".to_owned(),
            Some(Token::Close) => "`]`".to_owned(),
        };
        self.diagnostic(format!("expected {what}, found {found}"))
    }

    fn skip_blanks(&mut self) {
        loop {
            let blanks = self.rest.len() - self.rest.trim_start().len();
            self.take(blanks);
            if !self.rest.starts_with('#') {
                return;
            }
            let end = self.rest.find('\n').unwrap_or(self.rest.len());
            self.take(end);
        }
    }

    fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(bytes);
        self.line += taken.matches('\n').count();
        self.rest = rest;
        taken
    }
}

/// The byte of the quote that closes a string on its line; one behind a backslash does not.
fn end_of_quote(text: &str) -> Option<usize> {
    let mut is_escaped = false;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'\n' => return None,
            _ if is_escaped => is_escaped = false,
            b'\\' => is_escaped = true,
            b'"' => return Some(at),
            _ => {}
        }
    }
    None
}

/// A string without its backslashes. One before a letter without such a meaning stays, as in names
/// of files from Windows.
fn unescaped(text: &str) -> Cow<'_, str> {
    if !text.contains('\\') {
        return Cow::Borrowed(text);
    }
    let mut plain = String::with_capacity(text.len());
    let mut characters = text.chars();
    while let Some(character) = characters.next() {
        if character != '\\' {
            plain.push(character);
            continue;
        }
        match characters.next() {
            Some('b') => plain.push('\u{8}'),
            Some('f') => plain.push('\u{c}'),
            Some('n') => plain.push('\n'),
            Some('r') => plain.push('\r'),
            Some('t') => plain.push('\t'),
            Some(same @ ('\\' | '\'' | '"')) => plain.push(same),
            other => {
                plain.push('\\');
                plain.extend(other);
            }
        }
    }
    Cow::Owned(plain)
}

/// A finite number.
pub(super) fn number_of(word: &str) -> Option<f32> {
    word.parse::<f32>().ok().filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_quotes_brackets_and_comments() {
        let mut tokens = Tokens::new(Path::new("a"), "Shape \"a b\" # x\n[1]-2\n");
        let mut all = Vec::new();
        while let Some(token) = tokens.next().expect("a token") {
            all.push((tokens.line(), token));
        }
        let expected = [
            (1, Token::Word("Shape")),
            (1, Token::Quoted("a b".into())),
            (2, Token::Open),
            (2, Token::Word("1")),
            (2, Token::Close),
            (2, Token::Word("-2")),
        ];
        assert_eq!(all, expected, "tokens and lines");
    }

    /// As pbrt-v4 reads them.
    #[test]
    fn backslashes_escape() {
        fn of(text: &str) -> Result<Option<Token<'_>>, Diagnostic> {
            Tokens::new(Path::new("a"), text).next()
        }
        for (text, expected) in [
            (r#""a \"b\" c""#, "a \"b\" c"),
            (r#""dir\\sky.exr""#, r"dir\sky.exr"),
            (r#""a\tb""#, "a\tb"),
            (r#""dir\sky.exr""#, r"dir\sky.exr"),
            (r#""\\""#, r"\"),
        ] {
            let token = of(text).expect(text).expect("a token");
            assert_eq!(token, Token::Quoted(expected.into()), "{text}");
        }
        for open in [r#""a\""#, "\"a\\\n\""] {
            let error = of(open).expect_err(open).to_string();
            assert_eq!(error, "a:1: expected a closing quote", "{open}");
        }
    }

    #[test]
    fn an_open_quote_is_named() {
        let mut tokens = Tokens::new(Path::new("a"), "\n\"abc\n\"");
        let error = tokens.next().expect_err("an error").to_string();
        assert_eq!(error, "a:2: expected a closing quote", "line 2");
    }
}
