use light_render::cli;

use super::input::Input;

/// Words that the program knows, and invalid values.
const WORDS: [&str; 64] = [
    "bench",
    "compare",
    "env",
    "ies",
    "info",
    "merge",
    "render",
    "convert",
    "median-cut",
    "regions",
    "demo",
    "help",
    "--help",
    "--version",
    "-o",
    "--output",
    "--width",
    "--height",
    "--samples",
    "--spp",
    "--seed",
    "--time",
    "--threads",
    "--checkpoint",
    "--checkpoint-every",
    "--sampler",
    "--integrator",
    "--light",
    "--depth",
    "--exposure",
    "--write",
    "--n",
    "--count",
    "--size",
    "--camera",
    "--look-at",
    "--fov",
    "--up",
    "--step",
    "--strategy",
    "--tone-map",
    "--reference",
    "a.obj",
    "a.exr",
    "out.png",
    "-",
    "--",
    "",
    "0",
    "1",
    "-1",
    "1e30",
    "1e-30",
    "NaN",
    "inf",
    "4294967295",
    "4294967296",
    "99999999999999999999",
    "0..4",
    "4..0",
    "1,2,3",
    "1,2",
    "bvh",
    "\u{fc}\u{0}",
];

/// Words on a command line.
const MAX_WORDS: usize = 12;

/// The program parses a command line, or reports an error; it is never run.
///
/// # Panics
/// If a guarantee is violated.
pub fn command_lines(data: &[u8]) {
    let mut input = Input::new(data);
    let mut words = vec!["lights".to_owned()];
    while !input.is_empty() && words.len() < MAX_WORDS {
        let kind = input.byte();
        words.push(match kind >> 6 {
            0..=2 => WORDS[usize::from(kind & 63)].to_owned(),
            _ => match kind & 3 {
                0 => input.f32().to_string(),
                1 => input.u32().to_string(),
                2 => format!("--{}", char::from(input.byte())),
                _ => char::from(input.byte()).to_string().repeat(input.below(9)),
            },
        });
    }
    if let Err(message) = cli::parse(&words) {
        assert!(!message.trim().is_empty(), "no reason for {words:?}");
    }
}
