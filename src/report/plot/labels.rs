//! Labels at points, placed so that they cover neither each other nor the data.

use plotters::style::text_anchor::HPos;

use super::frame::Rect;
use super::ink::Ink;
use super::lettering;
use super::surface::{Lettering, Refused, Surface};

/// Size of labels, in pixels.
pub(super) const SIZE: f64 = 11.0;

/// How often every label may choose again.
const SWEEPS: usize = 3;

/// Half-width kept free around a marker.
const MARKER: f64 = 5.5;

/// What labels must not cover.
#[derive(Debug, Default)]
pub(super) struct Obstacles {
    /// Markers.
    pub(super) places: Vec<(f64, f64)>,
    /// Lines.
    pub(super) segments: Vec<((f64, f64), (f64, f64))>,
}

/// A label with its place.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    text: String,
    point: (f64, f64),
    /// The area that it covers.
    pub(super) area: Rect,
}

/// Places the labels one after the other, each where it costs least among places around its
/// point: overlap with a label or a marker, crossing a line, distance. Those with the most
/// neighbours choose first, and all may choose again when the others stand.
pub(super) fn place(
    labels: &[(String, (f64, f64))],
    within: &Rect,
    obstacles: &Obstacles,
) -> Vec<Placed> {
    let near = |point: (f64, f64)| {
        let close =
            |other: &&(String, (f64, f64))| distance(point, other.1) < 60.0 && point != other.1;
        labels.iter().filter(close).count()
    };
    let mut order: Vec<_> = labels.iter().collect();
    order.sort_by_key(|(_, point)| std::cmp::Reverse(near(*point)));
    let mut placed: Vec<Placed> = Vec::with_capacity(labels.len());
    for (text, point) in order {
        let text = lettering::fitted(text, SIZE, within.width * 0.6);
        let size = (lettering::width(&text, SIZE), SIZE * 1.25);
        let area = cheapest(*point, size, within, obstacles, &placed);
        placed.push(Placed { text, point: *point, area });
    }
    // Whoever came first chose without knowing the others: let each choose again.
    for _ in 0..SWEEPS {
        for _ in 0..placed.len() {
            let mut label = placed.remove(0);
            let size = (label.area.width, label.area.height);
            label.area = cheapest(label.point, size, within, obstacles, &placed);
            placed.push(label);
        }
    }
    placed
}

/// The place for a label of `size` that costs least beside those that are `placed`.
fn cheapest(
    point: (f64, f64),
    size: (f64, f64),
    within: &Rect,
    obstacles: &Obstacles,
    placed: &[Placed],
) -> Rect {
    let first = Rect { left: point.0, top: point.1, width: size.0, height: size.1 };
    candidates(point, size)
        .map(|area| (cost(&area, point, within, obstacles, placed), area))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map_or(first, |(_, area)| area)
}

/// Areas around a point, the preferred ones first.
fn candidates((x, y): (f64, f64), (width, height): (f64, f64)) -> impl Iterator<Item = Rect> {
    [8.0, 14.0, 22.0, 32.0, 44.0, 58.0].into_iter().flat_map(move |gap: f64| {
        let side = gap * 0.7;
        let (right, left, middle) = (x + gap, x - gap - width, x - width / 2.0);
        [
            (right, y - height / 2.0),
            (x + side, y - side - height),
            (x + side, y + side),
            (left, y - height / 2.0),
            (x - side - width, y - side - height),
            (x - side - width, y + side),
            (middle, y - gap - height),
            (middle, y + gap),
        ]
        .map(|(left, top)| Rect { left, top, width, height })
    })
}

fn cost(
    area: &Rect,
    point: (f64, f64),
    within: &Rect,
    obstacles: &Obstacles,
    placed: &[Placed],
) -> f64 {
    let own = nearest(area, point);
    let mut cost = distance(point, own);
    if !within.contains(area) {
        cost += 5000.0;
    }
    let margin =
        Rect { left: area.left - 3.0, top: area.top, width: area.width + 6.0, height: area.height };
    for other in placed {
        if other.area.meets(point, own) {
            cost += 600.0;
        }
        if other.area.overlaps(&margin) {
            cost += 2000.0;
        }
        let leader = (other.point, nearest(&other.area, other.point));
        if area.meets(leader.0, leader.1) {
            cost += 600.0;
        }
    }
    for &(x, y) in &obstacles.places {
        let marker =
            Rect { left: x - MARKER, top: y - MARKER, width: 2.0 * MARKER, height: 2.0 * MARKER };
        if marker.overlaps(area) {
            cost += 1000.0;
        }
        // A label nearer to another marker would be read as that one's.
        if (x, y) != point && distance((x, y), nearest(area, (x, y))) <= distance(point, own) {
            cost += 150.0;
        }
        // A leader through another marker would point at that one.
        if (x, y) != point && marker.meets(point, own) {
            cost += 200.0;
        }
    }
    let crossed = obstacles.segments.iter().filter(|(a, b)| area.meets(*a, *b)).count();
    cost + if crossed > 0 { 60.0 } else { 0.0 }
}

/// Draws the labels, each with a leader if it stands apart from its point.
pub(super) fn draw(placed: &[Placed], on: &Surface<'_>) -> Result<(), Refused> {
    for label in placed {
        let near = nearest(&label.area, label.point);
        let length = distance(label.point, near);
        if length > 12.0 {
            let start = 5.0 / length;
            let from = (
                label.point.0 + start * (near.0 - label.point.0),
                label.point.1 + start * (near.1 - label.point.1),
            );
            on.line(&[from, near], Ink::Text(0.5), 0.8)?;
        }
        let place = (label.area.left, label.area.top + label.area.height / 2.0);
        on.text(&label.text, place, Lettering::new(SIZE, HPos::Left))?;
    }
    Ok(())
}

fn nearest(area: &Rect, point: (f64, f64)) -> (f64, f64) {
    (point.0.clamp(area.left, area.right()), point.1.clamp(area.top, area.bottom()))
}

fn distance(a: (f64, f64), b: (f64, f64)) -> f64 {
    (a.0 - b.0).hypot(a.1 - b.1)
}
