//! Engines that are packages of Python: they are installed into a folder below `target`.

use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

use crate::steps::{output, output_within, root};

use super::job::{Job, NoPicture};

/// More than any of these jobs takes.
const LIMIT: Duration = Duration::from_secs(300);

/// Runs the template.
///
/// # Errors
/// Why there is no picture.
pub(super) fn open_job_description(job: &Job) -> Result<(), NoPicture> {
    let program = environment("openjd-cli==0.8.0", "openjd")?;
    let mut command = Command::new(program);
    command.arg("run").arg(job.file("job.yaml"));
    let ran = output_within(LIMIT, job.with_program(&mut command));
    ran.map(drop).map_err(NoPicture::Failed)
}

/// Runs the job on a server and workers of its own. A worker is lost while it renders part 2, and
/// another one takes its place.
///
/// # Errors
/// Why there is no picture.
pub(super) fn hyperqueue(job: &Job) -> Result<(), NoPicture> {
    let program = environment("hyperqueue==0.27.0", "python")?;
    let cluster = root().join("xtask/src/farm/local_cluster.py");
    let mut command = Command::new(program);
    let files = [cluster, job.file("submit.py"), job.starts()];
    command.args(files).current_dir(job.folder());
    output_within(LIMIT, job.with_program(&mut command)).map_err(NoPicture::Failed)?;
    job.was_started_again()
}

/// The program `name` of an environment with `package`, which is made if it is not there.
fn environment(package: &str, name: &str) -> Result<PathBuf, NoPicture> {
    let (short, _) = package.split_once("==").unwrap_or((package, ""));
    let folder = root().join("target/tools").join(short);
    let bin = folder.join("bin");
    if !folder.join("complete").is_file() {
        println!("    installing {package} into target/tools");
        let missing = |why: String| {
            let line = why.lines().next().unwrap_or_default();
            NoPicture::NoEngine(format!("no {package}: {line}"))
        };
        output(Command::new("python3").args(["-m", "venv"]).arg(&folder)).map_err(missing)?;
        output(Command::new(bin.join("pip")).args(["install", "--quiet", package]))
            .map_err(missing)?;
        fs::write(folder.join("complete"), "").map_err(|e| NoPicture::Failed(e.to_string()))?;
    }
    Ok(bin.join(name))
}
