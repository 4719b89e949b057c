//! Colours as FLIP sees them: opponent space for blurring, Hunt-adjusted CIELAB and the HyAB
//! distance for differences.

/// Linear sRGB to XYZ for D65, as the fractions that FLIP uses.
const TO_XYZ: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];

/// The inverse of [`TO_XYZ`].
const FROM_XYZ: [[f64; 3]; 3] = [
    [3.241_003_232_976_358_3, -1.537_398_969_488_785_3, -0.498_615_881_996_362_8],
    [-0.969_224_252_202_516_3, 1.875_929_983_695_175, 0.041_554_226_340_084_69],
    [0.055_639_419_851_975_41, -0.204_011_206_123_909_94, 1.057_148_977_187_533_3],
];

/// XYZ of the reference white: the row sums of [`TO_XYZ`], sRGB (1, 1, 1).
const WHITE: [f64; 3] = [0.950_428_545_377_180_8, 1.0, 1.088_900_370_798_127_7];

/// Exponent of the difference.
const EXPONENT: f64 = 0.7;
/// Share of the largest difference that is mapped to [`KNEE_VALUE`].
const KNEE: f64 = 0.4;
/// What the knee is mapped to.
const KNEE_VALUE: f64 = 0.95;

fn product(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Opponent colours (Y, C_x, C_z) of linear sRGB, linear in it.
pub(super) fn opponent(rgb: [f64; 3]) -> [f64; 3] {
    let xyz = product(&TO_XYZ, rgb);
    let [x, y, z] = [xyz[0] / WHITE[0], xyz[1] / WHITE[1], xyz[2] / WHITE[2]];
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn linear_srgb(opponent: [f64; 3]) -> [f64; 3] {
    let y = (opponent[0] + 16.0) / 116.0;
    let (x, z) = (y + opponent[1] / 500.0, y - opponent[2] / 200.0);
    product(&FROM_XYZ, [x * WHITE[0], y * WHITE[1], z * WHITE[2]])
}

/// CIELAB of linear sRGB, its a and b scaled by L/100 after Hunt.
fn hunt_adjusted_lab(rgb: [f64; 3]) -> [f64; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    let response = |t: f64| {
        if t > DELTA * DELTA * DELTA {
            core_math::cbrt(t)
        } else {
            t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    };
    let xyz = product(&TO_XYZ, rgb);
    let [x, y, z] =
        [response(xyz[0] / WHITE[0]), response(xyz[1] / WHITE[1]), response(xyz[2] / WHITE[2])];
    let lightness = 116.0 * y - 16.0;
    let adjusted = |chrominance: f64| 0.01 * lightness * chrominance;
    [lightness, adjusted(500.0 * (x - y)), adjusted(200.0 * (y - z))]
}

/// City block in lightness plus Euclidean distance in chromaticity, to the power of [`EXPONENT`].
fn distance(one: [f64; 3], other: [f64; 3]) -> f64 {
    let [l, a, b] = [0, 1, 2].map(|i| one[i] - other[i]);
    core_math::pow(l.abs() + (a * a + b * b).sqrt(), EXPONENT)
}

/// FLIP's difference of colours.
pub(super) struct ColourDifference {
    /// The distance of the farthest colours that a display has: green and blue.
    largest: f64,
}

impl ColourDifference {
    pub(super) fn new() -> Self {
        let green = hunt_adjusted_lab([0.0, 1.0, 0.0]);
        Self { largest: distance(green, hunt_adjusted_lab([0.0, 0.0, 1.0])) }
    }

    /// Difference in [0, 1] of two blurred opponent colours, clamped to what a display has.
    pub(super) fn of(&self, one: [f64; 3], other: [f64; 3]) -> f64 {
        let lab = |opponent| hunt_adjusted_lab(linear_srgb(opponent).map(|v| v.clamp(0.0, 1.0)));
        let distance = distance(lab(one), lab(other));
        let knee = KNEE * self.largest;
        if distance < knee {
            KNEE_VALUE * distance / knee
        } else {
            KNEE_VALUE + (1.0 - KNEE_VALUE) * (distance - knee) / (self.largest - knee)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opponent_colours_return() {
        for rgb in [[0.2, 0.7, 0.4], [1.0, 0.0, 0.0], [1.0, 1.0, 1.0]] {
            let back = linear_srgb(opponent(rgb));
            for (a, b) in back.into_iter().zip(rgb) {
                assert!((a - b).abs() < 1e-14, "{back:?} of {rgb:?}");
            }
        }
        let white = opponent([1.0; 3]);
        assert!((white[0] - 100.0).abs() < 1e-12 && white[1].abs() + white[2].abs() < 1e-12);
    }

    #[test]
    fn green_to_blue_is_one() {
        let difference = ColourDifference::new();
        let (green, blue) = (opponent([0.0, 1.0, 0.0]), opponent([0.0, 0.0, 1.0]));
        assert!((difference.of(green, blue) - 1.0).abs() < 1e-12);
        assert_eq!(difference.of(green, green), 0.0);
    }
}
