use serde_json::json;

use super::{FarmPlan, scripts};

/// A program for the Python interface of HyperQueue: it submits the tasks to the server that runs,
/// and waits for them. A task whose worker is lost is started again elsewhere.
pub(super) fn job(plan: &FarmPlan) -> String {
    let threads = plan.threads();
    let cpus = threads.map_or_else(|| "\"all\"".into(), |threads| threads.to_string());
    let groups = plan.groups().unwrap_or_default();
    let frames = match plan.frames() {
        Some(frames) => {
            let (first, last) = frames.numbers().into_inner();
            format!("[[frame] for frame in range({first}, {last} + 1)]")
        }
        None => "[[]]".into(),
    };
    // A string of JSON is one of Python.
    let text = |text: &str| json!(text).to_string();
    format!(
        "\
#!/usr/bin/env python3
\"\"\"Submits the parts of each picture to HyperQueue and waits for all of them.

Needs the package `hyperqueue`, and a server that runs (`hq server start`).
\"\"\"

from hyperqueue import Client, Job
from hyperqueue.ffi.protocol import ResourceRequest

PARTS, GROUPS, GROUP = {parts}, {groups}, {most}
# The words that name a frame to a script.
FRAMES = {frames}


def job():
    job = Job(name={name}, max_fails=0)
    machine = ResourceRequest(cpus={cpus})

    def task(script, *numbers, **options):
        words = [\"sh\", script, *map(str, numbers)]
        return job.program(words, **options)

    for frame in FRAMES:
        once = dict(resources=machine, crash_limit=20)
        parts = [task({part}, i, *frame, **once) for i in range(PARTS)]
        if GROUPS:
            members = [parts[GROUP * i : GROUP * (i + 1)] for i in range(GROUPS)]
            parts = [task({group}, i, *frame, deps=members[i]) for i in range(GROUPS)]
        task({merge}, *frame, deps=parts)
    return job


def submit(client):
    client.wait_for_jobs([client.submit(job())])


if __name__ == \"__main__\":
    submit(Client())
",
        parts = plan.parts(),
        frames = frames,
        most = FarmPlan::GROUP,
        name = text(&format!("lights {}", plan.name())),
        part = text(&plan.path(scripts::PART)),
        group = text(&plan.path(scripts::GROUP)),
        merge = text(&plan.path(scripts::MERGE)),
    )
}
