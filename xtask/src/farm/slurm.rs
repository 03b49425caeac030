//! Slurm with one node, this machine: daemons of its own in a folder, from Debian's packages.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::debian::{libraries, unpacked};
use crate::steps::{is_there, output, run};

use super::job::{Job, NoPicture};

/// Debian's packages.
const PACKAGES: [&str; 4] = ["slurmctld", "slurmd", "slurm-client", "munge"];

/// The name of the engine, and of the folder of its jobs.
pub(super) const ENGINE: &str = "slurm";

/// The folder of the daemons' files, in that of a job.
const DAEMONS: &str = "daemons";

/// More than the job takes.
const LIMIT: Duration = Duration::from_secs(300);

/// Runs the job; the machine is lost while part 2 is rendered, and comes back.
///
/// # Errors
/// Why there is no picture.
pub(super) fn slurm(job: &Job) -> Result<(), NoPicture> {
    let cluster = Cluster::start(job)?;
    let failed = NoPicture::Failed;
    let mut submit = cluster.command("sh");
    submit.arg(job.file("submit.sh"));
    run(job.with_program(&mut submit)).map_err(failed)?;
    wait("part 2", || job.waits()).map_err(failed)?;
    cluster.lose_machine().map_err(failed)?;
    let mut start_now = cluster.command("sh");
    // Slurm holds what it queues again back for two minutes.
    start_now.args(["-c", START_NOW]);
    let is_done = || {
        // A job may just have ended.
        let _ = output(&mut start_now);
        job.is_done()
    };
    wait("the picture", is_done).map_err(failed)?;
    job.was_started_again()
}

/// Lets the jobs that wait for a time start.
const START_NOW: &str = "\
for job in $(squeue -h -r -o '%i %r' | sed -n 's/ BeginTime$//p'); do
    scontrol update jobid=\"$job\" starttime=now
done
";

/// The files of the service by which the daemons know each other.
const MUNGE_FILES: [&str; 5] = [
    "--key-file=key",
    "--socket=socket",
    "--pid-file=munged.pid",
    "--log-file=munged.log",
    "--seed-file=seed",
];

/// Waits until something is there.
fn wait(what: &str, mut is_there: impl FnMut() -> bool) -> Result<(), String> {
    let start = Instant::now();
    while !is_there() {
        if start.elapsed() > LIMIT {
            let seconds = LIMIT.as_secs();
            return Err(format!("slurm: {what} is not there after {seconds} s"));
        }
        sleep(Duration::from_millis(200));
    }
    Ok(())
}

/// The daemons; they end with it.
struct Cluster {
    /// Their files.
    folder: PathBuf,
    /// Their programs, if they are not on the path.
    programs: Option<PathBuf>,
    host: String,
}

impl Cluster {
    fn start(job: &Job) -> Result<Self, NoPicture> {
        let missing = |why: String| {
            let line = why.lines().next().unwrap_or_default();
            NoPicture::NoEngine(format!("no Slurm: {line}"))
        };
        let programs = if is_there_as("slurmctld", "-V") && is_there("munged") {
            None
        } else {
            let packages = PACKAGES.map(String::from);
            Some(unpacked("slurm", &packages).map_err(missing)?)
        };
        let host = output(&mut Command::new("hostname")).map_err(missing)?;
        let cluster = Self {
            folder: job.folder().join(DAEMONS),
            programs,
            host: host.trim().to_owned(),
        };
        cluster
            .configure()
            .map_err(|e| NoPicture::Failed(e.to_string()))?;
        let mut munged = cluster.command("munged");
        munged.arg("--force").args(MUNGE_FILES);
        for mut daemon in [munged, cluster.daemon("slurmctld"), cluster.slurmd()] {
            output(&mut daemon).map_err(missing)?;
        }
        let is_up = || {
            let nodes = output(cluster.command("sinfo").args(["-h", "-o", "%T"]));
            nodes.is_ok_and(|state| state.trim() == "idle")
        };
        wait("a node", is_up).map_err(missing)?;
        Ok(cluster)
    }

    /// Writes the files of the daemons.
    fn configure(&self) -> std::io::Result<()> {
        for name in ["state", "spool"] {
            fs::create_dir_all(self.folder.join(name))?;
        }
        let key = self.folder.join("key");
        // Nobody else is on this cluster.
        fs::write(&key, [7; 64])?;
        let _ = run(Command::new("chmod").arg("600").arg(&key));
        fs::write(self.folder.join("slurm.conf"), self.configuration())
    }

    fn configuration(&self) -> String {
        let (host, folder) = (&self.host, self.folder.display());
        let plugins = self.programs.as_ref().map_or_else(String::new, |programs| {
            let folder = plugins(programs);
            format!("PluginDir={}\n", folder.display())
        });
        format!(
            "\
{plugins}\
ClusterName=farm
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/socket
CryptoType=crypto/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SchedulerType=sched/builtin
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"
        )
    }

    /// A daemon of Slurm. Debian's packages have them under other names than an installation.
    fn daemon(&self, name: &str) -> Command {
        let suffix = if self.programs.is_some() { "-wlm" } else { "" };
        self.command(&format!("{name}{suffix}"))
    }

    /// The daemon of the node.
    fn slurmd(&self) -> Command {
        let mut slurmd = self.daemon("slurmd");
        if let Some(folder) = &self.programs {
            slurmd.arg("-d").arg(folder.join("usr/sbin/slurmstepd-wlm"));
        }
        slurmd
    }

    /// A command that finds the daemons and their programs.
    fn command(&self, program: &str) -> Command {
        let path = std::env::var("PATH").unwrap_or_default();
        // `env` looks for the program on the path that it is given.
        let mut command = Command::new("env");
        if let Some(folder) = &self.programs {
            let bin = ["usr/sbin", "usr/bin"].map(|bin| folder.join(bin).display().to_string());
            command.env("PATH", format!("{}:{path}", bin.join(":")));
            let own = plugins(folder).display().to_string();
            command.env("LD_LIBRARY_PATH", format!("{own}:{}", libraries(folder)));
        } else {
            command.env("PATH", format!("/usr/sbin:{path}"));
        }
        command.arg(program);
        command.current_dir(&self.folder);
        command.env("SLURM_CONF", self.folder.join("slurm.conf"));
        command
    }

    /// Kills what runs on the machine, as a loss of power does, and starts it again.
    fn lose_machine(&self) -> Result<(), String> {
        let folder = self.folder.parent().unwrap_or(&self.folder);
        run(self.command("sh").args(["-c", KILL_ALL, "sh"]).arg(folder))?;
        let name = format!("nodename={}", self.host);
        let words = ["update", &name, "state=down", "reason=lost"];
        run(self.command("scontrol").args(words))?;
        run(&mut self.slurmd())
    }
}

/// Kills what has the folder `$1` in its words, the daemons of Slurm that wait for it, and the one
/// of the node, and clears what it left, as a start of the machine does.
const KILL_ALL: &str = "\
tasks=$(pgrep -f \"$1/job\")
list=$(echo $tasks | tr ' ' ,)
for parent in $(ps -o ppid= -p \"$list\" | sort -u); do
    case $(ps -o comm= -p \"$parent\") in slurmstepd*) waiting=\"${waiting-} $parent\" ;; esac
done
kill -9 $(cat slurmd.pid) $waiting $tasks
rm -rf spool/job*
";

impl Drop for Cluster {
    fn drop(&mut self) {
        stop_daemons(&self.folder);
    }
}

/// Stops the daemons that a run which was interrupted left behind: they hold the ports of the next.
pub(super) fn stop_leftovers(farm: &Path) {
    for job in fs::read_dir(farm.join(ENGINE))
        .into_iter()
        .flatten()
        .flatten()
    {
        stop_daemons(&job.path().join(DAEMONS));
    }
}

/// Stops the daemons whose files are in `folder`.
fn stop_daemons(folder: &Path) {
    for daemon in ["slurmd", "slurmctld", "munged"] {
        let Ok(id) = fs::read_to_string(folder.join(format!("{daemon}.pid"))) else {
            continue;
        };
        let id = id.trim();
        // It may have ended, and the number may be that of another program.
        let name = output(Command::new("ps").args(["-o", "comm=", "-p", id]));
        if name.is_ok_and(|name| name.starts_with(daemon)) {
            let _ = output(Command::new("kill").arg(id));
        }
    }
}

/// Whether a program answers to `flag`.
fn is_there_as(program: &str, flag: &str) -> bool {
    output(Command::new(program).arg(flag)).is_ok()
}

/// The folder of Slurm's plugins in unpacked packages.
fn plugins(folder: &Path) -> PathBuf {
    let found = output(
        Command::new("find")
            .arg(folder)
            .args(["-name", "slurm-wlm", "-type", "d"]),
    );
    let found = found.unwrap_or_default();
    let of_libraries = found.lines().find(|line| line.contains("/lib/"));
    PathBuf::from(of_libraries.unwrap_or_default())
}
