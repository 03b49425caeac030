//! `cargo xtask farm`: jobs of `lights farm`, run by each engine that this machine can have, with
//! tasks that are killed, a machine that is lost, and parts that are rendered twice. The picture
//! has the bytes of one that was rendered at once.

mod job;
mod python;
mod slurm;

use crate::steps::{Outcome, Steps, cargo, root, run};

use job::{Job, Pictures};

/// Adds a step for each engine.
pub fn add_steps(steps: &mut Steps) {
    let mut is_built = false;
    steps.run("the program", || {
        run(&mut cargo([
            "build",
            "--package",
            "light-render",
            "--bin",
            "lights",
        ]))?;
        is_built = true;
        Ok(Outcome::Passed)
    });
    if !is_built {
        return;
    }
    let folder = root().join("target/farm");
    slurm::stop_leftovers(&folder);
    for pictures in [Pictures::One, Pictures::Frames] {
        let what = pictures.name();
        steps.run(&format!("{what} by Open Job Description"), || {
            let job = Job::new(&folder, "openjd", pictures)?;
            match python::open_job_description(&job) {
                Ok(()) => job.check(),
                Err(why) => why.outcome(),
            }
        });
        steps.run(&format!("{what} by HyperQueue"), || {
            let job = Job::new(&folder, "hyperqueue", pictures)?;
            match python::hyperqueue(&job) {
                Ok(()) => job.check(),
                Err(why) => why.outcome(),
            }
        });
        steps.run(&format!("{what} by Slurm"), || {
            let job = Job::new(&folder, slurm::ENGINE, pictures)?;
            match slurm::slurm(&job) {
                Ok(()) => job.check(),
                Err(why) => why.outcome(),
            }
        });
    }
}
