/// The most files that a scene may include, repeated inclusions counted.
pub(super) const MOST_FILES: usize = 1 << 16;

/// The most bytes of text in all of them, 4 GiB.
const MOST_BYTES: u64 = 1 << 32;

/// The most bytes of all compressed meshes when they are unpacked, repeated ones counted, 8 GiB.
/// Tests use a smaller limit.
const MOST_UNPACKED: u64 = if cfg!(test) { 1 << 20 } else { 1 << 33 };

/// The number of inclusions so far, and of the bytes that they and compressed meshes took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Included {
    files: usize,
    bytes: u64,
    unpacked: u64,
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

    /// Counts a compressed mesh of so many unpacked bytes.
    pub(super) fn add_unpacked(&mut self, bytes: usize) -> Result<(), String> {
        self.unpacked = self.unpacked.saturating_add(bytes as u64);
        if self.unpacked > MOST_UNPACKED {
            return Err(format!(
                "expected at most {MOST_UNPACKED} bytes in all compressed meshes together"
            ));
        }
        Ok(())
    }
}
