//! binary16: what `quantizeToF16` and `unpack2x16float` give.

/// Rounds to binary16 and back, ties to even; beyond its range ±∞.
pub(super) fn quantized(value: f32) -> f32 {
    const SMALLEST_NORMAL: f32 = 6.103_515_6e-5;
    const OVERFLOW: f32 = 65520.0;
    if value.is_nan() {
        value
    } else if value.abs() >= OVERFLOW {
        f32::INFINITY.copysign(value)
    } else if value.abs() < SMALLEST_NORMAL {
        // Subnormal halves are multiples of 2⁻²⁴: adding and subtracting 1.5 · 2⁻¹ rounds to one.
        ((value.abs() + 0.75) - 0.75).copysign(value)
    } else {
        // Thirteen of the 23 fraction bits go; the carry into the exponent is what rounding wants.
        let bits = value.to_bits();
        let rounded = bits + 0x0fff + ((bits >> 13) & 1);
        f32::from_bits(rounded & !0x1fff)
    }
}

/// 2¹¹²: between the exponents of f32 and of binary16, whose fields line up 13 bits apart.
const SCALE: f32 = f32::from_bits((112 + 127) << 23);

/// The number that the low 16 bits of `bits` are.
#[inline(always)]
pub(super) fn value(bits: u32) -> f32 {
    let (sign, magnitude) = ((bits & 0x8000) << 16, bits & 0x7fff);
    let finite = f32::from_bits(magnitude << 13) * SCALE;
    let special = f32::from_bits(0x7f80_0000 | magnitude << 13);
    f32::from_bits((if magnitude < 0x7c00 { finite } else { special }).to_bits() | sign)
}

#[cfg(test)]
mod tests {
    use exr::prelude::f16;

    /// Every binary16 there is comes back, and is what quantizing leaves as it is.
    #[test]
    fn values_and_bits_are_inverse() {
        for half in 0..=u16::MAX {
            let value = super::value(half.into());
            assert_eq!(value.is_nan(), half & 0x7fff > 0x7c00, "{half:#x}");
            if !value.is_nan() {
                assert_eq!(f16::from_f32(value).to_bits(), half, "{half:#x}: {value:e}");
                assert_eq!(super::quantized(value).to_bits(), value.to_bits(), "{half:#x}");
            }
        }
        assert_eq!([0x3c00, 0xc000, 0x0001].map(super::value), [1.0, -2.0, 2.0_f32.powi(-24)]);
    }
}
