use core::fmt;
use core::str::FromStr;

use super::{FarmPlan, hyperqueue, openjd, slurm};

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

    /// The text of the job.
    pub(super) fn job(self, plan: &FarmPlan) -> String {
        match self {
            Self::Slurm => slurm::job(plan),
            Self::HyperQueue => hyperqueue::job(plan),
            Self::OpenJd => openjd::job(plan),
        }
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
