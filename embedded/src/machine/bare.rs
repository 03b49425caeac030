//! A machine without an operating system, in an emulator: start, counter, stack, and the host's
//! console by semihosting. The only file with `unsafe` code.

#![allow(unsafe_code, reason = "a bare machine is reached by addresses alone")]

use core::arch::{asm, global_asm};
use core::panic::PanicInfo;
use core::ptr;

/// Makes the function that the start code calls.
#[macro_export]
macro_rules! entry {
    ($queries:path) => {
        #[allow(unsafe_code, reason = "the start code finds it by its name")]
        // SAFETY: nothing else has this name.
        #[unsafe(no_mangle)]
        extern "C" fn bare_main() {
            $queries();
        }
    };
}

// The first words of flash are the top of the stack, the start, and handlers of faults. The float
// unit is off until its two coprocessors are allowed.
#[cfg(target_arch = "arm")]
global_asm!(
    r#"
    .syntax unified
    .section .start, "ax", %progbits
    .word bare_stack_top
    .word bare_start
    .rept 14
    .word bare_on_fault
    .endr
    .thumb_func
    bare_start:
        ldr r0, =0xe000ed88
        ldr r1, [r0]
        orr r1, r1, #0xf00000
        str r1, [r0]
        dsb
        isb
        bl bare_main
    .thumb_func
    bare_on_fault:
        bl bare_fault
    "#
);

// The machine starts at the first word.
#[cfg(target_arch = "riscv32")]
global_asm!(
    r#"
    .section .start, "ax", %progbits
    bare_start:
        la sp, bare_stack_top
        la t0, bare_on_fault
        csrw mtvec, t0
        call bare_main
    .balign 4
    bare_on_fault:
        call bare_fault
    "#
);

unsafe extern "C" {
    /// The lowest word of the stack; only its address means something.
    static mut bare_stack_bottom: u32;
    /// The end of the stack; only its address means something.
    static bare_stack_top: u32;
}

/// The operations of semihosting that are used here.
#[derive(Clone, Copy)]
enum Operation {
    /// Writes the character at the address of its argument.
    WriteCharacter = 0x03,
    /// Ends the emulator, for the reason of its argument.
    Exit = 0x18,
}

/// The reason of a program that did what it should; for any other one the emulator fails.
const DONE: usize = 0x2_0026;
/// The reason of a fault.
const FAULT: usize = 0x2_0023;

// One function for all callers: the instructions take up to 32 bytes.
#[inline(never)]
fn call_host(operation: Operation, argument: usize) {
    // SAFETY: the emulator stops at this instruction, reads what the argument points at, and goes
    // on; it writes one register. The argument is an address of a static or of a live variable, or
    // a number, as the operation wants it.
    #[cfg(target_arch = "arm")]
    unsafe {
        asm!("bkpt 0xab", inout("r0") operation as usize => _, in("r1") argument);
    }
    // SAFETY: as above.
    #[cfg(target_arch = "riscv32")]
    unsafe {
        asm!(
            ".balign 16",
            ".option push",
            ".option norvc",
            "slli x0, x0, 0x1f",
            "ebreak",
            "srai x0, x0, 7",
            ".option pop",
            inout("a0") operation as usize => _,
            in("a1") argument,
        );
    }
}

#[inline(never)]
pub(crate) fn write_byte(byte: u8) {
    call_host(Operation::WriteCharacter, ptr::from_ref(&byte).addr());
}

/// Starts the counter.
pub(crate) fn begin() {
    // SAFETY: registers of the timer that every Cortex-M4 has; nothing else uses it. It counts down
    // from its largest value, by the processor's clock.
    #[cfg(target_arch = "arm")]
    unsafe {
        timer(4).write_volatile(TIMER_MASK);
        timer(8).write_volatile(0);
        timer(0).write_volatile(5);
    }
}

/// Ends the program.
pub(crate) fn end() {
    call_host(Operation::Exit, DONE);
}

#[cfg(target_arch = "arm")]
const TIMER_MASK: u32 = 0xff_ffff;

#[cfg(target_arch = "arm")]
const fn timer(offset: usize) -> *mut u32 {
    ptr::without_provenance_mut(0xe000_e010 + offset)
}

/// The counter, which the emulator advances by instructions.
pub(crate) fn ticks() -> u32 {
    // SAFETY: as in `begin`.
    #[cfg(target_arch = "arm")]
    unsafe {
        timer(8).read_volatile()
    }
    #[cfg(target_arch = "riscv32")]
    {
        let ticks: u32;
        // SAFETY: reads the count of instructions.
        unsafe { asm!("csrr {}, minstret", out(reg) ticks) };
        ticks
    }
}

pub(crate) fn ticks_since(start: u32) -> u32 {
    #[cfg(target_arch = "arm")]
    {
        start.wrapping_sub(ticks()) & TIMER_MASK
    }
    #[cfg(target_arch = "riscv32")]
    {
        ticks().wrapping_sub(start)
    }
}

/// A word that no query leaves on the stack by chance.
const PAINT: u32 = 0x7ea5_e1ab;

/// Paints the part of the stack that is not in use.
#[inline(never)]
pub(crate) fn paint_stack() {
    let end: usize;
    // SAFETY: reads the stack pointer.
    unsafe {
        #[cfg(target_arch = "arm")]
        asm!("mov {}, sp", out(reg) end);
        #[cfg(target_arch = "riscv32")]
        asm!("mv {}, sp", out(reg) end);
    }
    let mut word = &raw mut bare_stack_bottom;
    while word.addr() < end {
        // SAFETY: the word is between the bottom of the stack and its pointer, where nothing is.
        unsafe {
            word.write_volatile(PAINT);
            word = word.add(1);
        }
    }
}

/// The most bytes of stack that were in use since it was painted.
pub(crate) fn stack_used() -> u32 {
    let mut word = &raw mut bare_stack_bottom;
    let top = (&raw const bare_stack_top).addr();
    // SAFETY: the words from the bottom of the stack to its top are memory.
    while word.addr() < top && unsafe { word.read_volatile() } == PAINT {
        // SAFETY: at most the end of the stack.
        word = unsafe { word.add(1) };
    }
    (top - word.addr()) as u32
}

// SAFETY: nothing else has this name.
#[unsafe(no_mangle)]
extern "C" fn bare_fault() -> ! {
    stop(b'F')
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    stop(b'P')
}

/// Ends the emulator as failed, with `F` for a fault of the processor or `P` for a panic.
fn stop(reason: u8) -> ! {
    write_byte(reason);
    loop {
        call_host(Operation::Exit, FAULT);
    }
}
