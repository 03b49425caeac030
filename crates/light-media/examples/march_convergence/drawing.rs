//! Errors of marches as a drawing: both axes are logarithmic.

use core::fmt::Write as _;

use super::figures::MediumFigures;

/// Colours of the root mean squared error and of the bias, a medium.
const COLORS: [[&str; 2]; 2] = [["#c2571a", "#e8a87c"], ["#1f5f99", "#8ab6dc"]];

/// A line of points, and its entry in the legend.
struct Series {
    label: String,
    color: &'static str,
    /// Steps and errors.
    points: Vec<(f64, f64)>,
}

/// Steps from left to right, errors from bottom to top, both in powers of ten.
pub(super) fn drawing(media: &[MediumFigures]) -> String {
    const X: [f64; 2] = [-2.0, 0.3];
    const Y: [f64; 2] = [-6.0, 0.0];
    let x = |step: f64| 70.0 + 420.0 * (step.log10() - X[0]) / (X[1] - X[0]);
    let y = |error: f64| 330.0 - 310.0 * (error.log10() - Y[0]) / (Y[1] - Y[0]);
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 660 380\" \
         font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"660\" height=\"380\" fill=\"white\"/>\n",
    );
    let mut add = |text: String| {
        svg.push_str(&text);
        svg.push('\n');
    };
    for power in -6..=0 {
        let at = y(10f64.powi(power));
        add(format!(
            "<path d=\"M70 {at:.1}H490\" stroke=\"#ddd\"/><text x=\"64\" y=\"{:.1}\" \
             text-anchor=\"end\">1e{power}</text>",
            at + 4.0
        ));
    }
    for step in [0.01, 0.1, 1.0] {
        let at = x(step);
        add(format!(
            "<path d=\"M{at:.1} 20V330\" stroke=\"#ddd\"/><text x=\"{at:.1}\" y=\"346\" \
             text-anchor=\"middle\">{step}</text>"
        ));
    }
    add(
        "<text x=\"280\" y=\"368\" text-anchor=\"middle\">step of the march, in units of 1 / \
         extinction</text>"
            .into(),
    );
    for (row, series) in media.iter().zip(COLORS).flat_map(series).enumerate() {
        let Series {
            label,
            color,
            points,
        } = series;
        let mut path = String::new();
        for (i, (step, error)) in points.into_iter().enumerate() {
            let (x, y) = (x(step), y(error));
            let _ = write!(path, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
            add(format!(
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{color}\"/>"
            ));
        }
        let at = 60 + 22 * row;
        add(format!(
            "<path d=\"{path}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\"/>\
             <path d=\"M505 {at}h18\" stroke=\"{color}\" stroke-width=\"3\"/>\
             <text x=\"528\" y=\"{}\">{label}</text>",
            at + 4
        ));
    }
    for (medium, [color, _]) in media.iter().zip(COLORS) {
        let at = y(medium.tracked_error);
        add(format!(
            "<path d=\"M70 {at:.1}H490\" stroke=\"{color}\" stroke-dasharray=\"4 4\"/>"
        ));
    }
    add(
        "<text x=\"505\" y=\"40\">slopes</text><text x=\"505\" y=\"170\">\
        dashed: error of the</text>\
         <text x=\"505\" y=\"186\">mean of 131072 trackers</text>"
            .into(),
    );
    svg.push_str("</svg>\n");
    svg
}

/// The root mean squared error of a medium, and its bias.
fn series((medium, colors): (&MediumFigures, [&'static str; 2])) -> [Series; 2] {
    let MediumFigures { name, errors, .. } = medium;
    [
        Series {
            label: format!("{name}, rms: {:.2}", medium.rms_slope),
            color: colors[0],
            points: errors.iter().map(|e| (e.step, e.rms)).collect(),
        },
        Series {
            label: format!("{name}, bias: {:.2}", medium.bias_slope),
            color: colors[1],
            points: errors.iter().map(|e| (e.step, e.bias)).collect(),
        },
    ]
}
