//! URIs of glTF: bytes in the document, or a file relative to it.

/// A decoded URI.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Resource {
    /// The bytes themselves.
    Bytes(Vec<u8>),
    /// A file name relative to the folder of the document.
    File(String),
}

/// Why a URI is invalid.
pub(super) const EXPECTED: &str = "a file's name, or data in base64";

/// Decodes a URI; fails if it is malformed or of another scheme.
pub(super) fn resource(uri: &str) -> Option<Resource> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (_, text) = data.split_once(";base64,")?;
        return base64(text.as_bytes()).map(Resource::Bytes);
    }
    let has_scheme = uri.contains("://");
    (!has_scheme).then(|| percent_decoded(uri).map(Resource::File))?
}

/// The bytes of base64, with or without padding.
fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let padding = text
        .iter()
        .rev()
        .take(2)
        .take_while(|&&c| c == b'=')
        .count();
    let digits = &text[..text.len() - padding];
    if digits.len() % 4 == 1 {
        return None;
    }
    let mut bytes = Vec::with_capacity(digits.len() / 4 * 3 + 2);
    for group in digits.chunks(4) {
        let mut word = 0u32;
        for place in 0..4 {
            let six = group.get(place).map_or(Some(0), |&c| sextet(c))?;
            word = word << 6 | six;
        }
        let [_, three @ ..] = word.to_be_bytes();
        bytes.extend(&three[..group.len() - 1]);
    }
    Some(bytes)
}

fn sextet(c: u8) -> Option<u32> {
    let six = match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' | b'-' => 62,
        b'/' | b'_' => 63,
        _ => return None,
    };
    Some(six.into())
}

/// Decodes percent-encoded characters such as `%20`.
fn percent_decoded(uri: &str) -> Option<String> {
    let mut parts = uri.split('%');
    let mut bytes = parts.next()?.as_bytes().to_vec();
    for part in parts {
        let (code, rest) = part.split_at_checked(2)?;
        bytes.push(u8::from_str_radix(code, 16).ok()?);
        bytes.extend(rest.as_bytes());
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Bytes as a URI.
    pub(crate) fn data_uri(bytes: &[u8]) -> String {
        const DIGITS: &[u8; 64] =
            b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        let mut uri = "data:application/octet-stream;base64,".to_owned();
        for group in bytes.chunks(3) {
            let byte = |i: usize| u32::from(group.get(i).copied().unwrap_or_default());
            let word = byte(0) << 16 | byte(1) << 8 | byte(2);
            for place in 0..4 {
                let digit = DIGITS[(word >> (18 - 6 * place) & 63) as usize];
                uri.push(if place > group.len() {
                    '='
                } else {
                    digit.into()
                });
            }
        }
        uri
    }

    #[test]
    fn base64_of_every_length() {
        // The examples of RFC 4648, section 10.
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foobar", "Zm9vYmFy"),
        ] {
            let found = base64(text.as_bytes());
            assert_eq!(found.as_deref(), Some(bytes.as_bytes()), "{text}");
        }
        assert_eq!(base64(b"Zg").as_deref(), Some(&b"f"[..]), "no padding");
        for broken in ["Z", "Zg=a", "Z===", "Zm8 "] {
            assert_eq!(base64(broken.as_bytes()), None, "{broken}");
        }
        for length in 0..20u8 {
            let bytes: Vec<u8> = (0..length).map(|i| i.wrapping_mul(83)).collect();
            let back = resource(&data_uri(&bytes));
            assert_eq!(back, Some(Resource::Bytes(bytes)), "round trip");
        }
    }

    #[test]
    fn files_have_plain_names() {
        let file = |name: &str| Some(Resource::File(name.into()));
        assert_eq!(resource("a%20b.bin"), file("a b.bin"), "a blank");
        for broken in ["a%2", "a%zz", "%ff", "https://a/b", "data:,x"] {
            assert_eq!(resource(broken), None, "{broken}");
        }
    }
}
