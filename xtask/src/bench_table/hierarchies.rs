//! Time, variance, memory and builds of the hierarchies side by side.

use serde_json::Value;

use super::{figure, number};

const SETS: [&str; 4] = ["uniform", "clusters", "spots", "mixed"];

/// Lights of a set, how the table writes that, and how many points its variance is taken over.
const SIZES: [(&str, &str, &str); 3] = [
    ("100", "100", "4096"),
    ("10000", "10 k", "4096"),
    ("1000000", "1 M", "16"),
];

/// The lines of one set: each sampler by its name in the program, samples of one call, and its name
/// in the table. All others are compared with the first.
const LINES: [(&str, u32, &str); 4] = [
    ("bvh-reference", 1, "reference"),
    ("bvh", 1, "default"),
    ("bvh-morton", 1, "fast build"),
    ("bvh", 16, "default, k = 16"),
];

const HEADER: &str = "\
| set, lights | sampler | ns sample | ns pmf | V mean | V median | V 99 % | bytes a light | build ms |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
";

/// The table, of all sets or of those of the given `sizes`; prints each line as it comes.
pub(super) fn table(sizes: &[String]) -> Result<String, String> {
    let mut table = HEADER.to_owned();
    for (n, name, points) in SIZES {
        if !sizes.is_empty() && !sizes.iter().any(|size| size == n) {
            continue;
        }
        for set in SETS {
            let rows = measure(set, n, points)?;
            let lines = lines(&format!("{set}, {name}"), &rows)?;
            print!("{lines}");
            table += &lines;
        }
    }
    Ok(table)
}

/// The program's answers, in the order of [`LINES`]; all trees are built on two threads.
fn measure(set: &str, n: &str, points: &str) -> Result<Vec<Value>, String> {
    let mut rows = Vec::new();
    // What is measured with the same number of samples is measured in one run, in turns.
    let mut rest = &LINES[..];
    while let Some(&(_, k, _)) = rest.first() {
        let same = rest.iter().take_while(|line| line.1 == k).count();
        let (now, later) = rest.split_at(same);
        rest = later;
        let samplers: Vec<&str> = now.iter().map(|line| line.0).collect();
        rows.extend(super::measure(&[
            "--generate",
            set,
            "--n",
            n,
            "--var-points",
            points,
            "--samplers",
            &samplers.join(","),
            "--k",
            &k.to_string(),
            "--threads",
            "2",
        ])?);
    }
    Ok(rows)
}

/// The lines of one set. Times are followed by how many times faster than the first line's they
/// are.
fn lines(set: &str, rows: &[Value]) -> Result<String, String> {
    let mut lines = String::new();
    for (i, (row, (_, k, name))) in rows.iter().zip(LINES).enumerate() {
        let time = |field: &str| -> Result<String, String> {
            let time = number(row, field)?;
            let ratio = number(&rows[0], field)? / time;
            Ok(match i {
                0 => figure(time),
                _ => format!("{} ({ratio:.1} x)", figure(time)),
            })
        };
        let own = |text: String| if k == 1 { text } else { String::new() };
        let bytes = number(row, "bytes")? / number(row, "n_lights")?;
        lines += &format!(
            "| {} | {name} | {} | {} | {} | {} | {} | {} | {} |\n",
            if i == 0 { set } else { "" },
            time("ns_sample")?,
            own(time("ns_pmf")?),
            figure(number(row, "v_mean")?),
            figure(number(row, "v_median")?),
            figure(number(row, "v_p99")?),
            own(format!("{bytes:.0}")),
            own(time("build_ms")?),
        );
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn row(time: f64) -> Value {
        json!({
            "n_lights": 100, "bytes": 3100, "ns_sample": time, "ns_pmf": time, "build_ms": time,
            "v_mean": 0.75, "v_median": 0.5, "v_p99": 12.3,
        })
    }

    #[test]
    fn ratios_are_to_the_first_line() {
        let lines = lines(
            "spots, 100",
            &[row(800.0), row(200.0), row(160.0), row(100.0)],
        )
        .expect("rows");
        let lines: Vec<&str> = lines.lines().collect();
        assert!(
            lines[0].starts_with("| spots, 100 | reference | 800 | 800 |"),
            "{}",
            lines[0]
        );
        assert!(lines[1].contains("| 200 (4.0 x) |"), "{}", lines[1]);
        assert!(
            lines[1].contains("| 0.75 | 0.50 | 12 | 31 |"),
            "{}",
            lines[1]
        );
        assert!(lines[2].ends_with("| 160 (5.0 x) |"), "{}", lines[2]);
        // One call for many lights has no build and no bytes of its own.
        assert!(lines[3].contains("| 100 (8.0 x) |  |"), "{}", lines[3]);
    }
}
