//! Exact sampling of a domain: pieces per argument, tensor product over arguments.

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::{Deserialize, Deserializer, de};

/// Most points of a piece, and of a tensor product; more is a mistake.
pub const MOST_POINTS: usize = 5_000_000;

/// How the points of a piece are spaced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spacing {
    /// Equal differences, both ends included.
    #[default]
    Linear,
    /// Equal ratios, both ends included; ends of one sign, neither 0.
    Log,
    /// Chebyshev–Lobatto points, dense at both ends, which are included.
    Chebyshev,
}

/// A run of points from `from` to `to`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Piece {
    /// First point.
    pub from: f64,
    /// Last point.
    pub to: f64,
    /// Number of points, at least 2.
    pub count: usize,
    /// Their spacing.
    #[serde(default)]
    pub spacing: Spacing,
}

impl Piece {
    /// What is wrong with the piece, in words.
    pub fn fault(&self) -> Option<String> {
        if !self.from.is_finite() || !self.to.is_finite() {
            return Some(format!("expected finite ends, got {} to {}", self.from, self.to));
        }
        if self.from >= self.to {
            return Some(format!(
                "expected from < to, got {} to {}: the domain has no width",
                self.from, self.to
            ));
        }
        if !(2..=MOST_POINTS).contains(&self.count) {
            return Some(format!("expected count = 2 to {MOST_POINTS}, got {}", self.count));
        }
        if self.spacing == Spacing::Log && self.from * self.to <= 0.0 {
            return Some(format!(
                "logarithmic spacing expects ends of one sign, got {} to {}",
                self.from, self.to
            ));
        }
        None
    }

    /// The points, in increasing order.
    pub fn points(&self) -> Vec<f64> {
        let last = self.count.saturating_sub(1);
        (0..self.count)
            .map(|i| {
                if i == 0 {
                    return self.from;
                }
                if i == last {
                    return self.to;
                }
                let t = i as f64 / last as f64;
                match self.spacing {
                    Spacing::Linear => self.from + (self.to - self.from) * t,
                    Spacing::Log => self.from * (self.to / self.from).powf(t),
                    Spacing::Chebyshev => {
                        let c = 0.5 * (1.0 - (std::f64::consts::PI * t).cos());
                        self.from + (self.to - self.from) * c
                    }
                }
            })
            .collect()
    }
}

/// The values of one argument.
#[derive(Debug, Clone, PartialEq)]
pub enum Sampling {
    /// One value: the argument does not vary.
    Constant(f64),
    /// Pieces one after the other; a point that ends one and begins the next is kept once.
    Pieces(Vec<Piece>),
}

impl Sampling {
    /// The values in the order of the pieces.
    pub fn points(&self) -> Vec<f64> {
        match self {
            Sampling::Constant(value) => vec![*value],
            Sampling::Pieces(pieces) => {
                let mut all = Vec::new();
                for piece in pieces {
                    let points = piece.points();
                    let skip = usize::from(all.last() == points.first() && !all.is_empty());
                    all.extend(points.into_iter().skip(skip));
                }
                all
            }
        }
    }
}

/// Written out by hand in place of an untagged enum, whose errors name neither key nor line.
impl<'de> Deserialize<'de> for Sampling {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> de::Visitor<'de> for Visitor {
            type Value = Sampling;

            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str("a number, { from, to, count, spacing } or a list of these")
            }
            fn visit_f64<E>(self, value: f64) -> Result<Sampling, E> {
                Ok(Sampling::Constant(value))
            }
            fn visit_i64<E>(self, value: i64) -> Result<Sampling, E> {
                Ok(Sampling::Constant(value as f64))
            }
            fn visit_map<A: de::MapAccess<'de>>(self, map: A) -> Result<Sampling, A::Error> {
                let piece = Piece::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Sampling::Pieces(vec![piece]))
            }
            fn visit_seq<A: de::SeqAccess<'de>>(self, seq: A) -> Result<Sampling, A::Error> {
                Ok(Sampling::Pieces(Vec::deserialize(SeqAccessDeserializer::new(seq))?))
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

/// Tensor product of `axes`: one column per axis, the last varying fastest.
pub fn tensor_product(axes: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let rows: usize = axes.iter().map(Vec::len).product();
    let mut repeat = rows;
    axes.iter()
        .map(|axis| {
            repeat = repeat.checked_div(axis.len()).unwrap_or(0);
            let run = repeat;
            axis.iter()
                .flat_map(|value| std::iter::repeat_n(*value, run))
                .cycle()
                .take(rows)
                .collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_include_both_ends_exactly() {
        for spacing in [Spacing::Linear, Spacing::Log, Spacing::Chebyshev] {
            let points = Piece { from: 0.1, to: 7.3, count: 11, spacing }.points();
            assert_eq!((points[0], points[10], points.len()), (0.1, 7.3, 11));
            assert!(points.windows(2).all(|w| w[0] < w[1]));
        }
    }

    #[test]
    fn touching_pieces_share_their_point() {
        let piece = |from, to| Piece { from, to, count: 3, spacing: Spacing::Linear };
        let axis = Sampling::Pieces(vec![piece(0.0, 1.0), piece(1.0, 3.0)]);
        assert_eq!(axis.points(), [0.0, 0.5, 1.0, 2.0, 3.0]);
    }

    #[test]
    fn last_axis_varies_fastest() {
        let columns = tensor_product(&[vec![1.0, 2.0], vec![3.0, 4.0, 5.0]]);
        assert_eq!(columns[0], [1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
        assert_eq!(columns[1], [3.0, 4.0, 5.0, 3.0, 4.0, 5.0]);
    }
}
