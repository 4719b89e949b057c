//! Rectangles, and the map from the values of two axes to a plot area.

use super::scale::Span;

/// A rectangle in pixels of the figure; y grows downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// Left edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

impl Rect {
    /// Right edge.
    #[must_use]
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    /// Lower edge.
    #[must_use]
    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Whether the two share an area.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right()
            && other.left < self.right()
            && self.top < other.bottom()
            && other.top < self.bottom()
    }

    /// Whether `inner` lies within.
    #[must_use]
    pub fn contains(&self, inner: &Self) -> bool {
        self.left <= inner.left
            && self.top <= inner.top
            && inner.right() <= self.right()
            && inner.bottom() <= self.bottom()
    }

    /// Whether the segment from `a` to `b` enters the rectangle.
    pub(super) fn meets(&self, a: (f64, f64), b: (f64, f64)) -> bool {
        self.clip(a, b).is_some()
    }

    /// The part of the segment from `a` to `b` within the rectangle (Liang and Barsky, 1984).
    pub(super) fn clip(&self, a: (f64, f64), b: (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for (step, room) in [
            (-dx, a.0 - self.left),
            (dx, self.right() - a.0),
            (-dy, a.1 - self.top),
            (dy, self.bottom() - a.1),
        ] {
            if step == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if step < 0.0 {
                enter = enter.max(room / step);
            } else {
                leave = leave.min(room / step);
            }
        }
        let at = |t: f64| (a.0 + t * dx, a.1 + t * dy);
        (enter <= leave).then(|| (at(enter), at(leave)))
    }
}

/// A plot area with its two axes.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    /// The plot area.
    pub(super) area: Rect,
    /// Horizontal axis.
    pub(super) x: Span,
    /// Vertical axis.
    pub(super) y: Span,
}

impl Frame {
    /// Where a value of the x axis stands; none if the axis cannot show it.
    pub(super) fn x_at(&self, x: f64) -> Option<f64> {
        Some(self.area.left + self.x.fraction(x)? * self.area.width)
    }

    /// Where a value of the y axis stands; none if the axis cannot show it.
    pub(super) fn y_at(&self, y: f64) -> Option<f64> {
        Some(self.area.bottom() - self.y.fraction(y)? * self.area.height)
    }

    /// Where a point stands; none if an axis cannot show it.
    pub(super) fn at(&self, point: (f64, f64)) -> Option<(f64, f64)> {
        Some((self.x_at(point.0)?, self.y_at(point.1)?))
    }

    /// Whether a place is within the plot area, its edge included.
    pub(super) fn shows(&self, place: (f64, f64)) -> bool {
        let tolerance = 0.05;
        place.0 >= self.area.left - tolerance
            && place.0 <= self.area.right() + tolerance
            && place.1 >= self.area.top - tolerance
            && place.1 <= self.area.bottom() + tolerance
    }
}
