use std::path::Path;

use crate::{Diagnostic, Location};

/// The parts of a glTF file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Chunks<'a> {
    /// The document.
    pub(super) json: &'a [u8],
    /// The binary chunk, if the file has one.
    pub(super) binary: Option<&'a [u8]>,
}

const MAGIC: &[u8] = b"glTF";
const JSON: &[u8] = b"JSON";
const BINARY: &[u8] = b"BIN\0";

/// What makes a file of version 2 of one of version 1.
pub(super) const UPGRADE: &str = "; `gltf-pipeline -i OLD -o NEW` makes 2.0 of it";

/// Splits a binary file into chunks; any other file is a JSON document.
///
/// # Source
/// `[GLTF]`, section 4: a header of three words, then chunks, each behind its length and its type.
pub(super) fn chunks<'a>(path: &'a Path, bytes: &'a [u8]) -> Result<Chunks<'a>, Diagnostic> {
    if !bytes.starts_with(MAGIC) {
        let first = bytes.trim_ascii_start().first();
        let is_binary = path
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("glb"));
        // Some writers name documents so.
        if is_binary && !matches!(first, Some(b'{' | 0xEF)) {
            let message = "expected a binary glTF file, which begins with `glTF`";
            return Err(Diagnostic::at(path, Location::Byte(0), message));
        }
        let (json, binary) = (bytes, None);
        return Ok(Chunks { json, binary });
    }
    let mut rest = Rest { path, bytes, at: 4 };
    let version = rest.word("a version")?;
    if version != 2 {
        let mut message = format!("expected version 2, found {version}");
        if version == 1 {
            message += UPGRADE;
        }
        return Err(rest.error(message));
    }
    let length = rest.word("a length")? as usize;
    if length > bytes.len() || length < rest.at {
        let message = format!("expected {length} bytes, found {}", bytes.len());
        return Err(rest.error(message));
    }
    rest.bytes = &bytes[..length];
    let (kind, json) = rest.chunk()?;
    if kind != JSON {
        return Err(rest.error("expected a chunk of JSON first"));
    }
    let mut binary = None;
    // Chunks of unknown types are ignored, as the specification demands.
    while binary.is_none() && rest.at < length {
        let (kind, chunk) = rest.chunk()?;
        binary = (kind == BINARY).then_some(chunk);
    }
    Ok(Chunks { json, binary })
}

struct Rest<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Rest<'a> {
    fn error(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic::at(self.path, Location::Byte(self.at), message)
    }

    fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], Diagnostic> {
        let end = self.at.checked_add(count);
        let taken = end.and_then(|end| self.bytes.get(self.at..end));
        let taken = taken
            .ok_or_else(|| self.error(format!("expected {what}, found the end of the file")))?;
        self.at += count;
        Ok(taken)
    }

    fn word(&mut self, what: &str) -> Result<u32, Diagnostic> {
        let mut word = [0; 4];
        word.copy_from_slice(self.take(4, what)?);
        Ok(u32::from_le_bytes(word))
    }

    fn chunk(&mut self) -> Result<(&'a [u8], &'a [u8]), Diagnostic> {
        let length = self.word("a chunk")? as usize;
        let kind = self.take(4, "a chunk's type")?;
        Ok((kind, self.take(length, "a chunk's bytes")?))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A binary file of these chunks.
    pub(crate) fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
        let padded = |bytes: &[u8], with: u8| {
            let mut all = bytes.to_vec();
            all.resize(bytes.len().next_multiple_of(4), with);
            all
        };
        let chunks = [
            (JSON, padded(json.as_bytes(), b' ')),
            (BINARY, padded(binary, 0)),
        ];
        let word = |n: usize| u32::try_from(n).expect("short").to_le_bytes();
        let length = 12
            + chunks
                .iter()
                .map(|(_, chunk)| 8 + chunk.len())
                .sum::<usize>();
        let mut file = [MAGIC, &word(2), &word(length)].concat();
        for (kind, chunk) in chunks {
            file.extend([&word(chunk.len()), kind, &chunk].concat());
        }
        file
    }

    #[test]
    fn a_binary_file_has_two_chunks_and_text_is_one() {
        let path = Path::new("a.glb");
        let file = glb("{}", &[1, 2, 3]);
        let found = chunks(path, &file).expect("chunks");
        assert_eq!(found.json, b"{}  ", "padded");
        assert_eq!(found.binary, Some(&[1, 2, 3, 0][..]), "padded");
        let text = chunks(path, b"{}").expect("text");
        assert_eq!((text.json, text.binary), (&b"{}"[..], None), "as it is");
    }

    #[test]
    fn broken_files_name_the_byte() {
        let good = glb("{}", &[1]);
        let error = |bytes: &[u8]| {
            let error = chunks(Path::new("a"), bytes).expect_err("an error");
            error.to_string()
        };
        let with = |at: usize, byte: u8| {
            let mut bytes = good.clone();
            bytes[at] = byte;
            bytes
        };
        let cut = "a: byte 4: expected a version, found the end of the file";
        assert_eq!(error(&good[..6]), cut, "cut in the header");
        let version = "a: byte 8: expected version 2, found 1; \
                       `gltf-pipeline -i OLD -o NEW` makes 2.0 of it";
        assert_eq!(error(&with(4, 1)), version, "version");
        let version = "a: byte 8: expected version 2, found 3";
        assert_eq!(error(&with(4, 3)), version, "of the future");
        let length = "a: byte 12: expected 200 bytes, found 36";
        assert_eq!(error(&with(8, 200)), length, "length");
        let short = "a: byte 12: expected 3 bytes, found 36";
        assert_eq!(error(&with(8, 3)), short, "shorter than its header");
        let chunk = "a: byte 20: expected a chunk's bytes, found the end of the file";
        assert_eq!(error(&with(12, 250)), chunk, "a chunk's length");
        let kind = "a: byte 24: expected a chunk of JSON first";
        assert_eq!(error(&with(16, b'X')), kind, "a chunk's type");
        for bytes in [&b""[..], b"glT", b"\x89PNG"] {
            let error = chunks(Path::new("a.glb"), bytes).expect_err("an error");
            let first = "a.glb: byte 0: expected a binary glTF file, which begins with `glTF`";
            assert_eq!(error.to_string(), first, "{bytes:?}");
        }
    }
}
