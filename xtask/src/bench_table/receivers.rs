//! Who asks, and what stands between: variance against the light of whole areas.

use super::{figure, measure, number};

const SETS: [&str; 4] = ["uniform", "clusters", "spots", "mixed"];

/// Who asks, by the program's arguments and in the table's words.
const ASKERS: [(&str, &[&str]); 5] = [
    ("diffuse", &["--receiver", "diffuse"]),
    ("two-sided", &["--receiver", "two-sided"]),
    ("medium", &["--receiver", "medium"]),
    ("glossy, roughness 0.2", &["--receiver", "glossy:0.2"]),
    ("diffuse behind 64 spheres", &["--occluders", "64"]),
];

const HEADER: &str = "\
| set | who asks | reference: V mean | V median | V 99 % | default: V mean | V median | V 99 % |
| --- | --- | --- | --- | --- | --- | --- | --- |
";

/// A line a set and receiver, 10 thousand lights each.
pub(super) fn table() -> Result<String, String> {
    let mut table = HEADER.to_owned();
    for set in SETS {
        for (name, arguments) in ASKERS {
            let how = ["--generate", set, "--n", "10000", "--var-points", "512"];
            let what = ["--samplers", "bvh-reference,bvh", "--truth", "area"];
            let rows = measure(&[&how[..], &what, arguments].concat())?;
            let mut line = format!("| {set} | {name} |");
            for row in &rows {
                for field in ["v_mean", "v_median", "v_p99"] {
                    line += &format!(" {} |", figure(number(row, field)?));
                }
            }
            println!("{line}");
            table += &line;
            table.push('\n');
        }
    }
    Ok(table)
}
