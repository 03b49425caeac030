use super::*;

#[test]
fn arguments_choose_mutants() {
    let choice = |text: &str| {
        let words: Vec<String> = text.split_whitespace().map(str::to_owned).collect();
        choice(&words)
    };
    let spread = |count, offset| Ok(Choice::Spread { count, offset });
    assert_eq!(choice(""), spread(DEFAULT_COUNT, 0), "none");
    assert_eq!(choice("7"), spread(7, 0), "a count");
    assert_eq!(choice("7 3"), spread(7, 3), "a count and a place");
    assert_eq!(choice("all"), spread(usize::MAX, 0), "all");
    assert_eq!(choice("missed"), Ok(Choice::Missed), "those before");
    let file = Ok(Choice::File("node/encode.rs".into()));
    assert_eq!(choice("node/encode.rs"), file, "of one file");
    for wrong in ["0", "some", "7 x", "7 3 1", "missed 3", "encode.rs 3"] {
        assert!(choice(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn escaped_text_matches_itself_alone() {
    let mutant = "a.rs:1:2: replace <T>::f -> Vec<u8> with vec![0]";
    let escaped = r"a\.rs:1:2: replace <T>::f \-> Vec<u8> with vec!\[0\]";
    assert_eq!(escape(mutant), escaped, "a line of missed.txt");
}
