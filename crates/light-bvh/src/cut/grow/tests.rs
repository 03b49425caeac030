use super::*;

#[test]
fn bits_are_appended_in_their_order() {
    for mask in (0..1 << WIDTH).step_by(97) {
        let mut nodes = [0; MAX_NODES + WIDTH];
        let appended = append_set_bits(&mut nodes, MAX_NODES, mask, 1000);
        let expected = (0..WIDTH).zip(1000..).filter(|(k, _)| mask >> k & 1 == 1);
        let expected = expected.map(|(_, node)| node);
        assert_eq!(appended, expected.clone().count(), "{mask:b}");
        assert!(
            nodes[MAX_NODES..][..appended].iter().copied().eq(expected),
            "{mask:b}: {nodes:?}"
        );
    }
}

#[test]
fn what_is_within_16_times_its_estimate_is_left_as_it_is() {
    for (total, expected, counts_for) in [
        (3.0, 40.0, 3.0),
        (40.0, 3.0, 40.0),
        (1.0, 32.0, 2.0),
        (32.0, 1.0, 16.0),
        (f32::MIN_POSITIVE, 2.0, 0.125),
        (0.5, f32::MIN_POSITIVE, f32::MIN_POSITIVE * 16.0),
        (0.0, 1.0, 0.0),
    ] {
        let revised = total * revision(total, expected, 1.0 / 16.0, 16.0);
        assert_eq!(revised, counts_for, "{total} for {expected}");
    }
    let revised = f32::MIN_POSITIVE * revision(f32::MIN_POSITIVE, f32::MAX, 1.0 / 16.0, 16.0);
    assert!(revised > 0.0 && revised < f32::MAX, "{revised}");
}

#[test]
fn only_numbers_above_count() {
    let mut numbers = [0.5; WIDTH];
    (numbers[1], numbers[WIDTH - 1], numbers[3]) = (0.6, 2.0, f32::NAN);
    assert_eq!(mask_above(&numbers, 0.5), 1 << 1 | 1 << (WIDTH - 1));
}
