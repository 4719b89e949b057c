//! Vectors in the frame of a scratch.

/// Length, without overflow.
pub(super) fn length(vector: [f64; 3]) -> f64 {
    vector[0].hypot(vector[1]).hypot(vector[2])
}

/// The vector of length 1 along a vector that is not zero.
pub(super) fn unit(vector: [f64; 3]) -> [f64; 3] {
    let length = length(vector);
    vector.map(|component| component / length)
}

/// The cross product.
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
