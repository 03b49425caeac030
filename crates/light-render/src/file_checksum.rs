use core::fmt::Write;

use sha2::{Digest, Sha256};

/// The attribute of a file with its checksum.
pub(crate) const CHECKSUM: &str = "lights.checksum";

/// Placeholder of the checksum while it is computed.
pub(crate) const NO_CHECKSUM: &str =
    "0000000000000000000000000000000000000000000000000000000000000000";

/// Replaces [`NO_CHECKSUM`] in the attribute [`CHECKSUM`] of an OpenEXR file by the SHA-256 of all
/// bytes; `false` if there is no such attribute.
pub(crate) fn seal(bytes: &mut [u8]) -> bool {
    let Some(start) = find(bytes) else {
        return false;
    };
    let checksum = hex(&Sha256::digest(&*bytes));
    bytes[start..][..checksum.len()].copy_from_slice(checksum.as_bytes());
    true
}

/// Whether all bytes are those that were [sealed](seal); `None` if the file has no checksum.
pub(crate) fn is_whole(bytes: &[u8]) -> Option<bool> {
    let start = find(bytes)?;
    let (before, from) = bytes.split_at(start);
    let (checksum, after) = from.split_at(NO_CHECKSUM.len());
    let digest = Sha256::new()
        .chain_update(before)
        .chain_update(NO_CHECKSUM)
        .chain_update(after);
    Some(hex(&digest.finalize()).as_bytes() == checksum)
}

/// Where the checksum begins.
fn find(bytes: &[u8]) -> Option<usize> {
    // Name, type and length, as in every attribute of a header; text is not compressed.
    let attribute = [CHECKSUM.as_bytes(), b"\0string\0", &[64, 0, 0, 0]].concat();
    let all = bytes.windows(attribute.len());
    let start = all.into_iter().position(|bytes| bytes == attribute)? + attribute.len();
    (start + NO_CHECKSUM.len() <= bytes.len()).then_some(start)
}

/// Two hexadecimal digits per byte.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string does not fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sealed_file_is_whole_until_a_bit_flips() {
        let note = [b"lights.checksum\0string\0", &[64, 0, 0, 0][..]].concat();
        let mut bytes = [b"head", &note[..], NO_CHECKSUM.as_bytes(), b"tail"].concat();
        assert_eq!(is_whole(&bytes), Some(false), "not yet");
        assert!(seal(&mut bytes), "there is room for it");
        assert_eq!(is_whole(&bytes), Some(true), "sealed");
        for bit in 0..8 * bytes.len() {
            let mut broken = bytes.clone();
            broken[bit / 8] ^= 1 << (bit % 8);
            assert_ne!(is_whole(&broken), Some(true), "bit {bit}");
        }
        assert_eq!(is_whole(&bytes[..note.len() + 20]), None, "cut off");
        assert!(!seal(&mut [0; 9]), "no room");
    }
}
