use super::board::BOARDS;
use super::elf::Program;
use super::report::Report;

/// A program of `embedded/` and its promises.
#[derive(Clone, Copy, Debug)]
pub(super) struct Firmware {
    pub(super) name: &'static str,
    /// The most bytes of code on each board, where a promise was made.
    pub(super) code: [Option<u32>; BOARDS.len()],
}

/// What a program did on a board.
#[derive(Debug)]
pub(super) struct Measured {
    pub(super) firmware: Firmware,
    pub(super) report: Report,
    pub(super) program: Program,
}
