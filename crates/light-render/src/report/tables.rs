use super::html::Html;
use super::sampler_row::SamplerRow;
use super::scene_report::SceneReport;

/// A column of a table of samplers: its title, and the number of a row.
type Column = (&'static str, fn(&SamplerRow) -> Option<f64>);

/// The columns of errors.
const ERRORS: [Column; 7] = [
    ("samples a pixel", |row| Some(row.samples.into())),
    ("seconds", |row| Some(row.seconds)),
    ("relMSE", |row| Some(row.rel_mse)),
    ("slope", |row| row.slope),
    ("FLIP, exposures", |row| Some(row.flip.mean())),
    ("FLIP, screen", |row| Some(row.flip_ldr)),
    ("bias", |row| Some(row.comparison.bias.element_sum() / 3.0)),
];

/// The columns of time, memory and lost light.
const COSTS: [Column; 10] = [
    ("build ms", |row| Some(row.build_ms)),
    ("bytes", |row| Some(row.bytes as f64)),
    ("ns a choice", |row| row.choice(|row| row.time.sample)),
    ("ns a probability", |row| row.choice(|row| row.time.pmf)),
    ("million rays/s", |row| {
        Some(row.rays as f64 / row.seconds * 1e-6)
    }),
    ("V mean", |row| row.choice(|row| row.variance.mean)),
    ("V median", |row| row.choice(|row| row.variance.median)),
    ("V 99 %", |row| row.choice(|row| row.variance.p99)),
    ("lost light", |row| {
        row.choice(|row| row.variance.lost_energy)
    }),
    ("no light", |row| row.choice(|row| row.laws.no_light)),
];

impl SceneReport {
    /// Errors of the pictures.
    pub(super) fn error_table(&self, html: &mut Html) {
        self.sampler_table(html, "errors", &ERRORS);
    }

    /// Time, memory and what choices lose.
    pub(super) fn cost_table(&self, html: &mut Html) {
        self.sampler_table(html, "costs", &COSTS);
    }

    fn sampler_table(&self, html: &mut Html, id: &str, columns: &[Column]) {
        let titles = columns.iter().map(|(title, _)| *title);
        table(html, id, "sampler", titles, |html| {
            for (i, row) in self.rows.iter().enumerate() {
                html.element("tr", "", |html| {
                    html.element("th", &format!(" scope=\"row\" class=\"s{i}\""), |html| {
                        key(html);
                        html.text(row.kind.name());
                    });
                    for (_, of) in columns {
                        html.element("td", "", |html| html.number(of(row)));
                    }
                });
            }
        });
    }

    /// The variance at each pixel.
    pub(super) fn pixel_table(&self, html: &mut Html) {
        let samplers = self.rows.iter().map(|row| row.kind.name());
        let titles = ["x", "y", "lights", "arriving"];
        let titles = titles.into_iter().chain(samplers).chain(["best"]);
        table(html, "variances", "pixel", titles, |html| {
            for (i, pixel) in self.pixels.iter().enumerate() {
                html.element("tr", "", |html| {
                    html.element("th", " scope=\"row\"", |html| html.markup(i + 1));
                    let [x, y] = pixel.pixel.map(f64::from);
                    let known = [x, y, pixel.lights as f64, pixel.arriving].map(Some);
                    let v = pixel.splits.iter().map(|split| split.relative());
                    for number in known.into_iter().chain(v).chain([pixel.best.relative()]) {
                        html.element("td", "", |html| html.number(number));
                    }
                });
            }
        });
    }

    /// The lights by kind.
    pub(super) fn light_table(&self, html: &mut Html) {
        let titles = ["lights", "red W", "green W", "blue W", "area"];
        table(html, "kinds", "kind", titles.into_iter(), |html| {
            for kind in &self.inventory {
                html.element("tr", "", |html| {
                    html.element("th", " scope=\"row\"", |html| html.text(kind.kind));
                    let [r, g, b] = kind.power.to_array();
                    for number in [kind.count as f64, r, g, b, kind.area] {
                        html.element("td", "", |html| html.number(Some(number)));
                    }
                });
            }
        });
    }
}

/// The mark of a sampler's colour, as in the plot.
pub(super) fn key(html: &mut Html) {
    html.element("span", " class=\"key\"", |_| ());
}

/// A table that scrolls by itself where the page is narrow.
fn table<'a>(
    html: &mut Html,
    id: &str,
    first: &'a str,
    titles: impl Iterator<Item = &'a str>,
    rows: impl FnOnce(&mut Html),
) {
    html.element("div", " class=\"scroll\" tabindex=\"0\"", |html| {
        html.element("table", &format!(" id=\"{id}\""), |html| {
            html.element("thead", "", |html| {
                html.element("tr", "", |html| {
                    for title in [first].into_iter().chain(titles) {
                        html.element("th", " scope=\"col\"", |html| html.text(title));
                    }
                });
            });
            html.element("tbody", "", rows);
        });
    });
}
