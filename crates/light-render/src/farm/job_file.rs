use super::scripts;

/// The names of all files that a job may have, and how each begins, whatever the job is.
const BEGINNINGS: [(&str, &str); 6] = [
    (scripts::PART, "#!/bin/sh\n# Renders part $1 of "),
    (scripts::GROUP, "#!/bin/sh\n# Merges group $1 of "),
    (scripts::MERGE, "#!/bin/sh\n# Merges all "),
    (
        "submit.sh",
        "#!/bin/sh\n# Submits the parts of each picture to Slurm",
    ),
    (
        "submit.py",
        "#!/usr/bin/env python3\n\"\"\"Submits the parts of each picture to HyperQueue",
    ),
    ("job.yaml", "{\n  \"name\": \"lights "),
];

/// The names of all files that a job may have in its folder.
pub(crate) fn job_file_names() -> impl Iterator<Item = &'static str> {
    BEGINNINGS.into_iter().map(|(name, _)| name)
}

/// Whether `text` is what a file of this name holds in some job.
pub(crate) fn is_job_file(name: &str, text: &[u8]) -> bool {
    let mut beginnings = BEGINNINGS.into_iter();
    beginnings.any(|(known, beginning)| known == name && text.starts_with(beginning.as_bytes()))
}

#[cfg(test)]
mod tests {
    use core::num::NonZeroU32;

    use super::*;
    use crate::farm::{FarmEngine, FarmPlan};

    #[test]
    fn files_of_all_jobs_are_known() {
        let mut known = Vec::new();
        for parts in [2, FarmPlan::GROUP + 1] {
            let parts = NonZeroU32::new(parts).expect("some parts");
            let folders = ["/job", "/here"].map(String::from);
            let plan = FarmPlan::new("a", folders, vec!["a.obj".into()], (64, parts), None);
            let plan = plan.expect("a plan");
            for engine in FarmEngine::ALL {
                for (name, text) in engine.files(&plan) {
                    assert!(is_job_file(name, text.as_bytes()), "{name}: {text}");
                    known.push(name);
                }
            }
        }
        assert!(
            job_file_names().all(|name| known.contains(&name)),
            "no other"
        );
        assert!(
            !is_job_file("merge.sh", b"#!/bin/sh\necho mine\n"),
            "another's"
        );
    }
}
