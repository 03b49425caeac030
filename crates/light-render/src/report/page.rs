use std::path::Path;

use light_scene::Diagnostic;

use crate::ToneMap;
use crate::plot::{PlotSeries, log_plot};

use super::html::{Html, figure};
use super::picture::{data_uri, heat, shown, signed_error};
use super::reference::ReferenceSource;
use super::sampler_row::SamplerRow;
use super::scene_report::SceneReport;
use super::tables::key;

impl SceneReport {
    /// The page: HTML with everything in it, that needs no script and no other file;
    /// `path` names it in messages.
    ///
    /// # Errors
    /// When a picture cannot be encoded.
    pub(crate) fn page(&self, path: &Path, tone_map: &ToneMap) -> Result<String, Diagnostic> {
        let mut html = Html::default();
        let title = format!("{}: light samplers compared", self.options.scene);
        html.markup("<!DOCTYPE html>\n");
        let mut pictures = Ok(());
        html.element("html", " lang=\"en\"", |html| {
            html.element("head", "", |html| {
                html.markup("<meta charset=\"utf-8\"/>\n");
                html.markup(
                    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n",
                );
                html.words("title", &title);
                html.element("style", "", |html| html.markup(include_str!("page.css")));
            });
            html.element("body", "", |html| {
                html.words("h1", &title);
                self.summary(html);
                section(html, "pictures", "Pictures at equal time", |html| {
                    pictures = self.pictures(html, path, tone_map);
                    self.error_table(html);
                });
                section(html, "convergence", "Convergence", |html| {
                    self.convergence(html)
                });
                section(
                    html,
                    "variance",
                    "Variance of one choice, by pixel",
                    |html| {
                        self.variance(html);
                    },
                );
                section(html, "cost", "Time, memory, lost light", |html| {
                    self.cost(html)
                });
                section(html, "lights", "Lights", |html| self.inventory(html));
                section(html, "notes", "How this was measured", |html| {
                    self.notes(html)
                });
            });
        });
        pictures?;
        Ok(html.into_text())
    }

    fn summary(&self, html: &mut Html) {
        let (width, height) = self.size;
        html.words(
            "p",
            &format!(
                "{} lights, {} triangles, {} quadrics; {width} x {height} pixels, {} s for each \
                 picture on {} threads, paths of at most {} segments, seed {}.",
                self.lights,
                self.triangles,
                self.quadrics,
                figure(self.options.time.as_secs_f64()),
                self.threads,
                self.options.path.max_depth,
                self.options.seed
            ),
        );
    }

    fn pictures(&self, html: &mut Html, path: &Path, tone_map: &ToneMap) -> Result<(), Diagnostic> {
        let uri = |pixels| data_uri(path, pixels, self.size.0);
        let reference = &self.reference.pixels;
        let reference_uri = uri(shown(reference, tone_map))?;
        html.element("div", " class=\"row\"", |html| {
            html.element("figure", "", |html| {
                html.element("div", " class=\"marked\"", |html| {
                    image(html, &reference_uri, "the reference");
                    self.markers(html);
                });
                html.words("figcaption", &self.reference_words());
            });
        });
        for (i, row) in self.rows.iter().enumerate() {
            let uris = [
                shown(&row.pixels, tone_map),
                signed_error(&row.pixels, reference),
                heat(&row.flip.map),
            ]
            .into_iter()
            .map(uri)
            .collect::<Result<Vec<_>, _>>()?;
            html.element("h3", &format!(" class=\"s{i}\""), |html| {
                key(html);
                html.text(row.kind.name());
            });
            let captions = [
                format!("samples a pixel: {}", row.samples),
                format!(
                    "relMSE {}: red too bright, blue too dark",
                    figure(row.rel_mse)
                ),
                format!("FLIP {}: brighter differs more", figure(row.flip.mean())),
            ];
            html.element("div", " class=\"row\"", |html| {
                for (uri, caption) in uris.iter().zip(&captions) {
                    html.element("figure", "", |html| {
                        image(html, uri, &format!("{}, {caption}", row.kind.name()));
                        html.words("figcaption", caption);
                    });
                }
            });
        }
        Ok(())
    }

    /// The numbers of the chosen pixels, over the picture.
    fn markers(&self, html: &mut Html) {
        let (width, height) = self.size;
        let unit = f64::from(width.max(height)) / 100.0;
        let view = format!(" viewBox=\"0 0 {width} {height}\" aria-hidden=\"true\"");
        html.element("svg", &view, |html| {
            for (i, pixel) in self.pixels.iter().enumerate() {
                let [x, y] = [0, 1].map(|axis| {
                    f64::from(pixel.pixel[axis].saturating_sub(self.corner[axis])) + 0.5
                });
                html.markup(format_args!(
                    "<circle class=\"mark\" cx=\"{x}\" cy=\"{y}\" r=\"{:.2}\"/>\
                     <text class=\"mark\" x=\"{x}\" y=\"{:.2}\" font-size=\"{:.2}\">{}</text>",
                    2.6 * unit,
                    y + 1.35 * unit,
                    3.8 * unit,
                    i + 1
                ));
            }
        });
    }

    fn reference_words(&self) -> String {
        match &self.reference.source {
            ReferenceSource::Given(path) => format!("Reference: {}", path.display()),
            ReferenceSource::Made {
                sampler,
                samples,
                time,
                ..
            } => format!(
                "Reference: {sampler}, {samples} samples a pixel, {} s, relMSE of its own {}",
                figure(time.as_secs_f64()),
                self.reference
                    .rel_mse()
                    .map_or_else(|| "unknown".into(), figure)
            ),
        }
    }

    fn convergence(&self, html: &mut Html) {
        let line = |row: &SamplerRow| PlotSeries {
            name: row.kind.name().into(),
            points: row.convergence.iter().map(|&(s, _, e)| [s, e]).collect(),
        };
        let series: Vec<PlotSeries> = self.rows.iter().map(line).collect();
        let plot = log_plot(&series, "seconds", "relMSE", self.reference.rel_mse());
        html.element("figure", " class=\"plot\"", |html| {
            html.markup(plot);
            html.element("figcaption", "", |html| {
                for (i, (line, row)) in series.iter().zip(&self.rows).enumerate() {
                    html.element("span", &format!(" class=\"legend s{i}\""), |html| {
                        key(html);
                        html.text(&format!("{}, slope ", line.name));
                        html.number(row.slope);
                    });
                }
            });
        });
        let floor = if self.reference.rel_mse().is_some() {
            " The dashed line is the reference's own error. It cancels on average: each error is the \
             product of the differences to the two halves of the reference, which may be below 0 for \
             a picture far better than it."
        } else {
            ""
        };
        html.words(
            "p",
            &format!(
                "relMSE of the picture as it grows, over the time since the sampler was begun. \
                 Independent samples give a slope of -1.{floor}"
            ),
        );
    }

    fn variance(&self, html: &mut Html) {
        if self.pixels.is_empty() {
            html.words("p", "No pixel shows a surface that scatters light.");
            return;
        }
        self.pixel_table(html);
        html.words(
            "p",
            "V is the variance of the light that one choice finds, over the square of the light \
             there is: the sum over all lights that a pixel could be lit by, with their shadows. \
             Lights is their number, arriving the share of their light that nothing is in the way \
             of, best the V of the best choice there is. Numbers are those on the reference.",
        );
    }

    fn cost(&self, html: &mut Html) {
        self.cost_table(html);
        html.words(
            "p",
            &format!(
                "Bytes are those that choices may touch, beside {} bytes of the lights themselves. \
                 V here is that of choices at points of surfaces with nothing in the way. Lost \
                 light comes from lights that are never chosen; no light is the share of choices \
                 that find none.",
                self.light_bytes
            ),
        );
    }

    fn inventory(&self, html: &mut Html) {
        self.light_table(html);
    }

    fn notes(&self, html: &mut Html) {
        html.words(
            "p",
            "relMSE is the mean over pixels and channels of the squared difference over the \
             squared reference plus 0.01. FLIP says how different pictures look, from 0 to 1: over \
             the exposures of the reference, or as a screen shows radiance clamped at 1. Bias is \
             the mean difference.",
        );
        html.element("ul", "", |html| {
            for note in self.options.notes.iter().chain(&self.pixels_left_out()) {
                html.words("li", note);
            }
            for row in self.rows.iter().filter(|row| row.rejected > 0) {
                let note = format!("{}: {} samples were not finite", row.kind, row.rejected);
                html.words("li", &note);
            }
            html.words(
                "li",
                concat!("Made by lights ", env!("CARGO_PKG_VERSION"), "."),
            );
        });
    }
}

fn section(html: &mut Html, id: &str, title: &str, content: impl FnOnce(&mut Html)) {
    html.element("section", &format!(" id=\"{id}\""), |html| {
        html.words("h2", title);
        content(html);
    });
}

/// A picture, and words for who does not see it.
fn image(html: &mut Html, uri: &str, words: &str) {
    html.markup(format_args!("<img src=\"{uri}\" alt=\""));
    html.text(words);
    html.markup("\"/>");
}
