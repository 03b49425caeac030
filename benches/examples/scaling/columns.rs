//! The table and the plots of what was measured.

use light_render::SamplerKind;
use light_render::plot::PlotSeries;

/// What one sampler costs over so many lights.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) lights: usize,
    pub(super) sampler: Measured,
    pub(super) costs: Costs,
}

/// A sampler, and how the lights are that it chooses among.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measured {
    /// One by one.
    Flat(SamplerKind),
    /// Stored once in houses that are placed, chosen by a tree of placed trees.
    Placed,
}

impl Measured {
    /// All that are measured, in the order of their rows.
    pub(super) const ALL: [Self; 5] = [
        Self::Flat(SamplerKind::Bvh),
        Self::Flat(SamplerKind::BvhReference),
        Self::Flat(SamplerKind::Power),
        Self::Flat(SamplerKind::Uniform),
        Self::Placed,
    ];

    /// What tables and legends call it.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Flat(SamplerKind::Bvh) => "default tree",
            Self::Flat(SamplerKind::BvhReference) => "reference tree",
            Self::Flat(SamplerKind::Power) => "by power",
            Self::Flat(other) => other.name(),
            Self::Placed => "placed trees",
        }
    }
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
        let lines = Measured::ALL.into_iter().flat_map(|sampler| {
            self.columns.iter().map(move |(column, cost)| PlotSeries {
                name: format!("{}, {column}", sampler.name()),
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
        table += &format!("| {lights} | {} |", row.sampler.name());
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

/// The rows of a table that [`table`] has made, with the digits that it shows; what is none is left
/// out.
pub(super) fn rows_of(table: &str) -> Vec<Row> {
    let mut lights = 0;
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let [_, size, sampler, figures @ ..] = &cells[..] else {
            return None;
        };
        if let Some(power) = size.strip_prefix("10^") {
            lights = 10_usize.checked_pow(power.parse().ok()?)?;
        }
        let mut all = Measured::ALL.into_iter();
        let sampler = all.find(|measured| measured.name() == *sampler)?;
        let figure = |k: usize| figures.get(k)?.parse().ok();
        let costs = Costs {
            build: figure(0),
            refit: figure(1),
            sample: figure(2),
            pmf: figure(3),
            bytes: figure(4),
        };
        Some(Row {
            lights,
            sampler,
            costs,
        })
    };
    table.lines().filter_map(row).collect()
}

/// Rows in the order of a table, later ones in place of earlier ones of the same thing.
pub(super) fn in_order(mut rows: Vec<Row>) -> Vec<Row> {
    let order = |sampler| Measured::ALL.iter().position(|&other| other == sampler);
    rows.reverse();
    rows.sort_by_key(|row| (row.lights, order(row.sampler)));
    rows.dedup_by_key(|row| (row.lights, row.sampler));
    rows
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
            sampler: Measured::Flat(SamplerKind::Bvh),
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

    #[test]
    fn a_table_is_read_back() {
        let row = |lights, sampler, build: f64| Row {
            lights,
            sampler,
            costs: Costs {
                build: (build > 0.0).then_some(build),
                sample: Some(4e-7),
                pmf: Some(1234.0),
                ..Costs::default()
            },
        };
        let all = |lights| Measured::ALL.map(|sampler| row(lights, sampler, 12.5));
        let mut rows = [all(100), all(1000)].concat();
        rows[3].costs.build = None;
        assert_eq!(rows_of(&table(&rows)), rows, "each figure");
        let newer = row(100, Measured::Placed, 7.5);
        let largest = row(10_000, Measured::Placed, 0.0);
        let mixed = [rows.clone(), vec![largest.clone(), newer.clone()]].concat();
        rows[4] = newer;
        rows.push(largest);
        assert_eq!(in_order(mixed), rows, "the newer one, and the largest last");
    }
}
