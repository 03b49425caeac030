//! Parsing of line-based formats: lines, words, numbers, and errors with their location.

use alloc::borrow::Cow;
use core::iter::Enumerate;
use core::str::Lines;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use crate::glam::Vec3;
use crate::read_files::record;
use crate::{Diagnostic, Location};

/// The text of a file.
pub(crate) fn read_text(path: &Path) -> Result<String, Diagnostic> {
    let mut bytes = read_bytes(path)?;
    bytes.drain(..bytes.len() - without_mark(&bytes).len());
    let text = String::from_utf8(bytes);
    Ok(text.unwrap_or_else(|error| text_of(error.as_bytes()).into_owned()))
}

/// Bytes as text without its byte order mark; what is not UTF-8 is taken as Latin-1, as older
/// programs write it, in which two names stay two.
pub(crate) fn text_of(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = without_mark(bytes);
    // Most files are valid, which is checked much faster than what is not is found.
    let latin = |_| bytes.iter().copied().map(char::from).collect();
    core::str::from_utf8(bytes).map_or_else(|error| Cow::Owned(latin(error)), Cow::Borrowed)
}

/// The bytes of a text without the byte order mark that some programs write before it.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// The bytes of a file.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, Diagnostic> {
    read_all(path).map_err(|error| Diagnostic::file(path, format!("cannot be read: {error}")))
}

/// The bytes of a file; those of a pipe or a device, which may have no end, if there are not too
/// many.
pub(crate) fn read_all(path: &Path) -> io::Result<Vec<u8>> {
    const MOST: u64 = 1 << 28;
    record(path);
    let file = File::open(path)?;
    if file.metadata()?.is_file() {
        return fs::read(path);
    }
    let mut bytes = vec![];
    if file.take(MOST + 1).read_to_end(&mut bytes)? as u64 > MOST {
        return Err(io::Error::other("expected an end after at most 256 MiB"));
    }
    Ok(bytes)
}

/// The lines of `text` with the number of each (the first is 1), without comments that `#` starts.
///
/// A line that ends with a backslash goes on in the next one.
pub(crate) fn logical_lines(text: &str) -> LogicalLines<'_> {
    LogicalLines {
        lines: text.lines().enumerate(),
    }
}

/// The iterator that [`logical_lines`] makes.
#[derive(Clone, Debug)]
pub(crate) struct LogicalLines<'a> {
    lines: Enumerate<Lines<'a>>,
}

impl<'a> Iterator for LogicalLines<'a> {
    type Item = (usize, Cow<'a, str>);

    fn next(&mut self) -> Option<Self::Item> {
        let (index, first) = self.lines.next()?;
        let mut whole = Cow::Borrowed(without_comment(first));
        while let Some(begun) = whole.strip_suffix('\\') {
            let next = self.lines.next();
            let next = next.map_or("", |(_, line)| without_comment(line));
            // Into the same text, which many lines may make long.
            let length = begun.len();
            let mut joined = whole.into_owned();
            joined.truncate(length);
            joined.push(' ');
            joined.push_str(next);
            whole = Cow::Owned(joined);
        }
        Some((index + 1, whole))
    }
}

/// A `#` starts a comment at the start of a word only: file names may hold one.
fn without_comment(line: &str) -> &str {
    if !line.as_bytes().contains(&b'#') {
        return line.trim_end();
    }
    let starts_comment = |&(at, _): &(usize, &str)| {
        let before = line[..at].chars().next_back();
        before.is_none_or(char::is_whitespace)
    };
    let comment = line.match_indices('#').find(starts_comment);
    line[..comment.map_or(line.len(), |(at, _)| at)].trim_end()
}

/// One line, read word by word.
#[derive(Clone, Debug)]
pub(crate) struct Line<'a> {
    path: &'a Path,
    number: usize,
    /// What has not been read yet.
    rest: &'a str,
}

impl<'a> Line<'a> {
    pub(crate) fn new(path: &'a Path, number: usize, text: &'a str) -> Self {
        Self {
            path,
            number,
            rest: text,
        }
    }

    /// The file that the line is in.
    pub(crate) const fn path(&self) -> &'a Path {
        self.path
    }

    /// Its number; the first is 1.
    pub(crate) const fn number_in_file(&self) -> usize {
        self.number
    }

    /// A message about this line.
    pub(crate) fn diagnostic(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic::at(self.path, Location::Line(self.number), message)
    }

    /// The next word, if there is one.
    pub(crate) fn word(&mut self) -> Option<&'a str> {
        let mut text = self.rest.trim_ascii_start();
        if text
            .bytes()
            .next()
            .is_some_and(|byte| byte == 0x0b || !byte.is_ascii())
        {
            text = text.trim_start();
        }
        // The end of most words is found by their bytes.
        let is_end = |byte: u8| matches!(byte, b' ' | b'\t'..=b'\r') || !byte.is_ascii();
        let end = match text.bytes().position(is_end) {
            Some(at) if !text.as_bytes()[at].is_ascii() => text.find(char::is_whitespace),
            end => end,
        };
        let (word, rest) = text.split_at(end.unwrap_or(text.len()));
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }

    /// The words that are left, separated by single blanks: a name or path that may hold blanks.
    pub(crate) fn rest(&mut self, what: &str) -> Result<String, Diagnostic> {
        let words: Vec<&str> = core::iter::from_fn(|| self.word()).collect();
        if words.is_empty() {
            return Err(self.diagnostic(format!("expected {what}")));
        }
        Ok(words.join(" "))
    }

    /// The next word as a finite number; `what` says what it is for.
    pub(crate) fn number(&mut self, what: &str) -> Result<f32, Diagnostic> {
        let Some(word) = self.word() else {
            return Err(self.diagnostic(format!("expected {what}, found the end of the line")));
        };
        self.parse_number(word, what)
    }

    /// The next word, if there is one, as a finite number.
    pub(crate) fn optional_number(&mut self, what: &str) -> Result<Option<f32>, Diagnostic> {
        let word = self.word();
        word.map(|word| self.parse_number(word, what)).transpose()
    }

    /// The next three words as finite numbers.
    pub(crate) fn vec3(&mut self, what: &str) -> Result<Vec3, Diagnostic> {
        let (x, y) = (self.number(what)?, self.number(what)?);
        Ok(Vec3::new(x, y, self.number(what)?))
    }

    fn parse_number(&self, word: &str, what: &str) -> Result<f32, Diagnostic> {
        let parsed = word.parse::<f32>().ok().filter(|number| number.is_finite());
        parsed.ok_or_else(|| self.diagnostic(format!("expected {what}, found `{}`", shown(word))))
    }
}

/// A word as an error message shows it: not longer than a line has room for.
pub(crate) fn shown(word: &str) -> String {
    const LONGEST: usize = 40;
    let printable = |c: char| if c.is_control() { '?' } else { c };
    let mut short: String = word.chars().take(LONGEST).map(printable).collect();
    if word.chars().nth(LONGEST).is_some() {
        short.push_str("...");
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_continued_lines() {
        let text = "v 1 # x\n# all\nf 1 \\\n 2 \\\n3\nmtllib a#b.mtl\nend\\";
        let lines: Vec<_> = logical_lines(text).collect();
        let expected = [
            (1, "v 1"),
            (2, ""),
            (3, "f 1   2  3"),
            (6, "mtllib a#b.mtl"),
            (7, "end "),
        ];
        assert_eq!(lines.len(), expected.len(), "{lines:?}");
        for (line, (number, text)) in lines.iter().zip(expected) {
            assert_eq!(line.0, number, "the first line's number");
            assert_eq!(line.1, text, "the text");
        }
    }

    #[test]
    fn a_byte_order_mark_is_no_part_of_a_text() {
        assert_eq!(text_of(b"\xef\xbb\xbfv 1"), "v 1");
        assert_eq!(text_of(b"\xef\xbb\xbfW\xe4nde"), "W\u{e4}nde", "not UTF-8");
        assert_eq!(text_of("v\u{feff}".as_bytes()), "v\u{feff}", "elsewhere");
        let folder = crate::test_folder::TestFolder::new("byte_order_mark");
        let path = folder.path("a.ies");
        fs::write(&path, "\u{feff}IESNA").expect("written");
        assert_eq!(read_text(&path).as_deref(), Ok("IESNA"));
    }

    #[test]
    fn words_are_those_between_blanks_of_any_alphabet() {
        let texts = [
            "",
            " \t ",
            "f 1/2/3  4//5\t6 ",
            "usemtl na\u{ef}f \u{3000}w\u{e4}nde\u{a0}x",
            "\u{2003}a\u{b}b\u{c}c\u{85}d",
        ];
        for text in texts {
            let mut line = Line::new(Path::new("a"), 1, text);
            let words: Vec<&str> = core::iter::from_fn(|| line.word()).collect();
            let expected: Vec<&str> = text.split_whitespace().collect();
            assert_eq!(words, expected, "{text:?}");
        }
    }

    #[test]
    fn numbers_are_finite_or_named() {
        let path = Path::new("a");
        let mut line = Line::new(path, 3, "1e0 -.5 nan x");
        let two = [(); 2].map(|()| line.number("a number"));
        assert_eq!(two, [Ok(1.0), Ok(-0.5)], "two");
        let message = |error: Diagnostic| error.to_string();
        assert_eq!(
            line.number("a width").map_err(message),
            Err("a:3: expected a width, found `nan`".into()),
            "NaN"
        );
        assert_eq!(
            line.number("a width").map_err(message),
            Err("a:3: expected a width, found `x`".into()),
            "no number"
        );
        assert_eq!(
            line.number("a width").map_err(message),
            Err("a:3: expected a width, found the end of the line".into()),
            "nothing"
        );
        assert_eq!(line.optional_number("a width"), Ok(None), "nothing");
        assert_eq!(shown(&"x".repeat(50)).len(), 43, "cut");
    }
}
