use core::fmt;
use core::time::Duration;

use serde_json::Value;

use super::child::Ended;

/// What became of a scene file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// There is a picture.
    Rendered,
    /// One line says why not.
    Refused,
    /// It panicked, was stopped, or said something else.
    Broken,
}

/// A line of the table.
#[derive(Debug)]
pub(super) struct SceneOutcome {
    name: String,
    pub(super) verdict: Verdict,
    /// Why there is no picture.
    reason: String,
    /// The kind of the reason, if it is a refusal.
    pub(super) refusals: Vec<String>,
    /// The kinds of warnings, each once.
    pub(super) warnings: Vec<String>,
    /// Whether the picture shows nothing.
    pub(super) is_black: bool,
    time: Duration,
    bytes: Option<u64>,
}

impl SceneOutcome {
    pub(super) const HEADER: &'static str =
        "result    black  warnings  seconds      MB  file: why it is refused";

    pub(super) fn of(name: &str, ended: &Ended) -> Self {
        let lines: Vec<&str> = ended.error.lines().collect();
        let said = |line: &&str| line.strip_prefix("lights: ").map(str::to_owned);
        let warning = |line: &&str| Some(kind(line.strip_prefix("lights: warning: ")?));
        let mut warnings: Vec<String> = lines.iter().filter_map(warning).collect();
        warnings.sort();
        warnings.dedup();
        let errors: Vec<&&str> = lines
            .iter()
            .filter(|line| !line.starts_with("lights: warning: "))
            .collect();
        let report: Option<Value> = serde_json::from_str(ended.output.trim()).ok();
        let is_refused = ended.status == Some(2) && errors.len() == 1;
        let (verdict, reason) = match (ended.status, &report) {
            _ if ended.is_late => (Verdict::Broken, "takes too long".into()),
            (Some(0), Some(_)) => (Verdict::Rendered, String::new()),
            _ if is_refused => (Verdict::Refused, said(errors[0]).unwrap_or_default()),
            (None, _) => (Verdict::Broken, "ended by a signal".into()),
            (Some(status), _) => {
                let last = lines.last().unwrap_or(&"");
                (Verdict::Broken, format!("status {status}: {last}"))
            }
        };
        let mean = report.as_ref().and_then(|report| report["mean"].as_array());
        let is_black =
            mean.is_some_and(|mean| mean.iter().all(|channel| channel.as_f64() == Some(0.0)));
        Self {
            name: name.into(),
            refusals: (verdict == Verdict::Refused)
                .then(|| kind(&reason))
                .into_iter()
                .collect(),
            verdict,
            reason,
            warnings,
            is_black,
            time: ended.time,
            bytes: ended.bytes,
        }
    }
}

impl fmt::Display for SceneOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = match self.verdict {
            Verdict::Rendered => "rendered",
            Verdict::Refused => "refused",
            Verdict::Broken => "BROKEN",
        };
        let black = if self.is_black { "black" } else { "" };
        let megabytes = self
            .bytes
            .map_or_else(String::new, |bytes| format!("{:.1}", bytes as f64 * 1e-6));
        write!(
            f,
            "{verdict:<9} {black:<5}  {:>8} {:>8.2} {megabytes:>7}  {}",
            self.warnings.len(),
            self.time.as_secs_f64(),
            self.name
        )?;
        if self.reason.is_empty() {
            Ok(())
        } else {
            write!(f, ": {}", self.reason)
        }
    }
}

/// The kind of a message: without the place that it begins with, with numbers and quoted names left
/// out.
fn kind(message: &str) -> String {
    // `path: message`, `path:7: message` or `path: byte 9: message`.
    let mut rest = message;
    if let Some((place, after)) = message.split_once(": ")
        && (place.contains('.') || place.contains('/'))
    {
        rest = after;
    }
    if let Some((byte, after)) = rest.split_once(": ")
        && byte.starts_with("byte ")
    {
        rest = after;
    }
    let mut kind = String::new();
    let mut quote = None;
    for c in rest.chars() {
        match quote {
            Some(end) if c == end => {
                quote = None;
                kind.push(c);
            }
            Some(_) => {}
            None if matches!(c, '"' | '`') => {
                quote = Some(c);
                kind.push(c);
                kind.push_str("...");
            }
            None if c.is_ascii_digit() => {
                if !kind.ends_with('N') {
                    kind.push('N');
                }
            }
            None => kind.push(c),
        }
    }
    kind
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ended(status: Option<i32>, output: &str, error: &str) -> Ended {
        Ended {
            status,
            output: output.into(),
            error: error.into(),
            ..Ended::default()
        }
    }

    #[test]
    fn verdicts_follow_what_the_program_says() {
        let of = |status, output, error| SceneOutcome::of("a.obj", &ended(status, output, error));
        let black = of(
            Some(0),
            "{\"mean\":[0.0,0.0,0.0]}",
            "lights: warning: a.mtl:3: no \"x\"\n",
        );
        assert_eq!(
            (black.verdict, black.is_black),
            (Verdict::Rendered, true),
            "{black:?}"
        );
        assert_eq!(black.warnings, ["no \"...\""], "{black:?}");
        let lit = of(Some(0), "{\"mean\":[0.1,0.0,0.0]}", "");
        assert!(!lit.is_black, "{lit:?}");
        let refused = of(
            Some(2),
            "",
            "lights: a.obj:7: expected 3 numbers, found 2\n",
        );
        assert_eq!(refused.verdict, Verdict::Refused, "{refused:?}");
        assert_eq!(
            refused.refusals,
            ["expected N numbers, found N"],
            "{refused:?}"
        );
        assert!(
            refused
                .to_string()
                .ends_with("a.obj:7: expected 3 numbers, found 2"),
            "its line"
        );
        for broken in [
            of(Some(101), "", "thread panicked\n"),
            of(None, "", ""),
            of(Some(2), "", "lights: one\nlights: two\n"),
            of(Some(0), "no JSON", ""),
        ] {
            assert_eq!(broken.verdict, Verdict::Broken, "{broken:?}");
        }
        let late = Ended {
            is_late: true,
            ..ended(None, "", "")
        };
        assert_eq!(
            SceneOutcome::of("a", &late).verdict,
            Verdict::Broken,
            "a hang"
        );
    }

    #[test]
    fn kinds_leave_places_numbers_and_names_out() {
        assert_eq!(
            kind("a/b.pbrt: byte 12: expected `x`"),
            "expected `...`",
            "a byte"
        );
        assert_eq!(
            kind("no light: expected Ke"),
            "no light: expected Ke",
            "no place"
        );
        assert_eq!(kind("12 of 40 texels"), "N of N texels", "counts");
    }
}
