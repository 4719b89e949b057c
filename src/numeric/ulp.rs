//! Distances between floating-point numbers in units of the last place.
//!
//! The distance is the number of representable values stepped over from one number to the other:
//! 0 for equal numbers (+0 and −0 are equal), 1 for neighbours, continuous through zero and into
//! infinity. A NaN is as far as can be from everything but another NaN.

/// Position of `x` on the line of all f32, so that neighbours differ by 1 and ±0 coincide.
fn rank_f32(x: f32) -> i64 {
    let magnitude = i64::from(x.to_bits() & 0x7fff_ffff);
    if x.is_sign_negative() { -magnitude } else { magnitude }
}

/// Number of f32 steps from `a` to `b`; 0 if both are NaN, `u32::MAX` if one is.
pub fn ulp_distance_f32(a: f32, b: f32) -> u32 {
    match (a.is_nan(), b.is_nan()) {
        (true, true) => 0,
        (false, false) => {
            u32::try_from((rank_f32(a) - rank_f32(b)).unsigned_abs()).unwrap_or(u32::MAX)
        }
        _ => u32::MAX,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_apart_everywhere() {
        for x in [0.0_f32, -0.0, 1.0, -1.0, f32::MIN_POSITIVE, 1e-45, f32::MAX] {
            assert_eq!(ulp_distance_f32(x, x.next_up()), 1, "{x:e}");
        }
    }

    #[test]
    fn zeros_coincide_and_nan_is_far() {
        assert_eq!(ulp_distance_f32(0.0, -0.0), 0);
        assert_eq!(ulp_distance_f32(f32::NAN, f32::NAN), 0);
        assert_eq!(ulp_distance_f32(f32::NAN, 1.0), u32::MAX);
        assert_eq!(ulp_distance_f32(-1e-45, 1e-45), 2);
    }
}
