//! Where the queries run, and how they print: one line a fact, as `cargo xtask embedded` reads it.

#[cfg(target_os = "none")]
mod bare;
#[cfg(not(target_os = "none"))]
mod host;

#[cfg(target_os = "none")]
pub(crate) use bare::{begin, end, paint_stack, stack_used, ticks, ticks_since, write_byte};
#[cfg(not(target_os = "none"))]
pub(crate) use host::{begin, end, paint_stack, stack_used, ticks, ticks_since, write_byte};

/// Prints the hash of the answers to a query: `hash NAME HASH`.
pub(crate) fn print_hash(name: &str, bits: u64) {
    write("hash ");
    write(name);
    write(" ");
    for shift in (0..64).step_by(4).rev() {
        write_digit((bits >> shift) as u32 & 15);
    }
    write("\n");
}

/// Prints what the answers took: `cost NAME LEAST ALL MOST STACK`, in ticks and bytes. The host has
/// no ticks.
pub(crate) fn print_cost(name: &str, ticks: [u32; 3], stack: u32) {
    if cfg!(not(target_os = "none")) {
        return;
    }
    write("cost ");
    write(name);
    for number in ticks.into_iter().chain([stack]) {
        write(" ");
        write_number(number);
    }
    write("\n");
}

fn write(text: &str) {
    text.bytes().for_each(write_byte);
}

fn write_number(number: u32) {
    if number >= 10 {
        write_number(number / 10);
    }
    write_digit(number % 10);
}

fn write_digit(digit: u32) {
    const DIGITS: &[u8; 16] = b"0123456789abcdef";
    write_byte(DIGITS[digit as usize & 15]);
}
