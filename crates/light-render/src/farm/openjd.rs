//! # Source
//! `[OpenJobDescription]`, template schemas of 2023-09.

use serde_json::json;

use super::{FarmPlan, scripts};

/// Longest name of a job.
const NAME: usize = 128;

/// A job template. It is JSON, which is YAML as well.
pub(super) fn job(plan: &FarmPlan) -> String {
    let run = |script: &str, words: Vec<&str>| {
        let script = plan.path(script);
        let words: Vec<&str> = ["sh", &script].into_iter().chain(words).collect();
        json!({ "actions": { "onRun": { "command": words[0], "args": words[1..] } } })
    };
    let number = |name: &str, first: u32, last: u32| {
        let range = format!("{first}-{last}");
        json!({ "name": name, "type": "INT", "range": range })
    };
    let frame = plan.frames().map(|frames| {
        let (first, last) = frames.numbers().into_inner();
        number("Frame", first, last)
    });
    let numbers = |name: &str, count: u32| {
        let numbers = frame.iter().cloned().chain([number(name, 0, count - 1)]);
        json!({ "taskParameterDefinitions": numbers.collect::<Vec<_>>() })
    };
    let of_frame = frame.as_ref().map(|_| "{{Task.Param.Frame}}");
    let words = |number: &'static str| [Some(number), of_frame].into_iter().flatten();
    let mut steps = vec![json!({
        "name": "Part",
        "parameterSpace": numbers("Part", plan.parts()),
        "script": run(scripts::PART, words("{{Task.Param.Part}}").collect()),
    })];
    let mut last = "Part";
    if let Some(groups) = plan.groups() {
        steps.push(json!({
            "name": "Group",
            "dependencies": [{ "dependsOn": last }],
            "parameterSpace": numbers("Group", groups),
            "script": run(scripts::GROUP, words("{{Task.Param.Group}}").collect()),
        }));
        last = "Group";
    }
    let mut merge = json!({
        "name": "Merge",
        "dependencies": [{ "dependsOn": last }],
        "script": run(scripts::MERGE, of_frame.into_iter().collect()),
    });
    if let Some(frame) = &frame {
        merge["parameterSpace"] = json!({ "taskParameterDefinitions": [frame] });
    }
    steps.push(merge);
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
