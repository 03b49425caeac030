//! Every flag of every command with values from the ends of all scales: one line and status 2, or
//! it works.

use std::thread;

use crate::program::folder::{Folder, LIT, stdout};
use crate::program::watched::watch;

const VALUES: [&str; 18] = [
    "0",
    "-1",
    "1",
    "0.5",
    "1e30",
    "-1e30",
    "1e-30",
    "1e400",
    "nan",
    "inf",
    "-inf",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "18446744073709551616",
    "",
    "x",
    "\u{1F4A1}=,..:",
];

/// Flags that take one of some words, and these.
const NAMED: [(&str, &[&str]); 1] = [("--visibility", &["off", "share", "cells", "pilot"])];

/// A command, what it needs to work, and pairs of flags and values that keep it short.
struct Case {
    command: &'static [&'static str],
    /// Files, or words that represent themselves.
    operands: Vec<String>,
    flags: Vec<(&'static str, String)>,
}

/// Every command of the program that does something.
fn cases(folder: &Folder) -> Vec<Case> {
    let scene = folder.scene(LIT);
    let ies =
        "IESNA:LM-63-2002\nTILT=NONE\n1 2000 1 3 1 1 2 0 0 0\n1 1 100\n0 60 90\n0\n500 250 0\n";
    let ies = folder.file("lamp.ies", ies);
    let [picture, part, map] = ["picture.exr", "part.exr", "map.exr"].map(|n| folder.path(n));
    let size = ["--width", "4", "--height", "2"];
    stdout(&[&["render", &scene, "-o", &picture, "--spp", "1"], &size[..]].concat());
    stdout(
        &[
            &["render", &scene, "-o", &part, "--samples", "0..1"],
            &size[..],
        ]
        .concat(),
    );
    stdout(&[&["render", &scene, "-o", &map, "--spp", "1"], &size[..]].concat());
    let case = |command, operands: &[&String], flags: &[(&'static str, &str)]| Case {
        command,
        operands: operands.iter().map(|&operand| operand.clone()).collect(),
        flags: flags
            .iter()
            .map(|&(flag, value)| (flag, value.to_owned()))
            .collect(),
    };
    let small = [("--width", "4"), ("--height", "2"), ("--spp", "1")];
    let out = ("--output", "out.exr");
    let job = [("--output", "job"), ("--parts", "1"), ("--engine", "slurm")];
    let page = [
        ("--output", "page.html"),
        ("--samplers", "uniform"),
        ("--time", "0.01"),
    ];
    let set = [
        ("--generate", "uniform"),
        ("--n", "20"),
        ("--samplers", "uniform"),
    ];
    vec![
        case(&["render"], &[&scene], &[&small[..], &[out]].concat()),
        case(
            &["bench"],
            &[],
            &[&set[..], &[("--var-points", "2")]].concat(),
        ),
        case(&["compare"], &[&picture, &picture], &[]),
        case(&["completions"], &[&"man".to_owned()], &[]),
        case(&["man"], &[], &[]),
        case(
            &["env", "convert"],
            &[&map, &folder.path("converted.exr")],
            &[],
        ),
        case(&["env", "median-cut"], &[&map], &[("-n", "2")]),
        case(&["farm"], &[&scene], &[&small[..], &job].concat()),
        case(&["ies"], &[&ies], &[]),
        case(&["info"], &[&scene], &[]),
        case(&["merge"], &[&part], &[out]),
        case(&["report"], &[&scene], &[&small[..2], &page].concat()),
    ]
}

/// The names of the commands that a help text lists, or of the flags that take a value.
fn listed(help: &str, is_flag: bool) -> Vec<String> {
    let lines = help.lines().filter_map(|line| line.strip_prefix("  "));
    let words = lines.filter_map(|line| {
        let line = line.trim_start().trim_start_matches("-o, ");
        let mut words = line.split_whitespace();
        let first = words.next()?;
        if is_flag {
            let takes_value = words.next().is_some_and(|word| word.starts_with('<'));
            (first.starts_with('-') && takes_value).then(|| first.to_owned())
        } else {
            let is_name = first.chars().all(|c| c.is_ascii_lowercase() || c == '-');
            (is_name && !first.starts_with('-')).then(|| first.to_owned())
        }
    });
    words.collect()
}

/// The commands that the program's help lists, with those below them.
fn commands() -> Vec<Vec<String>> {
    let names = |help: &str| {
        let section = help.split("Commands:").nth(1).unwrap_or_default();
        let section = section
            .split("Options:")
            .next()
            .unwrap_or_default()
            .to_owned();
        let names = listed(&section, false).into_iter();
        names.filter(|name| name != "help").collect::<Vec<_>>()
    };
    let mut commands = vec![];
    for name in names(&stdout(&["--help"])) {
        let below = names(&stdout(&[&name, "--help"]));
        if below.is_empty() {
            commands.push(vec![name]);
        } else {
            commands.extend(below.into_iter().map(|second| vec![name.clone(), second]));
        }
    }
    commands
}

/// What the command needs beside the flag that is tried.
fn arguments(case: &Case, flag: &str, value: &str) -> Vec<String> {
    let mut arguments: Vec<String> = case.command.iter().map(ToString::to_string).collect();
    arguments.extend(case.operands.iter().cloned());
    let mut add = |flag: &str, value: &str| arguments.extend([flag.to_owned(), value.to_owned()]);
    let others = case.flags.iter().filter(|(other, _)| {
        let excluded = match flag {
            "--samples" => *other == "--spp",
            "--lights" | "--points" => *other == "--generate",
            _ => false,
        };
        *other != flag && !excluded
    });
    others.for_each(|(flag, value)| add(flag, value));
    match flag {
        // As many samples as fit.
        "--spp" | "--samples" if case.command != ["farm"] => add("--time", "0.05"),
        "--time" if case.command == ["report"] => add("--reference-time", "0.01"),
        "--step" => add("--integrator", "single-scattering-classic"),
        "--checkpoint-every" => add("--checkpoint", "kept.exr"),
        _ => {}
    }
    add(flag, value);
    arguments
}

#[test]
fn no_value_of_any_flag_breaks_the_program() {
    let folder = Folder::new("extremes");
    let cases = cases(&folder);
    let known: Vec<Vec<String>> = cases
        .iter()
        .map(|case| case.command.iter().map(ToString::to_string).collect())
        .collect();
    let mut listed_commands = commands();
    let mut sorted = known.clone();
    listed_commands.sort();
    sorted.sort();
    assert_eq!(listed_commands, sorted, "every command has its case");
    let (mut runs, mut works) = (vec![], vec![]);
    for case in &cases {
        let help = stdout(&[case.command, &["--help"]].concat());
        let flags = listed(&help, true);
        let taken = case
            .flags
            .iter()
            .all(|(flag, _)| flags.iter().any(|f| f == flag));
        assert!(taken, "{flags:?} has those of {:?}", case.command);
        for flag in &flags {
            runs.extend(VALUES.map(|value| arguments(case, flag, value)));
        }
        for (flag, words) in NAMED {
            if flags.iter().any(|f| f == flag) {
                let runs_of_words = words.iter().map(|word| arguments(case, flag, word));
                works.extend(runs_of_words);
            }
        }
    }
    assert_eq!(works.len(), 12, "render, farm and info by four words each");
    for run in &works {
        let words: Vec<&str> = run.iter().map(String::as_str).collect();
        watch(&folder.0, &words).assert_works(&run.join(" "));
    }
    assert!(runs.len() > 700, "many flags: {}", runs.len());
    let (first, second) = runs.split_at(runs.len() / 2);
    // The folder for outputs that are named like numbers.
    let place = &folder.0;
    let run = |runs: &[Vec<String>]| {
        for run in runs {
            let words: Vec<&str> = run.iter().map(String::as_str).collect();
            let ending = watch(place, &words);
            ending.assert_clean(&run.join(" "));
            let is_flag = words.ends_with(&["-1"]) && ending.error.contains("unexpected argument");
            assert!(!is_flag, "a number is no flag: {run:?}: {}", ending.error);
        }
    };
    thread::scope(|scope| {
        scope.spawn(|| run(first));
        scope.spawn(|| run(second));
    });
    let left = folder
        .names()
        .into_iter()
        .filter(|name| name.starts_with(".lights"));
    assert_eq!(
        left.collect::<Vec<_>>(),
        Vec::<String>::new(),
        "nothing half written"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn more_memory_than_there_is_is_refused_before_it_is_taken() {
    use crate::program::watched::watch_after;
    let folder = Folder::new("memory");
    let scene = folder.scene(LIT);
    let [out, kept, map] = ["out.exr", "kept.exr", "map.exr"].map(|name| folder.path(name));
    stdout(&[
        "render", &scene, "-o", &map, "--width", "4", "--height", "2", "--spp", "1",
    ]);
    // Addresses of two gigabytes, which threads and the program itself take a part of.
    let limited = |arguments: &[&str], words: &[&str]| {
        let ending = watch_after(&folder.0, "ulimit -v 2000000", arguments);
        ending.assert_refused(&[words, &["GB of memory", "are available"]].concat());
    };
    let render = ["render", &scene, "-o", &out, "--threads", "2", "--spp", "1"];
    let huge = ["--width", "30000", "--height", "30000"];
    limited(
        &[&render, &huge[..]].concat(),
        &["--width", "--height", "30000 x 30000"],
    );
    let large = ["--width", "4000", "--height", "4000"];
    let checkpoint = ["--checkpoint", &kept];
    limited(
        &[&render, &large[..], &checkpoint].concat(),
        &["4000 x 4000"],
    );
    limited(
        &["bench", "--generate", "uniform", "--n", "4294967295"],
        &["--n 4294967295"],
    );
    let convert = [
        "env", "convert", &map, &out, "--to", "lat-long", "--height", "16384",
    ];
    limited(&convert, &["--height", "32768 x 16384"]);
    assert_eq!(
        folder.names(),
        ["map.exr", "scene.mtl", "scene.obj"],
        "nothing is written"
    );
}
