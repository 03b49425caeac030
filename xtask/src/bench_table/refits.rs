//! Refits of lights that move, against builds for where they are.

use super::{figure, measure, number};

const SETS: [&str; 2] = ["uniform", "clusters"];

const HEADER: &str = "\
| set | moved by | degradation | refit: V mean | V 99 % | built anew: V mean | V 99 % |
| --- | --- | --- | --- | --- | --- | --- |
";

/// A line a set and step, 10 thousand lights each.
pub(super) fn table() -> Result<String, String> {
    let mut table = HEADER.to_owned();
    for set in SETS {
        let how = ["--generate", set, "--n", "10000", "--var-points", "512"];
        for row in measure(&[&how[..], &["--samplers", "bvh", "--refits", "8"]].concat())? {
            let mut line = format!(
                "| {set} | {} | {:.2} |",
                number(&row, "moved")?,
                number(&row, "degradation_ratio")?
            );
            for field in ["v_mean", "v_p99", "v_mean_built_anew", "v_p99_built_anew"] {
                line += &format!(" {} |", figure(number(&row, field)?));
            }
            println!("{line}");
            table += &line;
            table.push('\n');
        }
    }
    Ok(table)
}
