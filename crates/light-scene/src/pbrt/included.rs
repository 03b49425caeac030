/// The most files that a scene may include, repeated inclusions counted.
pub(super) const MOST_FILES: usize = 1 << 16;

/// The most bytes of text in all of them, 4 GiB.
const MOST_BYTES: u64 = 1 << 32;

/// The number of inclusions so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Included {
    files: usize,
    bytes: u64,
}

impl Included {
    /// Counts a file of so many bytes.
    pub(super) fn add(&mut self, bytes: usize) -> Result<(), String> {
        self.files += 1;
        self.bytes = self.bytes.saturating_add(bytes as u64);
        if self.files > MOST_FILES {
            return Err(format!("expected at most {MOST_FILES} included files"));
        }
        if self.bytes > MOST_BYTES {
            return Err(format!(
                "expected at most {MOST_BYTES} bytes in all included files"
            ));
        }
        Ok(())
    }
}
