//! The folder of a job: a new job takes the place of an older one.

use std::fs;

use crate::program::folder::{Folder, LIT, assert_refused, stdout};

#[test]
fn a_job_leaves_no_scripts_of_an_older_one() {
    let folder = Folder::new("farm-again");
    let scene = folder.scene(LIT);
    let job = folder.path("job");
    let farm = |parts: &str, engine: &str| {
        let args = ["farm", &scene, "-o", &job, "--spp", "64"];
        stdout(&[&args[..], &["--parts", parts, "--engine", engine]].concat());
        let entries = fs::read_dir(&job).expect("a folder");
        let mut names: Vec<String> = entries
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into()
            })
            .collect();
        names.sort();
        names
    };
    let grouped = ["group.sh", "merge.sh", "part.sh", "submit.sh"];
    assert_eq!(farm("40", "slurm"), grouped, "a job");
    assert_eq!(farm("40", "slurm"), grouped, "the same again");
    let few = farm("2", "openjd");
    assert_eq!(few, ["job.yaml", "merge.sh", "part.sh"], "another engine");
    // A file of somebody else keeps its place.
    let own = folder.file("job/submit.sh", "#!/bin/sh\necho mine\n");
    folder.file("job/notes.txt", "mine");
    let few = farm("2", "hyperqueue");
    let names = ["merge.sh", "notes.txt", "part.sh", "submit.py", "submit.sh"];
    assert_eq!(few, names, "job.yaml was of the older job");
    let args = [
        "farm", &scene, "-o", &job, "--parts", "2", "--engine", "slurm",
    ];
    assert_refused(&args, &["submit.sh", "not written by `lights farm`"]);
    let kept = fs::read_to_string(own).expect("a file");
    assert!(kept.contains("mine"), "as it was: {kept}");
    assert!(
        fs::exists(folder.path("job/submit.py")).expect("known"),
        "the older job is whole"
    );
}
