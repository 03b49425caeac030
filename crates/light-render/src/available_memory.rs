use std::fs;
use std::path::{Path, PathBuf};

/// Bytes that are assumed to be available if the system does not report them.
const ASSUMED: u64 = 8 << 30;

/// Bytes of memory that this process can still take without swapping: the least of what the machine
/// has, what is left to the process's control group and what is left of its address space. 8 GiB
/// where the system, other than Linux, does not say.
#[must_use]
pub fn available_memory() -> u64 {
    let read = |path: &str| fs::read_to_string(path).ok();
    let machine = read("/proc/meminfo").and_then(|text| of_machine(&text));
    let groups = read("/proc/self/cgroup").map(|text| group_folders(&text));
    let groups = groups.into_iter().flatten();
    let groups = groups.filter_map(|folder| {
        let read = |name: &str| fs::read_to_string(folder.join(name)).ok();
        of_group(
            &read("memory.max")?,
            &read("memory.current")?,
            &read("memory.stat")?,
        )
    });
    let addresses = || of_addresses(&read("/proc/self/limits")?, &read("/proc/self/statm")?);
    let limits = machine.into_iter().chain(groups).chain(addresses());
    limits.min().unwrap_or(ASSUMED)
}

/// The value of `/proc/meminfo`.
fn of_machine(meminfo: &str) -> Option<u64> {
    let kilobytes = after(meminfo, "MemAvailable:")?;
    kilobytes.checked_mul(1024)
}

/// The folders of the control group in `/proc/self/cgroup` and of those that it is part of.
fn group_folders(cgroup: &str) -> Vec<PathBuf> {
    let group = cgroup.lines().find_map(|line| line.strip_prefix("0::/"));
    let root = Path::new("/sys/fs/cgroup");
    let own = group.map(|group| root.join(group));
    let folders = own.iter().flat_map(|own| own.ancestors());
    let folders = folders.take_while(|folder| folder.starts_with(root));
    folders.map(Path::to_path_buf).collect()
}

/// The limit of a control group minus its use without the file cache.
fn of_group(max: &str, current: &str, stat: &str) -> Option<u64> {
    let max: u64 = max.trim().parse().ok()?;
    let used: u64 = current.trim().parse().ok()?;
    let cached = after(stat, "inactive_file").unwrap_or(0);
    Some(max.saturating_sub(used.saturating_sub(cached)))
}

/// The address space limit of `/proc/self/limits` minus the use of `/proc/self/statm`.
fn of_addresses(limits: &str, statm: &str) -> Option<u64> {
    /// Linux has larger ones on few processors; there less is counted as taken.
    const PAGE: u64 = 4096;
    let limit = after(limits, "Max address space")?;
    let pages: u64 = statm.split_whitespace().next()?.parse().ok()?;
    Some(limit.saturating_sub(pages.saturating_mul(PAGE)))
}

/// The number that follows `name` at the beginning of a line.
fn after(text: &str, name: &str) -> Option<u64> {
    let rest = text.lines().find_map(|line| line.strip_prefix(name))?;
    rest.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_machine_says_what_is_there() {
        let text = "MemTotal:       24684084 kB\nMemFree: 1 kB\nMemAvailable:   23111212 kB\n";
        assert_eq!(of_machine(text), Some(23_111_212 * 1024), "kilobytes");
        assert_eq!(of_machine("MemTotal: 5 kB\n"), None, "an old system");
        assert!(available_memory() > 1 << 20, "this machine has a megabyte");
    }

    #[test]
    fn control_groups_say_what_is_left() {
        let folders = group_folders("1:cpu:/x\n0::/a/b\n");
        let expected = ["/sys/fs/cgroup/a/b", "/sys/fs/cgroup/a", "/sys/fs/cgroup"];
        assert_eq!(folders, expected.map(PathBuf::from), "and those around");
        let stat = "anon 5\ninactive_file 300\n";
        assert_eq!(
            of_group("1000\n", "600\n", stat),
            Some(700),
            "files count as free"
        );
        assert_eq!(of_group("max\n", "600\n", stat), None, "no limit");
        assert_eq!(of_group("100\n", "600\n", ""), Some(0), "nothing left");
    }

    #[test]
    fn addresses_may_be_limited() {
        let limits =
            |soft: &str| format!("Limit Soft Hard Units\nMax address space {soft} x bytes\n");
        let of = |soft: &str| of_addresses(&limits(soft), "10 3 1\n");
        assert_eq!(of("50000"), Some(50_000 - 40_960), "less ten pages");
        assert_eq!(of("unlimited"), None, "no limit");
    }
}
