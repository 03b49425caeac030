use core::fmt;

/// Mismatches that are written out.
const SHOWN: usize = 5;

/// What a soak found.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// One row a set of lights, then one a light.
    pub rows: Vec<Row>,
}

/// What was found with one set of lights, or with one light.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// The set or the light.
    pub name: String,
    /// Samples taken and compared.
    pub samples: u64,
    /// Samples that were `None` and could not be compared.
    pub none: u64,
    /// Samples that broke a promise.
    pub mismatches: u64,
    /// The first of those, with what is needed to reproduce them.
    pub shown: Vec<String>,
}

impl Row {
    /// A row without samples.
    pub(super) fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            ..Self::default()
        }
    }

    /// Adds what was found in another part.
    pub(super) fn add(&mut self, part: Self) {
        self.samples += part.samples;
        self.none += part.none;
        self.mismatches += part.mismatches;
        self.shown.extend(part.shown);
        self.shown.truncate(SHOWN);
    }

    /// Counts a sample, and writes down what is wrong with it.
    pub(super) fn count(&mut self, fault: Option<String>) {
        self.samples += 1;
        if let Some(fault) = fault {
            self.mismatches += 1;
            if self.shown.len() < SHOWN {
                self.shown.push(fault);
            }
        }
    }
}

impl Report {
    /// Samples that broke a promise.
    #[must_use]
    pub fn mismatches(&self) -> u64 {
        self.rows.iter().map(|row| row.mismatches).sum()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "| set or light | samples | none | mismatches |")?;
        writeln!(f, "| --- | ---: | ---: | ---: |")?;
        let total = self.rows.iter().fold(Row::new("all"), |mut sum, row| {
            sum.add(row.clone());
            sum
        });
        for row in self.rows.iter().chain([&total]) {
            let (name, none) = (&row.name, row.none);
            let (samples, mismatches) = (row.samples, row.mismatches);
            writeln!(f, "| {name} | {samples} | {none} | {mismatches} |")?;
        }
        for row in &self.rows {
            for fault in &row.shown {
                writeln!(f, "{}: {fault}", row.name)?;
            }
        }
        Ok(())
    }
}
