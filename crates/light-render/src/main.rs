//! The program `lights`.
fn main() {}
