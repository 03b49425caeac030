use core::fmt::Write as _;
use core::ops::RangeInclusive;

/// A line of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotSeries {
    /// Its name in the legend.
    pub name: String,
    /// Its points, x before y; those that are not above 0 are left out.
    pub points: Vec<[f64; 2]>,
}

pub(super) const WIDTH: f64 = 640.0;
pub(super) const HEIGHT: f64 = 400.0;
/// Left, top, right and bottom of the frame.
const FRAME: [f64; 4] = [64.0, 14.0, 626.0, 352.0];

/// The range of one axis, in powers of ten.
#[derive(Clone, Copy, Debug)]
struct Axis {
    low: f64,
    high: f64,
    /// Where the ends are drawn.
    ends: [f64; 2],
}

impl Axis {
    fn around(values: impl Iterator<Item = f64>, ends: [f64; 2]) -> Self {
        let logs = values.map(f64::log10).filter(|log| log.is_finite());
        let [low, high] = logs.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], log| {
            [low.min(log), high.max(log)]
        });
        if low > high {
            return Self {
                low: -1.0,
                high: 1.0,
                ends,
            };
        }
        // Room around the points, and at least a factor of two.
        let room = (0.06 * (high - low)).max(0.15);
        Self {
            low: low - room,
            high: high + room,
            ends,
        }
    }

    fn place(&self, value: f64) -> f64 {
        let share = (value.log10() - self.low) / (self.high - self.low);
        self.ends[0] + share * (self.ends[1] - self.ends[0])
    }

    /// Powers of ten, and twice and five times these where there are few.
    fn ticks(&self) -> Vec<f64> {
        #[expect(clippy::cast_possible_truncation, reason = "exponents of f64")]
        let powers: RangeInclusive<i32> = self.low.floor() as i32..=self.high.ceil() as i32;
        let steps: &[f64] = match self.high - self.low {
            span if span < 1.5 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        powers
            .flat_map(|power| steps.iter().map(move |step| step * 10.0_f64.powi(power)))
            .filter(|tick| (self.low..=self.high).contains(&tick.log10()))
            .collect()
    }
}

/// A plot of `series` with logarithmic axes, as an SVG element that takes its colours from the
/// classes of the page: `axis`, `grid` and `s0`, `s1`, ... for lines. `floor` is a level below
/// which no difference can be seen.
pub(crate) fn log_plot(
    series: &[PlotSeries],
    x_title: &str,
    y_title: &str,
    floor: Option<f64>,
) -> String {
    let parts = log_plot_parts(series, x_title, y_title, floor);
    format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{y_title} over {x_title}, \
         both logarithmic\">\n{parts}</svg>\n"
    )
}

/// What lies in the SVG element of [`log_plot`].
pub(super) fn log_plot_parts(
    series: &[PlotSeries],
    x_title: &str,
    y_title: &str,
    floor: Option<f64>,
) -> String {
    let good = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let is_good = |p: &&[f64; 2]| p.iter().all(|x| *x > 0.0 && x.is_finite());
        points.iter().filter(is_good).copied().collect()
    };
    let lines: Vec<Vec<[f64; 2]>> = series.iter().map(|line| good(&line.points)).collect();
    let all = || lines.iter().flatten();
    let [left, top, right, bottom] = FRAME;
    let x_axis = Axis::around(all().map(|p| p[0]), [left, right]);
    let floor = floor.filter(|floor| *floor > 0.0);
    let y_axis = Axis::around(all().map(|p| p[1]).chain(floor), [bottom, top]);
    let mut svg = String::new();
    // Writing to a string does not fail.
    for tick in x_axis.ticks() {
        let x = x_axis.place(tick);
        let _ = writeln!(
            svg,
            "<path class=\"grid\" d=\"M{x:.1} {top}V{bottom}\"/>\
             <text class=\"tick\" x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            bottom + 16.0,
            tick_name(tick)
        );
    }
    for tick in y_axis.ticks() {
        let y = y_axis.place(tick);
        let _ = writeln!(
            svg,
            "<path class=\"grid\" d=\"M{left} {y:.1}H{right}\"/>\
             <text class=\"tick\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            left - 6.0,
            y + 4.0,
            tick_name(tick)
        );
    }
    let _ = writeln!(
        svg,
        "<path class=\"axis\" d=\"M{left} {top}V{bottom}H{right}\"/>\
         <text class=\"tick\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{x_title}</text>\
         <text class=\"tick\" transform=\"translate(14 {:.1}) rotate(-90)\" \
         text-anchor=\"middle\">{y_title}</text>",
        0.5 * (left + right),
        HEIGHT - 10.0,
        0.5 * (top + bottom)
    );
    if let Some(floor) = floor {
        let y = y_axis.place(floor);
        let _ = writeln!(svg, "<path class=\"floor\" d=\"M{left} {y:.1}H{right}\"/>");
    }
    for (i, line) in lines.iter().enumerate() {
        let places = line
            .iter()
            .map(|p| [x_axis.place(p[0]), y_axis.place(p[1])]);
        let mut path = String::new();
        let mut dots = String::new();
        for [x, y] in places {
            let command = if path.is_empty() { 'M' } else { 'L' };
            let _ = write!(path, "{command}{x:.1} {y:.1}");
            let _ = write!(dots, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\"/>");
        }
        if !path.is_empty() {
            let _ = writeln!(svg, "<g class=\"s{i}\"><path d=\"{path}\"/>{dots}</g>");
        }
    }
    svg
}

/// The value of a tick: plain where that is short.
fn tick_name(tick: f64) -> String {
    if (1e-3..1e4).contains(&tick) {
        // Rounds what powers of ten carry along.
        format!("{}", (tick * 1e6).round() / 1e6)
    } else {
        format!("{tick:.0e}")
    }
}

/// The slope of a straight line through the logarithms of `points`, by least squares: the power of
/// x that y goes with. `None` for fewer than three points above 0.
pub(crate) fn slope(points: &[[f64; 2]]) -> Option<f64> {
    let logs: Vec<[f64; 2]> = points
        .iter()
        .filter(|p| p.iter().all(|x| *x > 0.0 && x.is_finite()))
        .map(|p| p.map(f64::ln))
        .collect();
    if logs.len() < 3 {
        return None;
    }
    let n = logs.len() as f64;
    let mean = |axis: usize| logs.iter().map(|p| p[axis]).sum::<f64>() / n;
    let (x, y) = (mean(0), mean(1));
    let above: f64 = logs.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    let below: f64 = logs.iter().map(|p| (p[0] - x) * (p[0] - x)).sum();
    (below > 0.0).then(|| above / below)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_have_their_slope() {
        let points: Vec<[f64; 2]> = (1..6).map(|x| [f64::from(x), 3.0 / f64::from(x)]).collect();
        let found = slope(&points).expect("five points");
        assert!((found + 1.0).abs() < 1e-12, "{found}");
        assert_eq!(slope(&points[..2]), None, "two points");
        assert_eq!(slope(&[[1.0, 1.0]; 4]), None, "one place");
    }

    #[test]
    fn points_lie_in_the_frame_and_odd_ones_are_left_out() {
        let series = PlotSeries {
            name: "a".into(),
            points: vec![[0.1, 1.0], [1.0, 0.01], [10.0, 0.0], [f64::NAN, 1.0]],
        };
        let svg = log_plot(&[series], "s", "error", Some(1e-3));
        assert_eq!(svg.matches("<circle").count(), 2, "{svg}");
        assert!(svg.contains("class=\"floor\""), "{svg}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        let nothing = log_plot(&[], "s", "error", None);
        assert!(nothing.ends_with("</svg>\n"), "{nothing}");
    }

    #[test]
    fn short_axes_have_more_ticks() {
        let axis = |low, high| Axis::around([low, high].into_iter(), [0.0, 1.0]).ticks();
        assert_eq!(axis(1.0, 4.0), [1.0, 2.0, 5.0], "within a power");
        assert_eq!(axis(0.1, 1000.0), [0.1, 1.0, 10.0, 100.0, 1000.0], "powers");
    }
}
