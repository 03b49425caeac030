//! Lines as `tobj` reads them.

use alloc::borrow::Cow;
use std::io::{self, BufRead, Read};
use std::path::Path;

use crate::Diagnostic;
use crate::text::{Line, LogicalLines, logical_lines};

/// What looks at each line before `tobj` does.
pub(super) trait Cleaner {
    /// Looks at a line of a file, and hands over what `tobj` shall read of it: nothing, it, or
    /// other lines.
    ///
    /// # Errors
    /// When the line is broken.
    fn clean<'a>(
        &mut self,
        line: Line<'_>,
        text: Cow<'a, str>,
        handed: &mut Handed<'a>,
    ) -> Result<(), Diagnostic>;
}

/// At most two lines for `tobj`, the second one first.
#[derive(Debug, Default)]
pub(super) struct Handed<'a> {
    lines: [Option<Cow<'a, str>>; 2],
}

impl<'a> Handed<'a> {
    /// A line.
    pub(super) fn line(&mut self, line: impl Into<Cow<'a, str>>) {
        self.lines[0] = Some(line.into());
    }

    /// A line before it.
    pub(super) fn before(&mut self, line: String) {
        self.lines[1] = Some(line.into());
    }
}

/// A text without comments, continued lines joined: one line at a time, so that whoever reads it
/// knows the line of an error.
#[derive(Debug)]
pub(super) struct Cleaned<'a, C> {
    path: &'a Path,
    lines: LogicalLines<'a>,
    pub(super) cleaner: C,
    handed: Handed<'a>,
    /// How much of the line in front has been read.
    read: usize,
    /// The number of the line that was looked at last.
    number: usize,
    fault: Option<Diagnostic>,
}

impl<'a, C: Cleaner> Cleaned<'a, C> {
    pub(super) fn new(path: &'a Path, text: &'a str, cleaner: C) -> Self {
        Self {
            path,
            lines: logical_lines(text),
            cleaner,
            handed: Handed::default(),
            read: 0,
            number: 0,
            fault: None,
        }
    }

    /// The error of the cleaner, if it found one.
    pub(super) fn fault(&mut self) -> Option<Diagnostic> {
        self.fault.take()
    }

    /// What `tobj` says of the line that it read last.
    pub(super) fn at_last_line(&self, error: tobj::LoadError) -> Diagnostic {
        Line::new(self.path, self.number, "").diagnostic(error.to_string())
    }

    /// The line in front, without its end.
    fn front(&mut self) -> Option<&mut Option<Cow<'a, str>>> {
        let lines = &mut self.handed.lines;
        lines.iter_mut().rev().find(|line| line.is_some())
    }
}

impl<C: Cleaner> BufRead for Cleaned<'_, C> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        while self.handed.lines.iter().all(Option::is_none) {
            let Some((number, text)) = self.lines.next() else {
                return Ok(&[]);
            };
            self.number = number;
            let Self {
                path,
                cleaner,
                handed,
                ..
            } = self;
            // A cleaner that keeps the line takes its text along.
            let line = text.clone();
            let looked = cleaner.clean(Line::new(path, number, &line), text, handed);
            if let Err(fault) = looked {
                self.fault = Some(fault);
                return Err(io::Error::other("a broken line"));
            }
        }
        let lines = self.handed.lines.iter().rev();
        let front = lines.flatten().next().map_or("", |line| line);
        Ok(if self.read < front.len() {
            &front.as_bytes()[self.read..]
        } else {
            b"\n"
        })
    }

    fn consume(&mut self, bytes: usize) {
        self.read += bytes;
        let read = self.read;
        if let Some(front) = self.front() {
            if front.as_ref().is_some_and(|line| read > line.len()) {
                *front = None;
                self.read = 0;
            }
        }
    }
}

impl<C: Cleaner> Read for Cleaned<'_, C> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let ready = self.fill_buf()?;
        let bytes = ready.len().min(into.len());
        into[..bytes].copy_from_slice(&ready[..bytes]);
        self.consume(bytes);
        Ok(bytes)
    }
}
