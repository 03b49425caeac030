//! # Source
//! `[OpenJobDescription]`, template schemas of 2023-09.

use serde_json::json;

use super::{FarmPlan, scripts};

/// Longest name of a job.
const NAME: usize = 128;

/// A job template. It is JSON, which is YAML as well.
pub(super) fn job(plan: &FarmPlan) -> String {
    let run = |script: &str, words: &[&str]| {
        let script = plan.path(script);
        let words: Vec<&str> = [&["sh", &script][..], words].concat();
        json!({ "actions": { "onRun": { "command": words[0], "args": words[1..] } } })
    };
    let numbers = |name: &str, count: u32| {
        let range = format!("0-{}", count - 1);
        let number = json!({ "name": name, "type": "INT", "range": range });
        json!({ "taskParameterDefinitions": [number] })
    };
    let mut steps = vec![json!({
        "name": "Part",
        "parameterSpace": numbers("Part", plan.parts()),
        "script": run(scripts::PART, &["{{Task.Param.Part}}"]),
    })];
    let mut last = "Part";
    if let Some(groups) = plan.groups() {
        steps.push(json!({
            "name": "Group",
            "dependencies": [{ "dependsOn": last }],
            "parameterSpace": numbers("Group", groups),
            "script": run(scripts::GROUP, &["{{Task.Param.Group}}"]),
        }));
        last = "Group";
    }
    steps.push(json!({
        "name": "Merge",
        "dependencies": [{ "dependsOn": last }],
        "script": run(scripts::MERGE, &[]),
    }));
    let name: String = format!("lights {}", plan.name())
        .chars()
        .take(NAME)
        .collect();
    let job = json!({
        "specificationVersion": "jobtemplate-2023-09",
        "name": name,
        "steps": steps,
    });
    format!("{job:#}\n")
}
