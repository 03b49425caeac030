use super::shell::quoted;
use super::{FarmPlan, scripts};

/// A script that submits the parts as an array of jobs, and behind them the merge.
pub(super) fn job(plan: &FarmPlan) -> String {
    let threads = plan.threads();
    let machine = threads.map_or_else(
        || "--exclusive".into(),
        |threads| format!("--cpus-per-task={threads}"),
    );
    // Behind what a task runs: the number of its frame, which the loop over them knows.
    let frame = plan.frames().map_or("", |_| "\" $frame\"");
    let array = |script: &str| {
        let script = quoted(&plan.path(script));
        quoted(&format!("exec sh {script} \"$SLURM_ARRAY_TASK_ID\"")) + frame
    };
    let groups = plan.groups().map_or_else(String::new, |groups| {
        format!(
            "\
last=$(submit --job-name=lights-group --array=0-{last} --dependency=afterok:\"$last\" \\
    --wrap {script})
",
            last = groups - 1,
            script = array(scripts::GROUP),
        )
    });
    let [each_frame, of_frame, next_frame] = match plan.frames() {
        Some(frames) => {
            let (first, last) = frames.numbers().into_inner();
            [
                format!("frame={first}\nwhile [ $frame -le {last} ]; do\n"),
                " of frame $frame".into(),
                "frame=$((frame + 1))\ndone\n".into(),
            ]
        }
        None => Default::default(),
    };
    format!(
        "\
#!/bin/sh
# Submits the parts of each picture to Slurm, and the merge behind them. Jobs of machines that fail are
# queued again. Words of the command line go to every sbatch, such as --partition=NAME.
set -eu
cd {folder}
mkdir -p logs
options=$*
submit() {{
    # Options are words without blanks.
    # shellcheck disable=SC2086
    sbatch --parsable --requeue --output=logs/%x-%A-%a.log $options \"$@\"
}}
{each_frame}\
last=$(submit --job-name=lights-part --array=0-{last} {machine} \\
    --wrap {part})
{groups}\
last=$(submit --job-name=lights-merge --dependency=afterok:\"$last\" \\
    --wrap {merge})
echo \"job $last makes the picture{of_frame}\"
{next_frame}\
",
        folder = quoted(&plan.path("")),
        last = plan.parts() - 1,
        part = array(scripts::PART),
        merge = quoted(&format!("exec sh {}", quoted(&plan.path(scripts::MERGE)))) + frame,
    )
}
