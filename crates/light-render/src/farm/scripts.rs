//! What a task does, for a POSIX shell: `lights` is the program `$LIGHTS`, or the one on the path.

use super::FarmPlan;
use super::shell::quoted;

pub(super) const PART: &str = "part.sh";
pub(super) const GROUP: &str = "group.sh";
pub(super) const MERGE: &str = "merge.sh";

/// What a script says of the frames, if there are any.
struct InFrame {
    /// The end of a sentence.
    words: &'static str,
    /// Sets `$frame`; a line, or nothing.
    set: String,
    /// The folder of the frame in another one.
    folder: &'static str,
}

impl InFrame {
    fn of(plan: &FarmPlan) -> Self {
        match plan.frames() {
            Some(frames) => Self {
                words: " of frame $2",
                set: format!("{}\n", frames.set_frame()),
                folder: "/\"$frame\"",
            },
            None => Self {
                words: "",
                set: String::new(),
                folder: "",
            },
        }
    }

    /// A folder of the job that holds what belongs to the frame.
    fn folder(&self, plan: &FarmPlan, name: &str) -> String {
        quoted(&plan.path(name)) + self.folder
    }
}

/// The words of `lights render`, the scene of a frame for the pattern of all.
fn render_words(plan: &FarmPlan) -> String {
    let words = plan.render().iter().map(|word| match plan.frames() {
        Some(frames) if frames.pattern() == word => frames.word(),
        _ => quoted(word),
    });
    words.collect::<Vec<_>>().join(" ")
}

/// The script that renders one part. A part that is there, whole and of this picture is kept, so a
/// task may be repeated; one that is killed leaves no part, and is tried three times.
pub(super) fn part(plan: &FarmPlan) -> String {
    let (samples, parts) = (plan.samples(), plan.parts());
    let threads = plan.threads();
    let threads = threads.map_or_else(String::new, |threads| format!(" --threads {threads}"));
    let frame = InFrame::of(plan);
    format!(
        "\
#!/bin/sh
# Renders part $1 of {parts}{words}, counted from 0.
set -u
{set}\
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
        words = frame.words,
        set = frame.set,
        folder = quoted(plan.working_folder()),
        all = frame.folder(plan, "parts"),
        render = render_words(plan),
    )
}

/// The script that merges one group of parts.
pub(super) fn group(plan: &FarmPlan) -> String {
    let (parts, most) = (plan.parts(), FarmPlan::GROUP);
    let groups = plan.groups().unwrap_or_default();
    let frame = InFrame::of(plan);
    format!(
        "\
#!/bin/sh
# Merges group $1 of {groups}{words}, counted from 0: {most} parts, or what is left of them.
set -eu
{set}\
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
        words = frame.words,
        set = frame.set,
        folder = frame.folder(plan, "groups"),
        all = frame.folder(plan, "parts"),
    )
}

/// The script that makes the picture of all parts, or of all groups.
pub(super) fn merge(plan: &FarmPlan) -> String {
    let (what, count) = match plan.groups() {
        Some(groups) => ("groups", groups),
        None => ("parts", plan.parts()),
    };
    let frame = InFrame::of(plan);
    let picture = match plan.frames() {
        Some(_) => quoted(&plan.path("picture.")) + "\"$frame\".exr",
        None => quoted(&plan.path("picture.exr")),
    };
    // The scripts of parts and groups take the frame second.
    let set = frame.set.replace("$2", "$1");
    format!(
        "\
#!/bin/sh
# Merges all {count} {what} into the picture{words}.
set -eu
{set}\
set --
i=0
while [ $i -lt {count} ]; do
    set -- \"$@\" {all}/$i.exr
    i=$((i + 1))
done
exec \"${{LIGHTS:-lights}}\" merge \"$@\" -o {picture}
",
        words = frame.words.replace("$2", "$1"),
        all = frame.folder(plan, what),
    )
}
