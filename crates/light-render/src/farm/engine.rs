use core::fmt;
use core::str::FromStr;

use super::{FarmPlan, hyperqueue, openjd, scripts, slurm};

/// What runs the tasks of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FarmEngine {
    /// Slurm: a job array, and a job that depends on it.
    Slurm,
    /// HyperQueue: a graph of tasks, by its Python interface.
    HyperQueue,
    /// A template of Open Job Description, which render managers take.
    OpenJd,
}

impl FarmEngine {
    /// All engines.
    pub const ALL: [Self; 3] = [Self::Slurm, Self::HyperQueue, Self::OpenJd];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Slurm => "slurm",
            Self::HyperQueue => "hyperqueue",
            Self::OpenJd => "openjd",
        }
    }

    /// The file that holds the job, in the folder of the plan.
    #[must_use]
    pub const fn file(self) -> &'static str {
        match self {
            Self::Slurm => "submit.sh",
            Self::HyperQueue => "submit.py",
            Self::OpenJd => "job.yaml",
        }
    }

    /// The command that submits the job in `file`, a path.
    #[must_use]
    pub fn submit(self, file: &str) -> String {
        match self {
            Self::Slurm => format!("sh {file}"),
            Self::HyperQueue => format!("python3 {file}"),
            Self::OpenJd => format!("openjd run {file}"),
        }
    }

    /// The files of the job by their names in the folder of the plan, the engine's last.
    #[must_use]
    pub fn files(self, plan: &FarmPlan) -> Vec<(&'static str, String)> {
        let mut files = vec![(scripts::PART, scripts::part(plan))];
        if plan.groups().is_some() {
            files.push((scripts::GROUP, scripts::group(plan)));
        }
        files.push((scripts::MERGE, scripts::merge(plan)));
        let job = match self {
            Self::Slurm => slurm::job(plan),
            Self::HyperQueue => hyperqueue::job(plan),
            Self::OpenJd => openjd::job(plan),
        };
        files.push((self.file(), job));
        files
    }
}

impl fmt::Display for FarmEngine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for FarmEngine {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|engine| engine.name() == text);
        found.ok_or_else(|| String::from("expected slurm, hyperqueue or openjd"))
    }
}
