use light_math::quantize::{QuantizedBox, decode_cos, encode_cos};

use super::input::Input;

/// A decoded cosine is that of the same or of a wider angle, by two codes at most; order is kept.
pub(super) fn cosine_quantisation(data: &[u8]) {
    let mut input = Input::new(data);
    let (a, b) = (input.f32(), input.f32());
    for c in [a, b] {
        let decoded = decode_cos(encode_cos(c));
        assert!((-1.0..=1.0).contains(&decoded), "{c} became {decoded}");
        let clamped = c.clamp(-1.0, 1.0);
        if !c.is_nan() {
            let lost = f64::from(clamped) - f64::from(decoded);
            assert!(
                (0.0..=4.0 / 32767.0).contains(&lost),
                "{c} became {decoded}"
            );
        }
    }
    if a <= b {
        assert!(encode_cos(a) <= encode_cos(b), "{a} and {b} change places");
    }
}

/// A coded box contains the original.
pub(super) fn box_quantisation(data: &[u8]) {
    let mut input = Input::new(data);
    let bounds = input.aabb();
    let enclosing = bounds.union(input.aabb());
    let decoded = QuantizedBox::encode(&bounds, &enclosing).decode(&enclosing);
    assert!(
        decoded.contains_box(&bounds) && enclosing.contains_box(&decoded),
        "{bounds:?} in {enclosing:?} became {decoded:?}"
    );
}
