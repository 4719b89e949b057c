//! The transfer function of sRGB (IEC 61966-2-1), per channel.

/// Linear value of an encoded one. Both 1; beyond [0, 1] the formula is simply continued.
pub fn decoded(encoded: f64) -> f64 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        core_math::pow((encoded + 0.055) / 1.055, 2.4)
    }
}

/// Encoded value of a linear one. Both 1; beyond [0, 1] the formula is simply continued.
pub fn encoded(linear: f64) -> f64 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * core_math::pow(linear, 1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::{decoded, encoded};

    #[test]
    fn every_byte_returns() {
        for byte in 0..=255_u8 {
            let code = f64::from(byte) / 255.0;
            assert_eq!((255.0 * encoded(decoded(code))).round() as u8, byte);
        }
        assert_eq!((decoded(0.0), decoded(1.0)), (0.0, 1.0));
        assert!((encoded(1.0) - 1.0).abs() <= f64::EPSILON);
    }

    /// The standard's own rounding of the slope leaves a step of 3e-8 where the branches meet.
    #[test]
    fn the_branches_meet() {
        let step = encoded(0.003_130_8 * (1.0 + 1e-12)) - encoded(0.003_130_8);
        assert!(step.abs() < 4e-8, "{step:e}");
    }
}
