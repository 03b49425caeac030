//! `cargo xtask bench --table [N...]`: measures the light hierarchies side by side and writes the table of light-bvh's first page.

use std::fs;
use std::process::Command;

use serde_json::Value;

use crate::steps::{Outcome, StepResult, cargo, output, root, run};

/// The page, and the lines that the table stands between.
const PAGE: &str = "crates/light-bvh/README.md";
const BEGIN: &str = "<!-- cargo xtask bench --table -->";
const END: &str = "<!-- end of the table -->";

const SETS: [&str; 4] = ["uniform", "clusters", "spots", "mixed"];

/// Lights of a set, how the table writes that, and how many points its variance is taken over.
const SIZES: [(&str, &str, &str); 3] = [
    ("100", "100", "2048"),
    ("10000", "10 k", "512"),
    ("1000000", "1 M", "16"),
];

/// The lines of one set: each sampler by its name in the program, samples of one call, and its name in the table. All others are compared with
/// the first.
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

/// Measures all sets and writes the table; of some `sizes` only prints it.
///
/// # Errors
/// The command that failed, an answer that cannot be read, a broken law, or a page without a place for the table.
pub fn bench_table(sizes: &[String]) -> StepResult {
    run(&mut cargo([
        "build",
        "--quiet",
        "--release",
        "--package",
        "light-render",
    ]))?;
    let path = root().join(PAGE);
    let mut page = fs::read_to_string(&path).map_err(|e| format!("{PAGE}: {e}"))?;
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
    // A part of the table is for the eyes only.
    if sizes.is_empty() {
        page = replaced(&page, &table)?;
        fs::write(&path, page).map_err(|e| format!("{PAGE}: {e}"))?;
    }
    Ok(Outcome::Passed)
}

/// The program's answers, in the order of [`LINES`].
fn measure(set: &str, n: &str, points: &str) -> Result<Vec<Value>, String> {
    let program = root().join("target/release/lights");
    let mut rows = Vec::new();
    // What is measured with the same number of samples is measured in one run, in turns.
    let mut rest = &LINES[..];
    while let Some(&(_, k, _)) = rest.first() {
        let same = rest.iter().take_while(|line| line.1 == k).count();
        let (now, later) = rest.split_at(same);
        rest = later;
        let samplers: Vec<&str> = now.iter().map(|line| line.0).collect();
        let mut command = Command::new(&program);
        command
            .args(["bench", "--generate", set, "--n", n, "--var-points", points])
            .args(["--samplers", &samplers.join(","), "--k", &k.to_string()])
            .args(["--json"]);
        for line in output(&mut command)?.lines() {
            let row: Value = serde_json::from_str(line).map_err(|e| format!("{line}: {e}"))?;
            rows.push(row);
        }
    }
    Ok(rows)
}

/// The lines of one set. Times are followed by how many times faster than the first line's they are.
fn lines(set: &str, rows: &[Value]) -> Result<String, String> {
    let mut lines = String::new();
    for (i, (row, (_, k, name))) in rows.iter().zip(LINES).enumerate() {
        let number = |row: &Value, field: &str| {
            let number = row[field].as_f64();
            number.ok_or_else(|| format!("{set}, {name}: no {field}"))
        };
        for law in ["lost_energy", "pmf_mismatch", "pmf_nan"] {
            if number(row, law)? != 0.0 {
                return Err(format!("{set}, {name}: {law} is {}", row[law]));
            }
        }
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

/// Two to four digits.
fn figure(x: f64) -> String {
    match x {
        _ if x >= 10.0 => format!("{x:.0}"),
        _ if x >= 1.0 => format!("{x:.1}"),
        _ => format!("{x:.2}"),
    }
}

/// The page with another table between its marks.
fn replaced(page: &str, table: &str) -> Result<String, String> {
    let (before, rest) = page.split_once(BEGIN).ok_or("no mark before the table")?;
    let (_, after) = rest.split_once(END).ok_or("no mark after the table")?;
    Ok(format!("{before}{BEGIN}\n\n{table}\n{END}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn row(time: f64) -> Value {
        json!({
            "n_lights": 100, "bytes": 3100, "ns_sample": time, "ns_pmf": time, "build_ms": time,
            "v_mean": 0.75, "v_median": 0.5, "v_p99": 12.3,
            "lost_energy": 0.0, "pmf_mismatch": 0.0, "pmf_nan": 0.0,
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

    #[test]
    fn a_broken_law_is_no_line() {
        let mut broken = row(1.0);
        broken["lost_energy"] = json!(1e-9);
        assert!(
            lines("spots, 100", &[row(1.0), broken]).is_err(),
            "energy is lost"
        );
    }

    #[test]
    fn only_the_table_is_replaced() {
        let page = format!("a\n{BEGIN}\nold\n{END}\nb\n");
        let page = replaced(&page, "new\n").expect("marks");
        assert_eq!(
            page,
            format!("a\n{BEGIN}\n\nnew\n\n{END}\nb\n"),
            "the rest stays"
        );
        assert!(replaced("a page without marks", "new").is_err(), "no place");
    }
}
