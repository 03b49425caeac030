use std::sync::LazyLock;

use light_render::cli;

use super::input::Input;

/// Values, valid and not.
const VALUES: [&str; 33] = [
    "a.obj",
    "a.exr",
    "out.png",
    "-",
    "--",
    "",
    "0",
    "1",
    "-1",
    "0.5",
    "1e30",
    "1e-30",
    "NaN",
    "inf",
    "4294967295",
    "4294967296",
    "99999999999999999999",
    "64x64",
    "0x1",
    "0/4",
    "4/4",
    "0..4",
    "4..0",
    "1,2,3",
    "1,2",
    "a=b",
    "=*",
    "bvh",
    "power",
    "pbrt",
    "auto",
    "bvh,uniform,,",
    "\u{fc}\u{0}",
];

/// Words on a command line.
const MAX_WORDS: usize = 12;

/// The program parses a command line, or reports an error; it is never run.
///
/// # Panics
/// If a guarantee is violated.
pub fn command_lines(data: &[u8]) {
    static WORDS: LazyLock<Vec<String>> = LazyLock::new(cli::words);
    let mut input = Input::new(data);
    let mut words = vec!["lights".to_owned()];
    while !input.is_empty() && words.len() < MAX_WORDS {
        let kind = input.byte();
        words.push(match kind >> 6 {
            0 | 1 => WORDS[input.below(WORDS.len())].clone(),
            2 => VALUES[input.below(VALUES.len())].to_owned(),
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
