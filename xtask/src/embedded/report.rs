use super::board::Board;

/// What a program printed: see `embedded/src/measure.rs`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Report {
    queries: Vec<Cost>,
}

/// What a query answered, and what it took.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cost {
    pub(super) name: String,
    /// Of the answers.
    hash: [u32; 2],
    /// Ticks of the shortest, of all, and of the longest; the host counts none.
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
    /// The first line that is not understood, or that there is none.
    pub(super) fn of(text: &str) -> Result<Self, String> {
        let query = |line: &str| {
            let error = || format!("not understood: {line}");
            let words: Vec<&str> = line.split(' ').collect();
            let [name, numbers @ ..] = &words[..] else {
                return Err(error());
            };
            let numbers = numbers.iter().map(|word| u32::from_str_radix(word, 16));
            let numbers: Result<Vec<u32>, _> = numbers.collect();
            match numbers.map_err(|_| error())?[..] {
                [high, low, least, all, most, stack] => Ok(Cost {
                    name: (*name).to_owned(),
                    hash: [high, low],
                    ticks: [least, all, most].map(f64::from),
                    stack,
                }),
                _ => Err(error()),
            }
        };
        let queries = text.lines().map(query).collect::<Result<Vec<_>, _>>()?;
        if queries.is_empty() {
            return Err("it printed nothing".into());
        }
        Ok(Self { queries })
    }

    /// Whether the answers have the bits of the host's.
    ///
    /// # Errors
    /// The first query whose answers differ.
    pub(super) fn must_equal(&self, host: &Self) -> Result<(), String> {
        if self.queries.len() != host.queries.len() {
            return Err("not the host's queries".into());
        }
        for (ours, hosts) in self.queries.iter().zip(&host.queries) {
            if (&ours.name, ours.hash) != (&hosts.name, hosts.hash) {
                return Err(format!(
                    "{}: other bits than on the host: {:x?}, not {:x?}",
                    ours.name, ours.hash, hosts.hash
                ));
            }
        }
        Ok(())
    }

    /// The most stack of any query.
    pub(super) fn stack(&self) -> u32 {
        let stacks = self.queries.iter().map(|cost| cost.stack);
        stacks.max().unwrap_or(0)
    }

    /// Each query with the instructions of the shortest, the mean and the longest one.
    pub(super) fn rows(&self, board: &Board) -> Vec<(&Cost, [f64; 3])> {
        let mean = |cost: &Cost| cost.ticks[1] / SAMPLES;
        let nothing = self.queries.iter().find(|cost| cost.name == NOTHING);
        let overhead = nothing.map_or(0.0, mean);
        let queries = self.queries.iter().filter(|cost| cost.name != NOTHING);
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

    const TEXT: &str = "nothing 0 1 8 1f40 8 64\ntree 0 2 58 29040 f8 384\n";

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
        let host = "nothing 0 1 0 0 0 0\ntree 0 2 0 0 0 0\n";
        let host = Report::of(host).expect("a report");
        let report = |text: &str| Report::of(text).expect("a report");
        assert_eq!(report(TEXT).must_equal(&host), Ok(()), "the same");
        let other = report(&TEXT.replace("0 2", "0 3")).must_equal(&host);
        assert!(other.is_err_and(|e| e.starts_with("tree")), "another");
        let fewer = report("nothing 0 1 8 1f40 8 64\n").must_equal(&host);
        assert!(fewer.is_err(), "a query less");
    }

    #[test]
    fn what_is_no_report_is_refused() {
        assert!(Report::of("").is_err(), "nothing");
        assert!(Report::of("a 0 1 2 3 4 5\nP").is_err(), "a panic");
        assert!(Report::of("a 0 1 2 3 4 x").is_err(), "no number");
        assert!(Report::of("a 0 1 2 3 4").is_err(), "a number less");
    }
}
