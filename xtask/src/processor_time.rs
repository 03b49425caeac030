//! The processor time of commands, which other work on the machine changes little.

use std::fs;

/// Ticks of `/proc/self/stat` a second.
const TICKS: f64 = 100.0;

/// Processor time in s of all processes that this one waited for. None without Linux.
#[must_use]
pub fn children_seconds() -> Option<f64> {
    Some(ticks(&fs::read_to_string("/proc/self/stat").ok()?)? / TICKS)
}

/// Fields 16 and 17 of `/proc/self/stat`, together; the second, a name, may hold spaces.
fn ticks(stat: &str) -> Option<f64> {
    let (_, fields) = stat.rsplit_once(") ")?;
    let fields: Vec<&str> = fields.split(' ').collect();
    let number = |i: usize| fields.get(i)?.parse::<f64>().ok();
    Some(number(13)? + number(14)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_of_children_is_found() {
        let stat = "7 (a ) b) S 1 2 3 4 5 6 7 8 9 10 11 12 250 50 20 0";
        assert_eq!(ticks(stat), Some(300.0), "user and system");
        assert_eq!(ticks("7 (a) S 1"), None, "too short");
    }
}
