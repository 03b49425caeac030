//! Functions behind pointers that the compiler does not see through: called as a renderer calls
//! them, their code counts for the crate that they come from.

use core::hint::black_box;

pub(crate) fn apart1<A, O>(function: fn(A) -> O) -> fn(A) -> O {
    black_box(function)
}

pub(crate) fn apart2<A, B, O>(function: fn(A, B) -> O) -> fn(A, B) -> O {
    black_box(function)
}

pub(crate) fn apart3<A, B, C, O>(function: fn(A, B, C) -> O) -> fn(A, B, C) -> O {
    black_box(function)
}
