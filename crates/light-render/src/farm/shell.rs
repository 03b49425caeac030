/// `word` as one word of a POSIX shell.
pub(super) fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./,=:+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_keep_what_a_shell_would_read() {
        assert_eq!(quoted("parts/0.exr"), "parts/0.exr", "plain");
        assert_eq!(quoted(""), "''", "nothing is a word too");
        assert_eq!(quoted("a b"), "'a b'", "a blank");
        assert_eq!(quoted("it's $HOME"), r"'it'\''s $HOME'", "a quotation mark");
        assert_eq!(quoted("a=*"), "'a=*'", "a pattern");
    }
}
