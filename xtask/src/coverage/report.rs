use std::collections::BTreeMap;
use std::fmt;
use std::fs;

use serde_json::{Deserializer, Value};

use super::explained::reason;
use crate::mutants::CRATES;

/// What the tests reach of each file.
#[derive(Debug)]
pub(super) struct Report {
    /// By the path from the folder of the crates.
    files: BTreeMap<String, FileCoverage>,
}

/// Lines and regions of one file, without its tests.
#[derive(Debug, Default)]
struct FileCoverage {
    lines: Share,
    regions: Share,
    /// What no test reaches, with the reason where there is one.
    missed: Vec<(usize, Option<&'static str>)>,
}

/// How many of how many.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Share {
    reached: usize,
    all: usize,
}

/// A place from which on the code ran so many times.
#[derive(Clone, Copy, Debug)]
struct Segment {
    line: usize,
    column: usize,
    count: u64,
    has_count: bool,
    /// Whether a region of the code starts here, not only ends.
    starts: bool,
}

impl Report {
    /// From what `llvm-cov export` writes of each program, the files of the chosen crates: what one
    /// program reaches is reached.
    ///
    /// # Errors
    /// What is not as expected, or a file that cannot be read.
    pub(super) fn from_exports(
        exports: &[String],
        is_chosen: impl Fn(&str) -> bool,
    ) -> Result<Self, String> {
        let mut programs: BTreeMap<String, Vec<Vec<Segment>>> = BTreeMap::new();
        for text in exports {
            let mut values = Deserializer::from_str(text).into_iter::<Value>();
            let json = values.next().ok_or("an empty report")?;
            let json = json.map_err(|e| e.to_string())?;
            let files = json["data"][0]["files"].as_array();
            for file in files.ok_or("the report has no files")? {
                let path = file["filename"].as_str().ok_or("a file without a name")?;
                let segments = file["segments"].as_array().ok_or("no segments")?;
                let segments: Option<Vec<_>> = segments.iter().map(Segment::from_json).collect();
                let of_file = programs.entry(path.to_owned()).or_default();
                of_file.push(segments.ok_or("a bad segment")?);
            }
        }
        let mut files = BTreeMap::new();
        for (path, programs) in programs {
            let name = path.split_once("/crates/").map_or(&*path, |(_, name)| name);
            if is_chosen(crate_of(name)) {
                let source = fs::read_to_string(&path).map_err(|e| format!("{path}: {e}"))?;
                let coverage = FileCoverage::new(name, &source, &programs);
                files.insert(name.to_owned(), coverage);
            }
        }
        Ok(Self { files })
    }
}

impl Segment {
    /// From `[line, column, count, has_count, is_region_entry, is_gap_region]`.
    fn from_json(json: &Value) -> Option<Self> {
        let is = |i: usize| json[i].as_bool();
        let place = |i: usize| usize::try_from(json[i].as_u64()?).ok();
        Some(Self {
            line: place(0)?,
            column: place(1)?,
            count: json[2].as_u64()?,
            has_count: is(3)?,
            starts: is(3)? && is(4)? && !is(5)?,
        })
    }
}

impl FileCoverage {
    /// From the segments of each program that has the file.
    fn new(name: &str, source: &str, programs: &[Vec<Segment>]) -> Self {
        let lines: Vec<&str> = source.lines().collect();
        let tests = lines
            .iter()
            .position(|line| line.starts_with("mod tests {"));
        let mut coverage = Self::default();
        let mut regions = BTreeMap::new();
        for segment in programs.iter().flatten() {
            if segment.starts && tests.is_none_or(|tests| segment.line <= tests) {
                let place = (segment.line, segment.column);
                *regions.entry(place).or_insert(false) |= segment.count > 0;
            }
        }
        for is_reached in regions.into_values() {
            coverage.regions.add(is_reached);
        }
        for (index, text) in lines[..tests.unwrap_or(lines.len())].iter().enumerate() {
            let line = index + 1;
            let counts = programs.iter().filter_map(|segments| runs(segments, line));
            let Some(count) = counts.max() else {
                continue;
            };
            // A bracket alone says nothing more than what it closes.
            if text.chars().all(|c| " ()[]{},;".contains(c)) {
                continue;
            }
            coverage.lines.add(count > 0);
            if count == 0 {
                let reason = reason(name, text, function_of(&lines, index));
                coverage.missed.push((line, reason));
            }
        }
        coverage
    }
}

/// How often a line ran: the most of what starts in it, or what reaches into it. `None` for no
/// code.
fn runs(segments: &[Segment], line: usize) -> Option<u64> {
    let before = segments.iter().rev().find(|segment| segment.line < line);
    let reaches_in = before.filter(|segment| segment.has_count);
    let starts = segments.iter().filter(|s| s.line == line && s.starts);
    starts
        .map(|segment| segment.count)
        .max()
        .or(reaches_in.map(|segment| segment.count))
}

/// The crate of a file, by its path from the folder of the crates.
fn crate_of(path: &str) -> &str {
    path.split_once('/').map_or(path, |(name, _)| name)
}

/// The line that starts the function of a line.
fn function_of<'a>(lines: &[&'a str], index: usize) -> &'a str {
    let starts = |line: &&&str| {
        let words = line.trim_start();
        words.starts_with("fn ")
            || ["pub", "const ", "unsafe "]
                .iter()
                .any(|w| words.starts_with(w))
                && words.contains("fn ")
    };
    let found = lines[..=index].iter().rev().find(starts);
    found.copied().unwrap_or_default()
}

impl Share {
    fn add(&mut self, is_reached: bool) {
        self.all += 1;
        self.reached += usize::from(is_reached);
    }

    fn plus(self, other: Self) -> Self {
        Self {
            reached: self.reached + other.reached,
            all: self.all + other.all,
        }
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = 100.0 * self.reached as f64 / self.all.max(1) as f64;
        write!(f, "{} of {} ({percent:.1} %)", self.reached, self.all)
    }
}

impl fmt::Display for Report {
    /// A table of the crates, then what is not reached: first what has a reason.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "| crate | lines | regions | lines not reached, explained | not explained |"
        )?;
        writeln!(f, "| --- | --- | --- | ---: | ---: |")?;
        for name in CRATES {
            let files = self.files.iter();
            let files = || files.clone().filter(|(path, _)| crate_of(path) == name);
            if files().next().is_none() {
                continue;
            }
            let sum = |of: fn(&FileCoverage) -> Share| {
                let shares = files().map(|(_, file)| of(file));
                shares.fold(Share::default(), Share::plus)
            };
            let missed = |explained: bool| {
                let missed = files().flat_map(|(_, file)| &file.missed);
                missed
                    .filter(|(_, reason)| reason.is_some() == explained)
                    .count()
            };
            let (lines, regions) = (sum(|file| file.lines), sum(|file| file.regions));
            let (known, unknown) = (missed(true), missed(false));
            writeln!(f, "| {name} | {lines} | {regions} | {known} | {unknown} |")?;
        }
        for (path, file) in &self.files {
            let mut by_reason: BTreeMap<_, Vec<String>> = BTreeMap::new();
            for (line, reason) in &file.missed {
                let reason = reason.unwrap_or("NOT EXPLAINED");
                by_reason.entry(reason).or_default().push(line.to_string());
            }
            for (reason, lines) in by_reason {
                writeln!(f, "- {path}:{}: {reason}", lines.join(","))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::slice;

    use super::*;

    const SOURCE: &str = "fn one() {\n    two();\n    if three {\n        four();\n    }\n}\n";

    fn segment(line: usize, count: u64, starts: bool) -> Segment {
        Segment {
            line,
            column: 1,
            count,
            has_count: starts || count > 0,
            starts,
        }
    }

    #[test]
    fn a_line_counts_by_what_starts_in_it_or_reaches_into_it() {
        let segments = vec![
            segment(1, 3, true),
            segment(3, 0, true),
            segment(5, 3, true),
            segment(6, 0, false),
        ];
        let coverage = FileCoverage::new("one.rs", SOURCE, slice::from_ref(&segments));
        let lines = |reached, all| Share { reached, all };
        assert_eq!(coverage.lines, lines(2, 4), "of four lines with words");
        assert_eq!(coverage.regions, lines(2, 3), "regions");
        let missed: Vec<_> = coverage.missed.iter().map(|(line, _)| *line).collect();
        assert_eq!(missed, [3, 4], "the branch");
        let mut another = segments.clone();
        (another[0].count, another[1].count) = (0, 1);
        let coverage = FileCoverage::new("one.rs", SOURCE, &[segments, another]);
        assert_eq!(coverage.lines, lines(4, 4), "all, by two programs");
        assert_eq!(coverage.regions, lines(3, 3), "regions of two programs");
    }

    #[test]
    fn tests_do_not_count() {
        let source = "fn one() {\n}\n#[cfg(test)]\nmod tests {\n    fn two() {}\n}\n";
        let segments = vec![
            segment(1, 1, true),
            segment(2, 0, false),
            segment(5, 0, true),
        ];
        let coverage = FileCoverage::new("one.rs", source, &[segments]);
        assert_eq!(
            (coverage.lines.all, coverage.regions.all),
            (1, 1),
            "one line"
        );
    }
}
