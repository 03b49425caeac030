//! `cargo xtask march-convergence`: measures how marches through media converge and draws it for
//! light-media's first page.

use core::fmt::Write as _;
use std::fs;

use crate::steps::{Outcome, StepResult, cargo, output, root};

/// Where the drawing goes, from the root.
const DRAWING: &str = "docs/images/march-convergence.svg";

/// A line of points, in the words of the example that measures them.
const SERIES: [(&str, &str, &str); 4] = [
    ("fog", "rms", "#c2571a"),
    ("fog", "bias", "#e8a87c"),
    ("cloud", "rms", "#1f5f99"),
    ("cloud", "bias", "#8ab6dc"),
];

/// Runs the example, draws its figures, and prints the slopes.
///
/// # Errors
/// The command that failed, a line that is not understood, or a drawing that cannot be written.
pub fn march_convergence() -> StepResult {
    let mut command = cargo(["run", "--quiet", "--release", "--package", "light-media"]);
    let lines = output(command.args(["--example", "march_convergence"]))?;
    let figures = Figures::parse(&lines)?;
    let path = root().join(DRAWING);
    fs::write(&path, figures.draw()).map_err(|error| format!("{}: {error}", path.display()))?;
    for line in lines
        .lines()
        .filter(|line| !line.contains(" rms ") && !line.contains(" bias "))
    {
        println!("{line}");
    }
    println!("{DRAWING}");
    Ok(Outcome::Passed)
}

/// What the example prints: medium, quantity, step, value.
struct Figures<'a>(Vec<(&'a str, &'a str, f64, f64)>);

impl<'a> Figures<'a> {
    fn parse(lines: &'a str) -> Result<Self, String> {
        let parse = |line: &'a str| {
            let words: Vec<&str> = line.split_whitespace().collect();
            let [medium, quantity, step, value] = words[..] else {
                return None;
            };
            Some((medium, quantity, step.parse().ok()?, value.parse().ok()?))
        };
        let understood = lines
            .lines()
            .map(|line| parse(line).ok_or_else(|| format!("march_convergence: `{line}`")));
        understood.collect::<Result<_, _>>().map(Self)
    }

    fn of(&self, medium: &str, quantity: &str) -> impl Iterator<Item = (f64, f64)> {
        let wanted = move |line: &&(&str, &str, f64, f64)| (line.0, line.1) == (medium, quantity);
        let found: Vec<_> = self.0.iter().filter(wanted).map(|l| (l.2, l.3)).collect();
        found.into_iter()
    }

    /// Steps from left to right, errors from bottom to top, both in powers of ten.
    fn draw(&self) -> String {
        const X: [f64; 2] = [-2.0, 0.3];
        const Y: [f64; 2] = [-6.0, 0.0];
        let x = |step: f64| 70.0 + 420.0 * (step.log10() - X[0]) / (X[1] - X[0]);
        let y = |error: f64| 330.0 - 310.0 * (error.log10() - Y[0]) / (Y[1] - Y[0]);
        let mut svg = String::from(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 660 380\" font-family=\"sans-serif\" \
             font-size=\"12\">\n<rect width=\"660\" height=\"380\" fill=\"white\"/>\n",
        );
        let mut add = |text: String| {
            svg.push_str(&text);
            svg.push('\n');
        };
        for power in -6..=0 {
            let at = y(10f64.powi(power));
            add(format!(
                "<path d=\"M70 {at:.1}H490\" stroke=\"#ddd\"/><text x=\"64\" y=\"{:.1}\" text-anchor=\"end\">1e{power}</text>",
                at + 4.0
            ));
        }
        for step in [0.01, 0.1, 1.0] {
            let at = x(step);
            add(format!(
                "<path d=\"M{at:.1} 20V330\" stroke=\"#ddd\"/><text x=\"{at:.1}\" y=\"346\" text-anchor=\"middle\">{step}</text>"
            ));
        }
        add("<text x=\"280\" y=\"368\" text-anchor=\"middle\">step of the march, in units of 1 / extinction</text>".into());
        for (row, (medium, quantity, color)) in SERIES.iter().enumerate() {
            let mut way = String::new();
            for (i, (step, error)) in self.of(medium, quantity).enumerate() {
                let (x, y) = (x(step), y(error));
                let _ = write!(way, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
                add(format!(
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{color}\"/>"
                ));
            }
            let slope = self.of(medium, &format!("slope-{quantity}")).next();
            let slope = slope.map_or(f64::NAN, |(_, slope)| slope);
            let at = 60 + 22 * row;
            add(format!(
                "<path d=\"{way}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\"/>\
                 <path d=\"M505 {at}h18\" stroke=\"{color}\" stroke-width=\"3\"/>\
                 <text x=\"528\" y=\"{}\">{medium}, {quantity}: {slope:.2}</text>",
                at + 4
            ));
        }
        for (medium, color) in [("fog", "#c2571a"), ("cloud", "#1f5f99")] {
            for (_, error) in self.of(medium, "tracked-error") {
                let at = y(error);
                add(format!(
                    "<path d=\"M70 {at:.1}H490\" stroke=\"{color}\" stroke-dasharray=\"4 4\"/>"
                ));
            }
        }
        add("<text x=\"505\" y=\"40\">slopes</text><text x=\"505\" y=\"170\">dashed: error of the</text>\
             <text x=\"505\" y=\"186\">mean of 131072 trackers</text>"
            .into());
        svg.push_str("</svg>\n");
        svg
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_become_points_and_nonsense_is_named() {
        let lines = "fog rms 1e-1 1e-2\nfog rms 1e0 1e-1\nfog slope-rms 0 1.0\n";
        let figures = Figures::parse(lines).expect("understood");
        assert_eq!(figures.of("fog", "rms").count(), 2, "two points");
        let svg = figures.draw();
        assert_eq!(svg.matches("<circle").count(), 2, "both drawn");
        assert!(svg.contains("fog, rms: 1.00"), "and the slope");
        assert!(Figures::parse("what\n").is_err(), "no figures");
    }
}
