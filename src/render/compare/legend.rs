//! The bar of colours under an error map.

use super::colour_map::MAGMA;

/// Rows of the strip: a margin, the bar, a margin, the digits, a margin.
const MARGIN: usize = 2;
const BAR: usize = 6;
const PAPER: [u8; 3] = [255, 255, 255];
const INK: [u8; 3] = [0, 0, 0];

/// Rows and columns of a digit, each dot drawn as a square of `DOT` pixels.
const ROWS: usize = 5;
const COLUMNS: usize = 3;
const DOT: usize = 2;

/// Digits as five rows of three dots, the top row in the highest bits.
const GLYPHS: [(char, u16); 12] = [
    ('0', 0b111_101_101_101_111),
    ('1', 0b010_110_010_010_111),
    ('2', 0b111_001_111_100_111),
    ('3', 0b111_001_111_001_111),
    ('4', 0b101_101_111_001_001),
    ('5', 0b111_100_111_001_111),
    ('6', 0b111_100_111_101_111),
    ('7', 0b111_001_010_010_010),
    ('8', 0b111_101_111_101_111),
    ('9', 0b111_101_111_001_111),
    ('.', 0b000_000_000_000_010),
    ('-', 0b000_000_111_000_000),
];

/// The letter of a power of ten.
const EXPONENT: u16 = 0b111_100_111_100_111;

/// Rows of `width` pixels: the colours from 0 to `scale`, and both numbers where they have room.
pub(super) fn strip(width: usize, scale: f64) -> Vec<[u8; 3]> {
    let rows = MARGIN + BAR + MARGIN + ROWS * DOT + MARGIN;
    let mut pixels = vec![PAPER; rows * width];
    for y in MARGIN..MARGIN + BAR {
        for x in 0..width {
            let step = if width > 1 { 255 * x / (width - 1) } else { 255 };
            pixels[y * width + x] = MAGMA[step];
        }
    }
    let text = number(scale);
    let advance = (COLUMNS + 1) * DOT;
    if width > (text.len() + 2) * advance {
        write(&mut pixels, width, DOT, "0");
        write(&mut pixels, width, width - text.len() * advance, &text);
    }
    pixels
}

/// `scale` with the digits that the glyphs have.
fn number(scale: f64) -> String {
    if (1e-3..1e4).contains(&scale) { format!("{scale}") } else { format!("{scale:e}") }
}

fn write(pixels: &mut [[u8; 3]], width: usize, left: usize, text: &str) {
    let top = MARGIN + BAR + MARGIN;
    for (place, letter) in text.chars().enumerate() {
        let glyph = GLYPHS.iter().find(|(name, _)| *name == letter);
        let dots = glyph.map_or(EXPONENT, |(_, dots)| *dots);
        for row in 0..ROWS * DOT {
            for column in 0..COLUMNS * DOT {
                let bit = ROWS * COLUMNS - 1 - (row / DOT * COLUMNS + column / DOT);
                let x = left + place * (COLUMNS + 1) * DOT + column;
                if dots >> bit & 1 == 1
                    && x < width
                    && let Some(pixel) = pixels.get_mut((top + row) * width + x)
                {
                    *pixel = INK;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_goes_from_end_to_end() {
        for width in [1, 3, 100, 640] {
            let strip = strip(width, 0.05);
            assert_eq!(strip.len() % width, 0);
            assert_eq!(strip[MARGIN * width + width - 1], MAGMA[255]);
        }
        assert_eq!(strip(100, 0.05)[MARGIN * 100], MAGMA[0]);
        assert!(strip(100, 0.05).contains(&INK) && !strip(20, 0.05).contains(&INK));
    }
}
