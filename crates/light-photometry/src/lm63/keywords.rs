use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;

use super::tilt_line::TiltLine;
use crate::diagnostic::Diagnostic;

/// The words of numbered lines with their keywords, up to the line `TILT=`, and that line.
pub(super) fn read_keywords<'a>(
    lines: &mut impl Iterator<Item = (usize, &'a str)>,
) -> Result<(Vec<(String, String)>, TiltLine<'a>), Diagnostic> {
    let mut words = Words {
        keywords: Vec::new(),
    };
    let mut last_line = 1;
    for (number, line) in lines {
        last_line = number;
        match line.trim().strip_prefix("TILT=") {
            Some(tilt) => {
                let tilt = tilt.trim();
                return Ok((words.keywords, TiltLine { number, tilt }));
            }
            None => words.add(line.trim()),
        }
    }
    let message = "expected a line `TILT=...`, found the end of the file";
    Err(Diagnostic::at(last_line, message))
}

struct Words {
    keywords: Vec<(String, String)>,
}

impl Words {
    /// Adds a line: `[KEYWORD] words`, the same with `MORE` for what continues the line before, or
    /// words alone.
    fn add(&mut self, line: &str) {
        let bracketed = line.strip_prefix('[').and_then(|rest| rest.split_once(']'));
        let (keyword, words) = bracketed.unwrap_or(("", line));
        let words = words.trim();
        match (keyword, self.keywords.last_mut()) {
            ("MORE", Some((_, before))) => {
                before.push(' ');
                before.push_str(words);
            }
            ("", _) if words.is_empty() => {}
            _ => self.keywords.push((keyword.to_owned(), words.to_owned())),
        }
    }
}
