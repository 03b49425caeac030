use serde_json::json;

use super::{FarmPlan, scripts};

/// A program for the Python interface of HyperQueue: it submits the tasks to the server that runs,
/// and waits for them. A task whose worker is lost is started again elsewhere.
pub(super) fn job(plan: &FarmPlan) -> String {
    let threads = plan.threads();
    let cpus = threads.map_or_else(|| "\"all\"".into(), |threads| threads.to_string());
    let groups = plan.groups().unwrap_or_default();
    // A string of JSON is one of Python.
    let text = |text: &str| json!(text).to_string();
    format!(
        "\
#!/usr/bin/env python3
\"\"\"Submits the parts of a picture to HyperQueue and waits for the picture.

Needs the package `hyperqueue`, and a server that runs (`hq server start`).
\"\"\"

from hyperqueue import Client, Job
from hyperqueue.ffi.protocol import ResourceRequest

PARTS, GROUPS, GROUP = {parts}, {groups}, {most}


def job():
    job = Job(name={name}, max_fails=0)
    machine = ResourceRequest(cpus={cpus})

    def task(script, *numbers, **options):
        words = [\"sh\", script, *map(str, numbers)]
        return job.program(words, **options)

    parts = [task({part}, i, resources=machine, crash_limit=20) for i in range(PARTS)]
    if GROUPS:
        members = [parts[GROUP * i : GROUP * (i + 1)] for i in range(GROUPS)]
        parts = [task({group}, i, deps=members[i]) for i in range(GROUPS)]
    task({merge}, deps=parts)
    return job


def submit(client):
    client.wait_for_jobs([client.submit(job())])


if __name__ == \"__main__\":
    submit(Client())
",
        parts = plan.parts(),
        most = FarmPlan::GROUP,
        name = text(&format!("lights {}", plan.name())),
        part = text(&plan.path(scripts::PART)),
        group = text(&plan.path(scripts::GROUP)),
        merge = text(&plan.path(scripts::MERGE)),
    )
}
