use super::shell::quoted;
use super::{FarmPlan, scripts};

/// A script that submits the parts as an array of jobs, and behind them the merge.
pub(super) fn job(plan: &FarmPlan) -> String {
    let threads = plan.threads();
    let machine = threads.map_or_else(
        || "--exclusive".into(),
        |threads| format!("--cpus-per-task={threads}"),
    );
    let array = |script: &str| {
        let script = quoted(&plan.path(script));
        quoted(&format!("exec sh {script} \"$SLURM_ARRAY_TASK_ID\""))
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
    format!(
        "\
#!/bin/sh
# Submits the parts of a picture to Slurm, and the merge behind them. Jobs of machines that fail are
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
last=$(submit --job-name=lights-part --array=0-{last} {machine} \\
    --wrap {part})
{groups}\
last=$(submit --job-name=lights-merge --dependency=afterok:\"$last\" \\
    --wrap {merge})
echo \"job $last makes the picture\"
",
        folder = quoted(&plan.path("")),
        last = plan.parts() - 1,
        part = array(scripts::PART),
        merge = quoted(&format!("exec sh {}", quoted(&plan.path(scripts::MERGE)))),
    )
}
