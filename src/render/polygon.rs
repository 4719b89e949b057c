//! Plane simple polygons in space, and the triangles that they are made of.

use nalgebra::{Vector2, Vector3};

/// Most vertices of a polygon; the check for crossings is quadratic in them.
const MAX_VERTICES: usize = 256;
/// Largest coordinate.
const MAX_COORDINATE: f64 = 1e9;
/// How far a vertex may lie off the plane, and how near the scratch may be, over the extent.
const TOLERANCE: f64 = 1e-6;
/// How far the rounding of three coordinates to f32 moves a vertex and the plane, over the largest
/// coordinate.
const ROUNDING: f64 = 2.0 * f32::EPSILON as f64;
/// Smallest area over the square of the extent.
const LEAST_AREA: f64 = 1e-9;

/// A plane polygon whose boundary does not touch itself and that does not hold the origin.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[usize; 3]>,
}

/// Why vertices make no such polygon.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PolygonFault {
    /// Too few or too many vertices.
    #[error("expected 3 to {MAX_VERTICES} vertices, got {0}")]
    Count(usize),
    /// A coordinate that is not finite or too large.
    #[error(
        "vertex {at}: expected coordinates in [-{MAX_COORDINATE}, {MAX_COORDINATE}], got {got}"
    )]
    Coordinate {
        /// Index of the vertex, from 0.
        at: usize,
        /// The coordinate.
        got: f64,
    },
    /// No area.
    #[error("the polygon has no area: its vertices lie on a line, or coincide")]
    NoArea,
    /// Not in a plane.
    #[error("the polygon is not plane: vertex {at} lies {distance} off its plane")]
    NotPlane {
        /// Index of the vertex, from 0.
        at: usize,
        /// Its distance from the plane.
        distance: f64,
    },
    /// Edges that meet where they should not.
    #[error("the polygon intersects itself: edges {first} and {second} meet")]
    SelfIntersecting {
        /// Index of an edge, which begins at the vertex of that index.
        first: usize,
        /// Index of the other.
        second: usize,
    },
    /// The scratch lies in the polygon.
    #[error("the polygon holds the scratch, at the origin")]
    HoldsOrigin,
    /// The triangles do not add up to the polygon.
    #[error("the polygon could not be cut into triangles")]
    NotTriangulated,
}

impl Polygon {
    /// The polygon with these vertices in order, either way round.
    ///
    /// # Errors
    /// [`PolygonFault`], saying what is wrong and where.
    pub fn new(vertices: &[[f64; 3]]) -> Result<Self, PolygonFault> {
        if !(3..=MAX_VERTICES).contains(&vertices.len()) {
            return Err(PolygonFault::Count(vertices.len()));
        }
        for (at, vertex) in vertices.iter().enumerate() {
            if let Some(&got) = vertex.iter().find(|x| x.is_nan() || x.abs() > MAX_COORDINATE) {
                return Err(PolygonFault::Coordinate { at, got });
            }
        }
        let points: Vec<Vector3<f64>> = vertices.iter().map(|&vertex| vertex.into()).collect();
        let plane = Plane::of(&points)?;
        let flat: Vec<Vector2<f64>> = points.iter().map(|point| plane.coordinates(point)).collect();
        if let Some((first, second)) = crossing(&flat, TOLERANCE * 1e-3 * plane.extent) {
            return Err(PolygonFault::SelfIntersecting { first, second });
        }
        if plane.height_of_origin().abs() <= TOLERANCE * plane.extent
            && holds(&flat, &plane.coordinates(&Vector3::zeros()), TOLERANCE * plane.extent)
        {
            return Err(PolygonFault::HoldsOrigin);
        }
        Ok(Self { vertices: vertices.to_vec(), triangles: triangles(&flat)? })
    }

    /// The vertices.
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// The triangles, as vertices.
    pub fn triangles(&self) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
        let vertex = |at: usize| self.vertices.get(at).copied().unwrap_or_default();
        self.triangles.iter().map(move |corners| corners.map(vertex))
    }
}

/// The plane of a polygon, with axes in it.
struct Plane {
    origin: Vector3<f64>,
    normal: Vector3<f64>,
    axes: [Vector3<f64>; 2],
    extent: f64,
}

impl Plane {
    /// The plane through the mean of the vertices, normal by Newell's sum.
    fn of(points: &[Vector3<f64>]) -> Result<Self, PolygonFault> {
        let origin = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
        let extent = points.iter().map(|point| (point - origin).norm()).fold(0.0, f64::max);
        let next = points.iter().cycle().skip(1);
        let sum: Vector3<f64> =
            points.iter().zip(next).map(|(a, b)| (a - origin).cross(&(b - origin))).sum();
        let area = 0.5 * sum.norm();
        if extent == 0.0 || area <= LEAST_AREA * extent * extent {
            return Err(no_area_or_crossing(points, extent));
        }
        let normal = sum.normalize();
        let first = points
            .iter()
            .map(|point| point - origin)
            .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
        let along = first.unwrap_or(Vector3::x());
        let axis = (along - normal * normal.dot(&along)).normalize();
        // Vertices that were rounded to f32 lie off their plane by so much.
        let rounding = points.iter().map(Vector3::amax).fold(0.0, f64::max) * ROUNDING;
        for (at, point) in points.iter().enumerate() {
            let distance = normal.dot(&(point - origin)).abs();
            if distance > TOLERANCE * extent + rounding {
                return Err(PolygonFault::NotPlane { at, distance });
            }
        }
        Ok(Self { origin, normal, axes: [axis, normal.cross(&axis)], extent })
    }

    fn coordinates(&self, point: &Vector3<f64>) -> Vector2<f64> {
        let offset = point - self.origin;
        Vector2::new(self.axes[0].dot(&offset), self.axes[1].dot(&offset))
    }

    fn height_of_origin(&self) -> f64 {
        -self.normal.dot(&self.origin)
    }
}

/// A figure of eight may have a signed area of zero: then its crossing is what is wrong.
fn no_area_or_crossing(points: &[Vector3<f64>], extent: f64) -> PolygonFault {
    let Some(first) = points.first() else { return PolygonFault::NoArea };
    let spans: Vec<Vector3<f64>> = points.iter().map(|point| point - first).collect();
    let normal = spans
        .iter()
        .flat_map(|a| spans.iter().map(|b| a.cross(b)))
        .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
    let Some(normal) = normal.filter(|n| n.norm() > LEAST_AREA * extent * extent) else {
        return PolygonFault::NoArea;
    };
    let normal = normal.normalize();
    let side = if normal.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let axis = side.cross(&normal).normalize();
    let other = normal.cross(&axis);
    let flat: Vec<Vector2<f64>> =
        spans.iter().map(|span| Vector2::new(axis.dot(span), other.dot(span))).collect();
    match crossing(&flat, TOLERANCE * 1e-3 * extent) {
        Some((first, second)) => PolygonFault::SelfIntersecting { first, second },
        None => PolygonFault::NoArea,
    }
}

/// Two edges that come nearer than `tolerance`, neighbours apart from the vertex they share.
fn crossing(points: &[Vector2<f64>], tolerance: f64) -> Option<(usize, usize)> {
    let count = points.len();
    let point = |at: usize| points.get(at % count).copied().unwrap_or_default();
    for first in 0..count {
        let (a, b) = (point(first), point(first + 1));
        if (b - a).norm() <= tolerance {
            return Some((first, (first + 1) % count));
        }
        for second in first + 1..count {
            let (c, d) = (point(second), point(second + 1));
            let meet = if second == first + 1 {
                distance_to_segment(&d, &a, &b) <= tolerance
                    || distance_to_segment(&a, &c, &d) <= tolerance
            } else if (second + 1) % count == first {
                distance_to_segment(&c, &a, &b) <= tolerance
                    || distance_to_segment(&b, &c, &d) <= tolerance
            } else {
                segments_meet([a, b], [c, d], tolerance)
            };
            if meet {
                return Some((first, second));
            }
        }
    }
    None
}

fn segments_meet(p: [Vector2<f64>; 2], q: [Vector2<f64>; 2], tolerance: f64) -> bool {
    let side = |s: [Vector2<f64>; 2], x: Vector2<f64>| (s[1] - s[0]).perp(&(x - s[0]));
    let crossed = side(p, q[0]) * side(p, q[1]) < 0.0 && side(q, p[0]) * side(q, p[1]) < 0.0;
    crossed
        || q.iter().any(|x| distance_to_segment(x, &p[0], &p[1]) <= tolerance)
        || p.iter().any(|x| distance_to_segment(x, &q[0], &q[1]) <= tolerance)
}

fn distance_to_segment(x: &Vector2<f64>, a: &Vector2<f64>, b: &Vector2<f64>) -> f64 {
    let along = b - a;
    let t = ((x - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (x - (a + along * t)).norm()
}

/// Whether the polygon or its boundary, `tolerance` wide, holds `x`.
fn holds(points: &[Vector2<f64>], x: &Vector2<f64>, tolerance: f64) -> bool {
    let mut inside = false;
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        if distance_to_segment(x, a, b) <= tolerance {
            return true;
        }
        if (a.y > x.y) != (b.y > x.y) && x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            inside = !inside;
        }
    }
    inside
}

/// Ear cutting; the triangles' areas must add up to the polygon's.
fn triangles(points: &[Vector2<f64>]) -> Result<Vec<[usize; 3]>, PolygonFault> {
    let outline = points.iter().map(|point| [point.x, point.y]);
    let mut corners: Vec<usize> = Vec::new();
    earcut::Earcut::new().earcut(outline.clone(), &[], &mut corners);
    if earcut::deviation(outline, &[], &corners) <= 1e-9 {
        Ok(corners.as_chunks().0.to_vec())
    } else {
        Err(PolygonFault::NotTriangulated)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn star() -> Vec<[f64; 3]> {
        (0..16)
            .map(|i| {
                let radius = if i % 2 == 0 { 1.0 } else { 0.4 };
                let angle = std::f64::consts::PI * f64::from(i) / 8.0;
                [radius * angle.cos(), radius * angle.sin(), 2.0]
            })
            .collect()
    }

    #[test]
    fn a_star_is_cut_into_all_of_its_triangles() -> Result<(), PolygonFault> {
        let polygon = Polygon::new(&star())?;
        assert_eq!(polygon.triangles().count(), 14);
        let area: f64 = polygon
            .triangles()
            .map(|corners| {
                let [a, b, c] = corners.map(Vector3::from);
                0.5 * (b - a).cross(&(c - a)).norm()
            })
            .sum();
        // Sixteen triangles from the centre with sides 1 and 0.4 and the angle π/8.
        let expected = 16.0 * 0.5 * 0.4 * (std::f64::consts::PI / 8.0).sin();
        assert!((area - expected).abs() < 1e-12, "{area} {expected}");
        Ok(())
    }

    #[test]
    fn faults_are_told_apart() {
        let fault = |vertices: &[[f64; 3]]| Polygon::new(vertices).err();
        assert_eq!(fault(&star()[..2]), Some(PolygonFault::Count(2)));
        let line = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [2.0, 0.0, 1.0]];
        assert_eq!(fault(&line), Some(PolygonFault::NoArea));
        let mut lifted = star();
        lifted[3][2] += 0.01;
        assert!(matches!(fault(&lifted), Some(PolygonFault::NotPlane { .. })));
        let eight = [[0.0, 0.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
        assert_eq!(fault(&eight), Some(PolygonFault::SelfIntersecting { first: 0, second: 2 }));
        let spike =
            [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [0.0, -1.0, 1.0]];
        assert!(matches!(fault(&spike), Some(PolygonFault::SelfIntersecting { .. })));
        let around = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(fault(&around), Some(PolygonFault::HoldsOrigin));
        let nan = [[0.0, 0.0, 1.0], [1.0, f64::NAN, 1.0], [0.0, 1.0, 1.0]];
        assert!(matches!(fault(&nan), Some(PolygonFault::Coordinate { at: 1, .. })));
    }
}
