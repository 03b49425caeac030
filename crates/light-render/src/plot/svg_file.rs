use core::fmt::Write as _;

use super::log_plot::{HEIGHT, PlotSeries, WIDTH, log_plot_parts};

/// The colours of lines, one a series, as in the pages of `lights report`.
const COLORS: [&str; 6] = [
    "#0069b4", "#c2500a", "#0a7d53", "#a03b86", "#8a6d00", "#4d4d8f",
];

/// Lines of the legend have this height, and so much room at the left.
const LEGEND: [f64; 2] = [20.0, 72.0];

/// A plot of `series` with logarithmic axes as a whole SVG file, with a legend below the frame.
/// Points of which a coordinate is not above 0 are left out. The titles and names are text: what
/// XML would read as markup is escaped. Series beyond the sixth begin with the first colour again.
#[must_use]
pub fn log_plot_file(series: &[PlotSeries], x_title: &str, y_title: &str) -> String {
    let [step, left] = LEGEND;
    let height = HEIGHT + step * series.len() as f64 + 10.0;
    let (x_title, y_title) = (escaped(x_title), escaped(y_title));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" \
         aria-label=\"{y_title} over {x_title}, both logarithmic\">\n\
         <style>\n\
         text {{ font: 13px system-ui, sans-serif; fill: #1c1e21; }}\n\
         .tick {{ fill: #5d636b; }}\n\
         .grid {{ stroke: #d9dbde; fill: none; }}\n\
         .axis {{ stroke: #5d636b; fill: none; }}\n\
         g path {{ fill: none; stroke: currentColor; stroke-width: 2; }}\n\
         g circle {{ fill: currentColor; }}\n"
    );
    // Writing to a string does not fail.
    for (i, _) in series.iter().enumerate() {
        let color = COLORS[i % COLORS.len()];
        let _ = writeln!(svg, ".s{i} {{ color: {color}; }}");
    }
    svg.push_str("</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fdfdfb\"/>\n");
    svg.push_str(&log_plot_parts(series, &x_title, &y_title, None));
    for (i, line) in series.iter().enumerate() {
        let y = HEIGHT + step * i as f64 + 6.0;
        let (end, text, name) = (left + 24.0, left + 32.0, escaped(&line.name));
        let _ = writeln!(
            svg,
            "<g class=\"s{i}\"><path d=\"M{left} {y}H{end}\"/></g>\
             <text x=\"{text}\" y=\"{:.1}\">{name}</text>",
            y + 4.0
        );
    }
    svg.push_str("</svg>\n");
    svg
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_a_namespace_and_a_legend() {
        let line = |name: &str| PlotSeries {
            name: name.into(),
            points: vec![[1.0, 2.0], [10.0, 0.0], [100.0, 5.0]],
        };
        let svg = log_plot_file(&[line("a < b"), line("c")], "lights", "ns");
        assert!(svg.starts_with("<svg xmlns="), "{svg}");
        assert_eq!(svg.matches("<svg").count(), 1, "one element: {svg}");
        assert_eq!(svg.matches("<circle").count(), 4, "0 is left out: {svg}");
        assert!(svg.contains(">a &lt; b</text>"), "text is escaped: {svg}");
        assert!(svg.contains(".s1 { color: #c2500a; }"), "{svg}");
    }
}
