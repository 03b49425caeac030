use core::sync::atomic::{AtomicU8, Ordering};

use light_scene::exit_without_outputs;

use super::stdout::complain;

/// The conventional exit status of an interrupted program.
pub(super) const INTERRUPTED: u8 = 130;

/// What the program does when it is asked to end.
static STATE: AtomicU8 = AtomicU8::new(AT_ONCE);

/// It ends, and leaves nothing half written.
const AT_ONCE: u8 = 0;
/// A rendering will stop and write what there is.
const GENTLY: u8 = 1;
/// It was asked to.
const ASKED: u8 = 2;

/// Ends the program when somebody presses Ctrl-C, or asks by a signal.
pub(super) fn listen() {
    // Without a handler the process would end as well, but leave what it is writing.
    drop(ctrlc::set_handler(|| {
        let swap = STATE.compare_exchange(GENTLY, ASKED, Ordering::Relaxed, Ordering::Relaxed);
        if swap.is_err() {
            exit_without_outputs(INTERRUPTED.into());
        }
        complain(format_args!(
            "stopping after this pass over the picture; once more to stop at once"
        ));
    }));
}

/// While this lives, the first request to end is for the rendering to answer.
#[derive(Debug)]
pub(super) struct GentleStop(());

impl GentleStop {
    pub(super) fn begin() -> Self {
        STATE.store(GENTLY, Ordering::Relaxed);
        Self(())
    }

    /// Whether somebody has asked.
    pub(super) fn is_asked(&self) -> bool {
        STATE.load(Ordering::Relaxed) == ASKED
    }
}

impl Drop for GentleStop {
    fn drop(&mut self) {
        STATE.store(AT_ONCE, Ordering::Relaxed);
    }
}
