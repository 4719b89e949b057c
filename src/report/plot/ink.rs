//! Colours, dashes and marker shapes, and how they reach the SVG.
//!
//! plotters knows fixed colours only, and a plot must follow the ground that it stands on. So
//! everything is drawn in stand-in colours, one per ink, and [`resolve`] writes what each stands
//! for: `currentColor`, or a class with the colour for light grounds as a fallback. [`dark_rules`]
//! gives those classes their colours for dark grounds.

use std::fmt::Write as _;

use plotters::style::RGBAColor;

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

/// Rules for dark grounds, to stand in a `prefers-color-scheme: dark` query.
#[must_use]
pub fn dark_rules() -> String {
    let rule = |(index, (_, dark)): (usize, &(&str, &str))| {
        format!(".k{index}{{stroke:{dark}}}.m{index}{{fill:{dark}}}")
    };
    PALETTE.iter().enumerate().map(rule).collect()
}

/// Dashes and gaps in tenths of a pixel; empty is solid.
const DASHES: [&str; 6] = ["", "80 40", "24 28", "110 32 24 32", "150 50", "60 26 20 26 20 26"];

/// First byte of every stand-in.
const STAND_IN: u8 = 0xFE;

/// What something is drawn with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Ink {
    /// The text colour of the page, at an opacity.
    Text(f64),
    /// The colour of the series with this index, solid.
    Solid(usize),
    /// The colour of the series with this index, with its own dashes.
    Patterned(usize),
    /// The colour of the series with this index, dashed whatever the series.
    Dashed(usize),
}

impl Ink {
    /// The stand-in colour.
    pub(super) fn colour(self) -> RGBAColor {
        let byte = |index: usize| u8::try_from(index % (PALETTE.len() * DASHES.len())).unwrap_or(0);
        let (kind, index, opacity) = match self {
            Self::Text(opacity) => (0, 0, opacity),
            Self::Solid(index) => (2, byte(index), 1.0),
            Self::Patterned(index) => (3, byte(index), 1.0),
            Self::Dashed(index) => (4, byte(index), 1.0),
        };
        RGBAColor(STAND_IN, kind, index, opacity)
    }

    /// Attributes in place of `attribute="<stand-in>"`.
    fn attributes(kind: u8, index: u8, attribute: &str) -> String {
        let index = usize::from(index);
        let own = (index + index / PALETTE.len()) % DASHES.len();
        let dashes = match kind {
            3 => DASHES.get(own).copied().unwrap_or_default(),
            4 => DASHES.get(own.max(1)).copied().unwrap_or_default(),
            _ => "",
        };
        let mut text = String::new();
        // Writing to a String cannot fail.
        if kind < 2 {
            let _ = write!(text, "{attribute}=\"currentColor\"");
        } else {
            let colour = index % PALETTE.len();
            let class = if attribute == "fill" { 'm' } else { 'k' };
            let light = PALETTE.get(colour).map_or("currentColor", |pair| pair.0);
            let _ = write!(text, "class=\"{class}{colour}\" {attribute}=\"{light}\"");
        }
        if !dashes.is_empty() && attribute == "stroke" {
            let _ = write!(text, " stroke-dasharray=\"{dashes}\"");
        }
        text
    }
}

/// The shape of the markers of the series with this index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Cross,
    Wedge,
    Plus,
}

impl Marker {
    pub(super) fn of(index: usize) -> Self {
        match (index + index / PALETTE.len()) % 7 {
            0 => Self::Circle,
            1 => Self::Square,
            2 => Self::Triangle,
            3 => Self::Diamond,
            4 => Self::Cross,
            5 => Self::Wedge,
            _ => Self::Plus,
        }
    }
}

/// What plotters drew, with every stand-in replaced and what it repeats left out. `drawn` has one
/// element per line; its root element is dropped, for the caller to write its own.
pub(super) fn resolve(drawn: &str) -> String {
    let mut out = String::with_capacity(drawn.len());
    for line in drawn.lines() {
        if line.starts_with("<svg") || line == "</svg>" {
            continue;
        }
        if line.starts_with('<') && !line.starts_with("</") {
            resolve_tag(line, &mut out);
        } else {
            out.push_str(line);
        }
        // A break inside a text element would be drawn as a space.
        if !line.starts_with("<text") && line.ends_with('>') {
            out.push('\n');
        }
    }
    out
}

/// Copies a tag, attribute by attribute.
fn resolve_tag(line: &str, out: &mut String) {
    let mut rest = line;
    while let Some((name_end, (before, after))) = rest.find("=\"").zip(rest.split_once("=\"")) {
        let Some((value, tail)) = after.split_once('"') else { break };
        let name_start = before.rfind(' ').map_or(0, |at| at + 1);
        let name = rest.get(name_start..name_end).unwrap_or_default();
        let lead = rest.get(..name_start).unwrap_or_default();
        match attribute(name, value) {
            Some(text) => {
                out.push_str(lead);
                out.push_str(&text);
            }
            None => out.push_str(lead.trim_end()),
        }
        rest = tail;
    }
    out.push_str(rest);
}

/// The text of an attribute; none if it says nothing.
fn attribute(name: &str, value: &str) -> Option<String> {
    match name {
        "opacity" if value == "1" => None,
        // On the root, once.
        "font-family" => None,
        "font-size" => {
            let size = value.parse::<f64>().map_or_else(|_| value.to_owned(), rounded);
            Some(format!("font-size=\"{size}\""))
        }
        "points" => Some(format!("points=\"{}\"", value.trim_end())),
        "fill" | "stroke" => {
            let bytes = value.strip_prefix("#FE").and_then(|hex| {
                let kind = u8::from_str_radix(hex.get(..2)?, 16).ok()?;
                Some((kind, u8::from_str_radix(hex.get(2..4)?, 16).ok()?))
            });
            Some(match bytes {
                Some((kind, index)) => Ink::attributes(kind, index, name),
                None => format!("{name}=\"{value}\""),
            })
        }
        _ => Some(format!("{name}=\"{value}\"")),
    }
}

fn rounded(value: f64) -> String {
    format!("{value:.0}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stand_ins_are_replaced() {
        let drawn = "<svg width=\"9\">\n<line opacity=\"1\" stroke=\"#FE0301\" x1=\"3\"/>\n\
                     <text fill=\"#FE0000\" font-family=\"sans-serif\">\na &lt; b\n</text>\n</svg>\n";
        assert_eq!(
            resolve(drawn),
            "<line class=\"k1\" stroke=\"#D55E00\" stroke-dasharray=\"80 40\" x1=\"3\"/>\n\
             <text fill=\"currentColor\">a &lt; b</text>\n"
        );
    }
}
