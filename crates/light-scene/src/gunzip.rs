use alloc::borrow::Cow;
use std::io::Read;
use std::path::Path;

use flate2::read::MultiGzDecoder;

use crate::Diagnostic;

/// The largest decompressed size, 2 GiB.
const MOST_BYTES: usize = 1 << 31;

/// The bytes of a file that may be compressed by gzip, recognised by its first two bytes.
pub(crate) fn gunzipped<'a>(path: &Path, bytes: &'a [u8]) -> Result<Cow<'a, [u8]>, Diagnostic> {
    gunzipped_up_to(MOST_BYTES, path, bytes)
}

fn gunzipped_up_to<'a>(
    most: usize,
    path: &Path,
    bytes: &'a [u8],
) -> Result<Cow<'a, [u8]>, Diagnostic> {
    if !bytes.starts_with(&[0x1f, 0x8b]) {
        return Ok(Cow::Borrowed(bytes));
    }
    let mut plain = Vec::new();
    // One more byte means that the limit is exceeded.
    let mut decoder = MultiGzDecoder::new(bytes).take(most as u64 + 1);
    let read = decoder.read_to_end(&mut plain);
    read.map_err(|error| Diagnostic::file(path, format!("expected a gzip file: {error}")))?;
    if plain.len() > most {
        let message = format!("expected at most {most} bytes in a gzip file");
        return Err(Diagnostic::file(path, message));
    }
    Ok(Cow::Owned(plain))
}

#[cfg(test)]
pub(crate) mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::GzEncoder;

    use super::*;

    /// The bytes of a gzip file.
    pub(crate) fn gzipped(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(bytes).expect("in memory");
        encoder.finish().expect("in memory")
    }

    #[test]
    fn compressed_bytes_come_back_up_to_a_limit() {
        let path = Path::new("a.gz");
        let file = gzipped(&[7; 1000]);
        let plain = gunzipped(path, &file).expect("gzip");
        assert_eq!(plain, &[7u8; 1000][..], "as they were");
        assert_eq!(
            gunzipped(path, b"abc").expect("plain"),
            &b"abc"[..],
            "plain"
        );
        let error = gunzipped_up_to(999, path, &file).expect_err("too many");
        let expected = "a.gz: expected at most 999 bytes in a gzip file";
        assert_eq!(error.to_string(), expected, "a limit");
        let error = gunzipped(path, &file[..file.len() - 9]).expect_err("cut");
        assert!(
            error.message.starts_with("expected a gzip file: "),
            "{error}"
        );
    }
}
