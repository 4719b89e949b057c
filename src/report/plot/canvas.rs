//! What plots are drawn on: elements of SVG in tenths of a pixel, so that whole coordinates are fine
//! enough for smooth curves.
//!
//! A plot follows the ground that it stands on: what has the colour of the text is drawn in
//! `currentColor`, what has a colour of its own in a class, with the colour for light grounds as a
//! fallback. [`dark_rules`] gives those classes their colours for dark grounds.

use std::fmt::{Display, Write as _};

/// Okabe and Ito's palette (jfly.uni-koeln.de/color, 2008), lightness shifted for a contrast of 3:1
/// or more: on white, and on the dark ground of the pages. The order keeps the strongest pairs of
/// hue and lightness first.
const PALETTE: [(&str, &str); 8] = [
    ("#0072B2", "#46A6E8"),
    ("#D55E00", "#F2803A"),
    ("#00875F", "#1FC495"),
    ("#B4528C", "#E094C2"),
    ("#A87000", "#F0B030"),
    ("#3F86B5", "#9AD4F7"),
    ("#5A5A5A", "#BDBDBD"),
    ("#7D7600", "#EFE350"),
];

/// Dashes and gaps in tenths of a pixel; empty is solid.
const DASHES: [&str; 6] = ["", "80 40", "24 28", "110 32 24 32", "150 50", "60 26 20 26 20 26"];

/// Units of the drawing per pixel.
pub(super) const UNITS: f64 = 10.0;

/// Rules for dark grounds, to stand in a `prefers-color-scheme: dark` query.
#[must_use]
pub fn dark_rules() -> String {
    let rule = |(index, (_, dark)): (usize, &(&str, &str))| {
        format!(".k{index}{{stroke:{dark}}}.m{index}{{fill:{dark}}}")
    };
    PALETTE.iter().enumerate().map(rule).collect()
}

/// What a line is drawn with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Ink {
    /// The text colour of the page, at an opacity.
    Text(f64),
    /// The colour of the series with this index, solid.
    Solid(usize),
    /// The same with the series' own dashes.
    Patterned(usize),
    /// The same, dashed whatever the series.
    Dashed(usize),
}

impl Ink {
    fn attributes(self) -> String {
        let (series, dashes) = match self {
            Self::Text(opacity) => return format!("opacity=\"{opacity}\" stroke=\"currentColor\""),
            Self::Solid(series) => (series, 0),
            Self::Patterned(series) => (series, pattern(series, DASHES.len())),
            Self::Dashed(series) => (series, pattern(series, DASHES.len()).max(1)),
        };
        let colour = series % PALETTE.len();
        let dashes = match DASHES[dashes] {
            "" => String::new(),
            dashes => format!(" stroke-dasharray=\"{dashes}\""),
        };
        format!("class=\"k{colour}\" stroke=\"{}\"{dashes}", PALETTE[colour].0)
    }
}

/// Attributes of an area in the colour of a series.
fn fill(series: usize) -> String {
    let colour = series % PALETTE.len();
    format!("class=\"m{colour}\" fill=\"{}\"", PALETTE[colour].0)
}

/// The place of a series among `patterns`, another one each time the colours are used up.
fn pattern(series: usize, patterns: usize) -> usize {
    (series + series / PALETTE.len()) % patterns
}

/// How a piece of text is set.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lettering {
    /// Size in pixels.
    pub(super) size: f64,
    /// Which part of the text stands at its place, as in SVG: `start`, `middle` or `end`.
    pub(super) anchor: &'static str,
    pub(super) bold: bool,
    /// Reading upwards.
    pub(super) upwards: bool,
}

impl Lettering {
    pub(super) fn new(size: f64, anchor: &'static str) -> Self {
        Self { size, anchor, bold: false, upwards: false }
    }
}

/// A drawing in progress, one element per line; places and sizes are in pixels.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    pub(super) svg: String,
}

impl Canvas {
    /// A line through `places`.
    pub(super) fn line(&mut self, places: &[(f64, f64)], ink: Ink, width: f64) {
        let (ink, width, points) = (ink.attributes(), units(width), points(places));
        self.push(format_args!(
            "<polyline fill=\"none\" {ink} stroke-width=\"{width}\" points=\"{points}\"/>"
        ));
    }

    /// A disc in the colour of a series.
    pub(super) fn disc(&mut self, series: usize, (x, y): (f64, f64), radius: f64) {
        let (x, y, r, fill) = (units(x), units(y), units(radius), fill(series));
        self.push(format_args!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" {fill} stroke=\"none\" stroke-width=\"0\"/>"
        ));
    }

    /// The marker of a series, of half-width `r`.
    pub(super) fn marker(&mut self, series: usize, (x, y): (f64, f64), r: f64) {
        let (ink, fill, d) = (Ink::Solid(series), fill(series), 0.85 * r);
        let corners: &[(f64, f64)] = match pattern(series, 7) {
            0 => return self.disc(series, (x, y), r),
            1 => {
                let [left, top, right, bottom] = [x - d, y - d, x + d, y + d].map(units);
                let (width, height) = (right - left, bottom - top);
                return self.push(format_args!(
                    "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" {fill} \
                     stroke=\"none\"/>"
                ));
            }
            2 => &[(0.0, -1.15), (1.05, 0.75), (-1.05, 0.75)],
            3 => &[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)],
            4 => {
                self.line(&[(x - d, y - d), (x + d, y + d)], ink, 1.8);
                return self.line(&[(x - d, y + d), (x + d, y - d)], ink, 1.8);
            }
            5 => &[(0.0, 1.15), (1.05, -0.75), (-1.05, -0.75)],
            _ => {
                self.line(&[(x - r, y), (x + r, y)], ink, 1.8);
                return self.line(&[(x, y - r), (x, y + r)], ink, 1.8);
            }
        };
        let corners: Vec<_> = corners.iter().map(|(dx, dy)| (x + dx * r, y + dy * r)).collect();
        self.push(format_args!("<polygon {fill} points=\"{}\"/>", points(&corners)));
    }

    /// Text, centred vertically on its place.
    pub(super) fn text(&mut self, text: &str, (x, y): (f64, f64), lettering: Lettering) {
        let (x, y, size) = (units(x), units(y), units(lettering.size));
        let bold = if lettering.bold { " font-weight=\"bold\"" } else { "" };
        let turned = match lettering.upwards {
            true => format!(" transform=\"rotate(270, {x}, {y})\""),
            false => String::new(),
        };
        self.push(format_args!(
            "<text x=\"{x}\" y=\"{y}\" dy=\"0.5ex\" text-anchor=\"{}\" font-size=\"{size}\" \
             fill=\"currentColor\"{bold}{turned}>{}</text>",
            lettering.anchor,
            escaped(text)
        ));
    }

    fn push(&mut self, element: impl Display) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.svg, "{element}");
    }
}

fn points(places: &[(f64, f64)]) -> String {
    let pairs: Vec<String> =
        places.iter().map(|(x, y)| format!("{},{}", units(*x), units(*y))).collect();
    pairs.join(" ")
}

/// Tenths of a pixel. Everything drawn lies within a figure, so far within the range of i32.
fn units(pixels: f64) -> i32 {
    (pixels * UNITS).round().clamp(-1e6, 1e6) as i32
}

/// `text` as XML, with a space for every control character, of which XML allows none.
pub(super) fn escaped(text: &str) -> String {
    let printable = text.replace(|c: char| c.is_control(), " ");
    printable.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inks_are_classes_with_a_colour_for_light_grounds() {
        let mut canvas = Canvas::default();
        canvas.line(&[(0.3, 0.0), (1.0, 2.0)], Ink::Patterned(1), 1.7);
        canvas.text("a < b", (1.0, 2.0), Lettering::new(11.0, "start"));
        assert_eq!(
            canvas.svg,
            "<polyline fill=\"none\" class=\"k1\" stroke=\"#D55E00\" stroke-dasharray=\"80 40\" \
             stroke-width=\"17\" points=\"3,0 10,20\"/>\n\
             <text x=\"10\" y=\"20\" dy=\"0.5ex\" text-anchor=\"start\" font-size=\"110\" \
             fill=\"currentColor\">a &lt; b</text>\n"
        );
        assert!(
            dark_rules().starts_with(".k0{stroke:#46A6E8}.m0{fill:#46A6E8}.k1{stroke:#F2803A}")
        );
    }
}
