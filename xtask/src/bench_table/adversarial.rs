//! Sets that break hierarchies: how deep they grow, and that no light is lost.

use super::{figure, measure, number};

const SETS: [&str; 5] = ["one-point", "line", "nested", "large-world", "magnitudes"];

const HEADER: &str = "\
| set | sampler | depth | bytes a light | build ms | V median | energy lost | pmf mismatches | NaN | sum above 1 |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
";

/// A line a set and hierarchy, a million lights each.
pub(super) fn table() -> Result<String, String> {
    let mut table = HEADER.to_owned();
    for set in SETS {
        let how = ["--generate", set, "--n", "1000000", "--var-points", "16"];
        let what = ["--samplers", "bvh-reference,bvh,bvh-morton"];
        for (row, name) in
            measure(&[&how[..], &what].concat())?
                .iter()
                .zip(["reference", "default", "fast build"])
        {
            let excess = match number(row, "pmf_sum_max_error")? {
                0.0 => "0".to_owned(),
                rounding => format!("{rounding:.0e}"),
            };
            let line = format!(
                "| {set} | {name} | {} | {:.0} | {} | {} | {} | {} | {} | {excess} |",
                number(row, "depth")?,
                number(row, "bytes")? / number(row, "n_lights")?,
                figure(number(row, "build_ms")?),
                figure(number(row, "v_median")?),
                number(row, "lost_energy")?,
                number(row, "pmf_mismatch")?,
                number(row, "pmf_nan")?,
            );
            println!("{line}");
            table += &line;
            table.push('\n');
        }
    }
    Ok(table)
}
