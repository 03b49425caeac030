use super::board::Board;

/// What a program printed: see `embedded/src/machine/mod.rs`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Report {
    /// Queries and the hashes of their answers.
    hashes: Vec<(String, String)>,
    costs: Vec<Cost>,
}

/// What a query took.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cost {
    pub(super) name: String,
    /// Ticks of the shortest, of all, and of the longest.
    ticks: [f64; 3],
    /// Bytes.
    pub(super) stack: u32,
}

/// How often each query is asked, `SAMPLES` of the programs.
const SAMPLES: f64 = 1000.0;

/// The query that does nothing: what measuring costs.
const NOTHING: &str = "nothing";

impl Report {
    /// The report in a program's output.
    ///
    /// # Errors
    /// The first line that is not understood, or that there is no hash.
    pub(super) fn of(text: &str) -> Result<Self, String> {
        let mut report = Self::default();
        for line in text.lines() {
            let words: Vec<&str> = line.split(' ').collect();
            let number = |word: &str| {
                let number = word.parse::<u32>();
                number.map_err(|_| format!("not a number in: {line}"))
            };
            match words[..] {
                ["hash", name, hash] => report.hashes.push((name.into(), hash.into())),
                ["cost", name, least, all, most, stack] => report.costs.push(Cost {
                    name: name.into(),
                    ticks: [number(least)?, number(all)?, number(most)?].map(f64::from),
                    stack: number(stack)?,
                }),
                _ => return Err(format!("not understood: {line}")),
            }
        }
        if report.hashes.is_empty() {
            return Err("it printed no hash".into());
        }
        Ok(report)
    }

    /// Whether the answers have the bits of the host's.
    ///
    /// # Errors
    /// The first query whose answers differ.
    pub(super) fn must_equal(&self, host: &Self) -> Result<(), String> {
        if self.hashes.len() != host.hashes.len() {
            return Err("not the host's queries".into());
        }
        let pairs = self.hashes.iter().zip(&host.hashes);
        match pairs.into_iter().find(|(ours, hosts)| ours != hosts) {
            None => Ok(()),
            Some(((name, ours), (_, hosts))) => Err(format!(
                "{name}: other bits than on the host: {ours}, not {hosts}"
            )),
        }
    }

    /// The most stack of any query.
    pub(super) fn stack(&self) -> u32 {
        let stacks = self.costs.iter().map(|cost| cost.stack);
        stacks.max().unwrap_or(0)
    }

    /// Each query with the instructions of the shortest, the mean and the longest one.
    pub(super) fn rows(&self, board: &Board) -> Vec<(&Cost, [f64; 3])> {
        let mean = |cost: &Cost| cost.ticks[1] / SAMPLES;
        let nothing = self.costs.iter().find(|cost| cost.name == NOTHING);
        let overhead = nothing.map_or(0.0, mean);
        let queries = self.costs.iter().filter(|cost| cost.name != NOTHING);
        queries
            .map(|cost| {
                let ticks = [cost.ticks[0], mean(cost), cost.ticks[2]];
                let of = |ticks: f64| board.instructions(ticks - overhead);
                (cost, ticks.map(of))
            })
            .collect()
    }

    /// Prints the rows.
    pub(super) fn print(&self, board: &Board) {
        for (cost, [least, mean, most]) in self.rows(board) {
            println!(
                "        {}: {mean:.0} instructions ({least:.0} to {most:.0}), {} bytes of stack",
                cost.name, cost.stack
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::board::BOARDS;
    use super::*;

    const TEXT: &str = "hash nothing 01\ncost nothing 8 8000 8 100\n\
                        hash tree 02\ncost tree 88 168000 248 900\n";

    #[test]
    fn costs_are_those_beyond_nothing() {
        let report = Report::of(TEXT).expect("a report");
        assert_eq!(report.stack(), 900, "the most");
        let rows = report.rows(&BOARDS[0]);
        assert_eq!(rows.len(), 1, "one query");
        assert_eq!(rows[0].1, [50.0, 100.0, 150.0], "40 ns of 64 ns");
    }

    #[test]
    fn another_bit_is_a_fault() {
        let host = Report::of("hash nothing 01\nhash tree 02\n").expect("a report");
        let report = |text: &str| Report::of(text).expect("a report");
        assert_eq!(report(TEXT).must_equal(&host), Ok(()), "the same");
        let other = report(&TEXT.replace("02", "03")).must_equal(&host);
        assert!(other.is_err_and(|e| e.starts_with("tree")), "another");
        let fewer = report("hash nothing 01\n").must_equal(&host);
        assert!(fewer.is_err(), "a query less");
    }

    #[test]
    fn what_is_no_report_is_refused() {
        assert!(Report::of("").is_err(), "nothing");
        assert!(Report::of("hash a 1\nP").is_err(), "a panic");
        assert!(Report::of("cost a 1 2 x 4").is_err(), "no number");
    }
}
