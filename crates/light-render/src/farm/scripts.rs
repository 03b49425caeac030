//! What a task does, for a POSIX shell: `lights` is the program `$LIGHTS`, or the one on the path.

use super::FarmPlan;
use super::shell::{command, quoted};

pub(super) const PART: &str = "part.sh";
pub(super) const GROUP: &str = "group.sh";
pub(super) const MERGE: &str = "merge.sh";

/// The script that renders one part. A part that is there, whole and of this picture is kept, so a
/// task may be repeated; one that is killed leaves no part, and is tried three times.
pub(super) fn part(plan: &FarmPlan) -> String {
    let (samples, parts) = (plan.samples(), plan.parts());
    let threads = plan.threads();
    let threads = threads.map_or_else(String::new, |threads| format!(" --threads {threads}"));
    format!(
        "\
#!/bin/sh
# Renders part $1 of {parts}, counted from 0.
set -u
cd {folder} || exit 2
mkdir -p {all} || exit 2
start=$(({samples} * $1 / {parts}))
end=$(({samples} * ($1 + 1) / {parts}))
try=1
while :; do
    \"${{LIGHTS:-lights}}\" render {render}{threads} --quiet \\
        --samples \"$start..$end\" --skip-existing -o {all}/\"$1\".exr && exit 0
    status=$?
    # Bad input stays bad.
    if [ $status -eq 2 ] || [ $try -ge 3 ]; then exit $status; fi
    try=$((try + 1))
    sleep 1
done
",
        folder = quoted(plan.working_folder()),
        all = quoted(&plan.path("parts")),
        render = command(plan.render()),
    )
}

/// The script that merges one group of parts.
pub(super) fn group(plan: &FarmPlan) -> String {
    let (parts, most) = (plan.parts(), FarmPlan::GROUP);
    let groups = plan.groups().unwrap_or_default();
    format!(
        "\
#!/bin/sh
# Merges group $1 of {groups}, counted from 0: {most} parts, or what is left of them.
set -eu
mkdir -p {folder}
part=$(($1 * {most}))
end=$((part + {most}))
if [ $end -gt {parts} ]; then end={parts}; fi
group=$1
set --
while [ $part -lt $end ]; do
    set -- \"$@\" {all}/$part.exr
    part=$((part + 1))
done
exec \"${{LIGHTS:-lights}}\" merge \"$@\" --part -o {folder}/$group.exr
",
        folder = quoted(&plan.path("groups")),
        all = quoted(&plan.path("parts")),
    )
}

/// The script that makes the picture of all parts, or of all groups.
pub(super) fn merge(plan: &FarmPlan) -> String {
    let (what, count) = match plan.groups() {
        Some(groups) => ("groups", groups),
        None => ("parts", plan.parts()),
    };
    format!(
        "\
#!/bin/sh
# Merges all {count} {what} into the picture.
set -eu
set --
i=0
while [ $i -lt {count} ]; do
    set -- \"$@\" {all}/$i.exr
    i=$((i + 1))
done
exec \"${{LIGHTS:-lights}}\" merge \"$@\" -o {picture}
",
        all = quoted(&plan.path(what)),
        picture = quoted(&plan.path("picture.exr")),
    )
}
