use crate::available_memory::available_memory;
use crate::{Film, VisibilityCells};

use super::failure::Failure;

/// Bytes per pixel of a picture: the film, what it shows, what a screen shows of that, and the
/// file.
pub(crate) const PICTURE: u64 = Film::BYTES_PER_PIXEL + 40;

/// Makes sure that `bytes` of memory are available before they are allocated. `what` needs them:
/// the words name the flags that set it.
///
/// # Errors
/// When there is less, with both figures.
pub(crate) fn check_memory(what: &str, bytes: u64) -> Result<(), Failure> {
    fits(what, bytes, available_memory())
}

/// Makes sure that the cells of visibility of a picture of so many pixels fit into memory while
/// they are filled.
///
/// # Errors
/// When they do not.
pub(super) fn check_cells_memory(width: u32, height: u32) -> Result<(), Failure> {
    let pixels = u64::from(width) * u64::from(height);
    let what = format!("cells of {width} x {height} pixels (--visibility, --width, --height)");
    check_memory(&what, pixels * VisibilityCells::MAX_BYTES_PER_PIXEL)
}

fn fits(what: &str, bytes: u64, available: u64) -> Result<(), Failure> {
    if bytes <= available {
        return Ok(());
    }
    let gigabytes = |bytes: u64| bytes as f64 * 1e-9;
    Err(Failure::Input(format!(
        "{what}: needs {:.1} GB of memory, {:.1} GB are available",
        gigabytes(bytes),
        gigabytes(available)
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_much_is_refused_with_both_figures() {
        assert_eq!(fits("--width 9", 4, 4), Ok(()), "it fits");
        let expected = "--width 9: needs 43.2 GB of memory, 8.6 GB are available";
        let refused = fits("--width 9", 43_200_000_000, 1 << 33);
        assert_eq!(refused, Err(Failure::Input(expected.into())), "the line");
        assert_eq!(check_memory("nothing", 0), Ok(()), "nothing is there");
        assert!(check_memory("all", u64::MAX).is_err(), "but not everything");
    }
}
