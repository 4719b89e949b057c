//! Bounds by smooth transformation, so that every solver works without them.
//!
//! With a lower bound only, p = l + s(√(u² + 1) − 1); with an upper bound only its mirror image;
//! with both, p = l + (h − l)(1 + sin u)/2. This is MINUIT's choice (James & Roos 1975, Comput.
//! Phys. Commun. 10, 343) with the one-sided length 1 replaced by the distance s of the start, so
//! that it does not depend on the unit. At a bound dp/du = 0 and a gradient method would stay there
//! for ever: a start that lies on a bound begins a thousandth of the width inside.

/// Interval of one constant; either side may be open.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bounds {
    /// Lower bound, if any.
    pub lower: Option<f64>,
    /// Upper bound, if any.
    pub upper: Option<f64>,
}

/// Part of the width by which a start on a bound is moved inside.
const INSIDE: f64 = 1e-3;

/// A map from an unbounded variable u to a constant p within its bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Transform {
    /// p = u.
    Identity,
    /// p on one side of `bound`.
    OneSided {
        /// The bound.
        bound: f64,
        /// Length s, negative below an upper bound.
        scale: f64,
    },
    /// `lower` ≤ p ≤ `upper`.
    Between {
        /// The lower bound.
        lower: f64,
        /// The upper bound.
        upper: f64,
    },
}

impl Transform {
    /// The transformation for `bounds`, at rest at `start`.
    pub fn new(bounds: Bounds, start: f64) -> Self {
        let length = |bound: f64| {
            let distance = (start - bound).abs();
            if distance > 0.0 { distance } else { bound.abs().max(1.0) }
        };
        match (bounds.lower, bounds.upper) {
            (None, None) => Self::Identity,
            (Some(bound), None) => Self::OneSided { bound, scale: length(bound) },
            (None, Some(bound)) => Self::OneSided { bound, scale: -length(bound) },
            (Some(lower), Some(upper)) => Self::Between { lower, upper },
        }
    }

    /// u for a constant `p` within the bounds (moved inside if it lies on one).
    pub fn variable(&self, p: f64) -> f64 {
        match *self {
            Self::Identity => p,
            Self::OneSided { bound, scale } => {
                let t = 1.0 + ((p - bound) / scale).max(INSIDE);
                (t * t - 1.0).sqrt()
            }
            Self::Between { lower, upper } => {
                let t = ((p - lower) / (upper - lower)).clamp(INSIDE, 1.0 - INSIDE);
                (2.0 * t - 1.0).asin()
            }
        }
    }

    /// p(u).
    pub fn constant(&self, u: f64) -> f64 {
        match *self {
            Self::Identity => u,
            Self::OneSided { bound, scale } => bound + scale * (u * u / (1.0 + u.hypot(1.0))),
            Self::Between { lower, upper } => {
                (lower + (upper - lower) * 0.5 * (1.0 + u.sin())).clamp(lower, upper)
            }
        }
    }

    /// dp/du.
    pub fn slope(&self, u: f64) -> f64 {
        match *self {
            Self::Identity => 1.0,
            Self::OneSided { scale, .. } => scale * u / u.hypot(1.0),
            Self::Between { lower, upper } => 0.5 * (upper - lower) * u.cos(),
        }
    }

    /// Whether `p` is within the bounds.
    pub fn contains(&self, p: f64) -> bool {
        match *self {
            Self::Identity => true,
            Self::OneSided { bound, scale } => (p - bound) * scale.signum() >= 0.0,
            Self::Between { lower, upper } => (lower..=upper).contains(&p),
        }
    }

    /// The bound that `p` lies on or next to, within `tolerance` of the width.
    pub fn bound_at(&self, p: f64, tolerance: f64) -> Option<f64> {
        match *self {
            Self::Identity => None,
            Self::OneSided { bound, scale } => {
                ((p - bound) * scale.signum() <= tolerance * scale.abs()).then_some(bound)
            }
            Self::Between { lower, upper } => {
                let reach = tolerance * (upper - lower);
                let near = |bound: f64, inside: f64| (inside <= reach).then_some(bound);
                near(lower, p - lower).or(near(upper, upper - p))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> [Transform; 4] {
        let bounds = |lower, upper| Bounds { lower, upper };
        [
            Transform::new(bounds(None, None), 0.5),
            Transform::new(bounds(Some(-2.0), None), 0.5),
            Transform::new(bounds(None, Some(3.0)), 0.5),
            Transform::new(bounds(Some(0.0), Some(1.0)), 0.5),
        ]
    }

    #[test]
    fn a_constant_survives_the_round_trip() {
        for transform in all() {
            for p in [0.01, 0.3, 0.5, 0.98] {
                let back = transform.constant(transform.variable(p));
                assert!((back - p).abs() < 1e-13, "{transform:?}: {p} came back as {back}");
            }
        }
    }

    #[test]
    fn the_slope_is_the_derivative() {
        let h = 1e-6;
        for transform in all() {
            for u in [-0.7, 0.2, 1.1] {
                let difference =
                    (transform.constant(u + h) - transform.constant(u - h)) / (2.0 * h);
                assert!((difference - transform.slope(u)).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn a_start_on_a_bound_can_move() {
        let bounds = Bounds { lower: Some(0.0), upper: Some(1.0) };
        for start in [0.0, 1.0] {
            let transform = Transform::new(bounds, start);
            assert!(transform.slope(transform.variable(start)) > 1e-2);
        }
    }
}
