//! The table and the plots of what was measured.

use light_render::SamplerKind;
use light_render::plot::PlotSeries;

/// What one sampler costs over so many lights.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) lights: usize,
    pub(super) sampler: SamplerKind,
    pub(super) costs: Costs,
}

/// The costs of a sampler: processor time of one thread in nanoseconds, and memory.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Costs {
    /// A build, a light of it; trees alone.
    pub(super) build: Option<f64>,
    /// A refit, a light of it; the default tree alone.
    pub(super) refit: Option<f64>,
    /// One sample.
    pub(super) sample: Option<f64>,
    /// The pmf of a light that the sampler chose.
    pub(super) pmf: Option<f64>,
    /// Bytes a light that queries may touch.
    pub(super) bytes: Option<f64>,
}

/// A column of figures: its title, and what it shows.
pub(super) type Column = (&'static str, fn(&Costs) -> Option<f64>);

pub(super) const COLUMNS: [Column; 5] = [
    ("build, ns a light", |costs| costs.build),
    ("refit, ns a light", |costs| costs.refit),
    ("sample, ns", |costs| costs.sample),
    ("pmf, ns", |costs| costs.pmf),
    ("bytes a light", |costs| costs.bytes),
];

/// A plot of some columns over the lights.
pub(super) struct Plot {
    /// Its file, from the project's root.
    pub(super) file: &'static str,
    pub(super) y_title: &'static str,
    /// The columns, by what the legend calls them.
    columns: &'static [Column],
}

pub(super) const PLOTS: [Plot; 4] = [
    Plot {
        file: "docs/images/scaling-build.svg",
        y_title: "nanoseconds a light",
        columns: &[
            ("build", |costs| costs.build),
            ("refit", |costs| costs.refit),
        ],
    },
    Plot {
        file: "docs/images/scaling-sample.svg",
        y_title: "nanoseconds a sample",
        columns: &[("sample", |costs| costs.sample)],
    },
    Plot {
        file: "docs/images/scaling-pmf.svg",
        y_title: "nanoseconds a pmf",
        columns: &[("pmf", |costs| costs.pmf)],
    },
    Plot {
        file: "docs/images/scaling-bytes.svg",
        y_title: "bytes a light",
        columns: &[("bytes", |costs| costs.bytes)],
    },
];

impl Plot {
    /// A line a sampler and column, of those that have points.
    pub(super) fn series(&self, rows: &[Row]) -> Vec<PlotSeries> {
        let mut samplers: Vec<SamplerKind> = Vec::new();
        for row in rows {
            if !samplers.contains(&row.sampler) {
                samplers.push(row.sampler);
            }
        }
        let lines = samplers.iter().flat_map(|&sampler| {
            self.columns.iter().map(move |(column, cost)| PlotSeries {
                name: format!("{}, {column}", name(sampler)),
                points: rows
                    .iter()
                    .filter(|row| row.sampler == sampler)
                    .filter_map(|row| Some([row.lights as f64, cost(&row.costs)?]))
                    .collect(),
            })
        });
        lines.filter(|line| !line.points.is_empty()).collect()
    }
}

/// What tables and legends call a sampler.
fn name(sampler: SamplerKind) -> &'static str {
    match sampler {
        SamplerKind::Bvh => "default tree",
        SamplerKind::BvhReference => "reference tree",
        SamplerKind::Power => "by power",
        other => other.name(),
    }
}

/// The table of `rows`, as Markdown; what a sampler does not have is left empty.
pub(super) fn table(rows: &[Row]) -> String {
    let mut table = "| lights | sampler |".to_owned();
    table.extend(COLUMNS.map(|(title, _)| format!(" {title} |")));
    table += "\n| --- | --- |";
    table += &" --- |".repeat(COLUMNS.len());
    table.push('\n');
    let mut last = 0;
    for row in rows {
        let lights = match row.lights {
            lights if lights == last => String::new(),
            lights => format!("10^{}", lights.ilog10()),
        };
        last = row.lights;
        table += &format!("| {lights} | {} |", name(row.sampler));
        for (_, cost) in COLUMNS {
            match cost(&row.costs) {
                Some(cost) => table += &format!(" {} |", figure(cost)),
                None => table += " |",
            }
        }
        table.push('\n');
    }
    table
}

/// About three digits.
fn figure(x: f64) -> String {
    match x {
        _ if x >= 100.0 => format!("{x:.0}"),
        _ if x >= 0.1 => format!("{x:.1}"),
        _ => format!("{x:.0e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_that_was_not_measured_is_empty() {
        let costs = Costs {
            build: Some(123.4),
            bytes: Some(27.04),
            ..Costs::default()
        };
        let row = |lights| Row {
            lights,
            sampler: SamplerKind::Bvh,
            costs,
        };
        let rows = [row(100), row(1000)];
        let table = table(&rows);
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!(
            lines[2], "| 10^2 | default tree | 123 | | | | 27.0 |",
            "{table}"
        );
        assert!(
            lines.iter().all(|line| line.matches('|').count() == 8),
            "{table}"
        );
        let series = PLOTS[0].series(&rows);
        assert_eq!(series.len(), 1, "refits were not measured: {series:?}");
        assert_eq!(
            series[0].points,
            [[100.0, 123.4], [1000.0, 123.4]],
            "builds"
        );
    }
}
