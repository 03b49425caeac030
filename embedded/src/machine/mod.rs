//! Where the queries run, and how they print: one line a query, as `cargo xtask embedded` reads it.

#[cfg(target_os = "none")]
mod bare;
#[cfg(not(target_os = "none"))]
mod host;

#[cfg(target_os = "none")]
pub(crate) use bare::{begin, end, paint_stack, stack_used, ticks, ticks_since, write_byte};
#[cfg(not(target_os = "none"))]
pub(crate) use host::{begin, end, paint_stack, stack_used, ticks, ticks_since, write_byte};

/// Prints a line: a name, and numbers of eight hexadecimal digits.
pub(crate) fn print(name: &str, numbers: &[u32]) {
    name.bytes().for_each(write_byte);
    for &number in numbers {
        write_byte(b' ');
        let mut digits = number;
        for _ in 0..8 {
            digits = digits.rotate_left(4);
            write_byte(b"0123456789abcdef"[digits as usize & 15]);
        }
    }
    write_byte(b'\n');
}
