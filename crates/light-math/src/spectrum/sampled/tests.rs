use super::*;

type S = SampledSpectrum<3>;

#[test]
fn arithmetic_is_value_by_value() {
    let a = S::new([1.0, 2.0, 4.0]);
    let b = S::new([2.0, 0.0, 0.5]);
    assert_eq!(a + b, S::new([3.0, 2.0, 4.5]), "sum");
    assert_eq!(a - b, S::new([-1.0, 2.0, 3.5]), "difference");
    assert_eq!(a * b, S::new([2.0, 0.0, 2.0]), "product");
    assert_eq!(b / a, S::new([2.0, 0.0, 0.125]), "quotient");
    assert_eq!(2.0 * a / 2.0, a, "factors");
    assert_eq!(
        a.safe_div(b),
        S::new([0.5, 0.0, 8.0]),
        "no division by zero"
    );
    assert_eq!(a.lerp(b, 0.5), S::new([1.5, 1.0, 2.25]), "halfway");
    let powers = S::new([0.0, 1.0, f32::NEG_INFINITY]).exp();
    let error = powers - S::new([1.0, core::f32::consts::E, 0.0]);
    assert!(
        error.max_element() < 1e-6 && error.min_element() > -1e-6,
        "{powers:?}"
    );
    assert_eq!([a, b].into_iter().sum::<S>(), a + b, "sum of many");
    assert_eq!(-S::ONE + S::ONE, S::ZERO, "negation");
}

#[test]
fn assignment_is_the_same_arithmetic() {
    let mut a = S::splat(3.0);
    a += S::ONE;
    a *= S::splat(2.0);
    a -= S::splat(2.0);
    a /= 3.0;
    a *= 0.5;
    a[1] = 7.0;
    assert_eq!(a, S::new([1.0, 7.0, 1.0]), "step by step");
}

#[test]
fn reductions() {
    let a = S::new([1.0, 2.0, 6.0]);
    assert_eq!(
        (a.average(), a.min_element(), a.max_element()),
        (3.0, 1.0, 6.0),
        "of three"
    );
    assert!(S::default().is_zero() && !a.is_zero(), "zero");
    assert!(a.is_finite() && !S::splat(f32::NAN).is_finite(), "finite");
    assert_eq!(SampledSpectrum::<0>::ZERO.average(), 0.0, "of none");
}
