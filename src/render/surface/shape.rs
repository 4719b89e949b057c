//! Shapes with a field of tangents. What a ray meets is all that shading asks of them, so that a mesh
//! is one more case here and nothing elsewhere.

use nalgebra::Vector3;

/// A shape, with the directions along which its micro-geometry runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// A sphere. Its first direction runs east about the axis.
    Sphere {
        /// Centre.
        centre: [f64; 3],
        /// Radius.
        radius: f64,
        /// Frame of the object; the axis is its second tangent.
        frame: Frame,
    },
    /// A rectangle with the same directions everywhere.
    Rectangle {
        /// Centre.
        centre: [f64; 3],
        /// Half of the sides along the two tangents.
        half_size: [f64; 2],
        /// Frame of the object.
        frame: Frame,
    },
    /// A disc with a hole and circular tracks: the first direction points away from the centre,
    /// across the tracks.
    Disc {
        /// Centre.
        centre: [f64; 3],
        /// Radii of the hole and of the rim.
        radii: [f64; 2],
        /// Frame of the object.
        frame: Frame,
    },
}

/// Orthonormal: normal × tangents[0] = tangents[1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Normal of the object.
    pub normal: Vector3<f64>,
    /// Its tangents.
    pub tangents: [Vector3<f64>; 2],
}

/// What a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Unit normal on the side that is seen.
    pub normal: Vector3<f64>,
    /// Unit direction in the surface along which h_x is measured; h_y runs along normal × along.
    pub along: Vector3<f64>,
    /// The direction of view mirrored in the surface: r_v.
    pub reflection: Vector3<f64>,
}

impl Frame {
    /// From a normal, a hint for the first tangent, and a turn about the normal, rad. The hint is
    /// made perpendicular; where it runs along the normal another axis takes its place.
    pub fn new(normal: [f64; 3], tangent: [f64; 3], turn_rad: f64) -> Self {
        let normal = Vector3::from(normal).normalize();
        let flat = |hint: Vector3<f64>| hint - normal * hint.dot(&normal);
        let mut first = flat(Vector3::from(tangent));
        for axis in [Vector3::x(), Vector3::y()] {
            if first.norm() < 1e-6 {
                first = flat(axis);
            }
        }
        let first = first.normalize();
        let second = normal.cross(&first);
        let (sin, cos) = turn_rad.sin_cos();
        Self { normal, tangents: [first * cos + second * sin, second * cos - first * sin] }
    }

    /// Rows (normal, first, second): the matrix whose transpose turns a map into the frame, so that
    /// the normal stands at azimuth 0 on the equator with the first tangent as its east.
    pub fn rows(&self) -> [Vector3<f64>; 3] {
        [self.normal, self.tangents[0], self.tangents[1]]
    }
}

impl Shape {
    /// The frame of the object.
    pub fn frame(&self) -> &Frame {
        match self {
            Self::Sphere { frame, .. }
            | Self::Rectangle { frame, .. }
            | Self::Disc { frame, .. } => frame,
        }
    }

    /// What the ray from `origin` along the unit vector `direction` meets first, if anything.
    pub fn hit(&self, origin: Vector3<f64>, direction: Vector3<f64>) -> Option<Point> {
        let (normal, along) = match self {
            Self::Sphere { centre, radius, frame } => {
                let to = origin - Vector3::from(*centre);
                let half = to.dot(&direction);
                let under = half * half - to.norm_squared() + radius * radius;
                let distance = -half - under.max(0.0).sqrt();
                if under < 0.0 || distance <= 0.0 {
                    return None;
                }
                let normal = (to + direction * distance) / *radius;
                let east = frame.tangents[1].cross(&normal);
                let east = if east.norm() < 1e-9 { frame.tangents[0] } else { east };
                (normal, east.normalize())
            }
            Self::Rectangle { centre, half_size, frame } => {
                let [u, v] = plane_hit(*centre, frame, origin, direction)?;
                if u.abs() > half_size[0] || v.abs() > half_size[1] {
                    return None;
                }
                (frame.normal, frame.tangents[0])
            }
            Self::Disc { centre, radii, frame } => {
                let [u, v] = plane_hit(*centre, frame, origin, direction)?;
                let radius = u.hypot(v);
                if radius < radii[0] || radius > radii[1] || radius == 0.0 {
                    return None;
                }
                let outwards = (frame.tangents[0] * u + frame.tangents[1] * v) / radius;
                (frame.normal, outwards)
            }
        };
        let facing = direction.dot(&normal);
        if facing >= 0.0 {
            return None;
        }
        Some(Point { normal, along, reflection: direction - normal * (2.0 * facing) })
    }
}

/// Where a ray meets the plane through `centre`, along the tangents.
fn plane_hit(
    centre: [f64; 3],
    frame: &Frame,
    origin: Vector3<f64>,
    direction: Vector3<f64>,
) -> Option<[f64; 2]> {
    let to = Vector3::from(centre) - origin;
    let distance = to.dot(&frame.normal) / direction.dot(&frame.normal);
    if !(distance.is_finite() && distance > 0.0) {
        return None;
    }
    let place = direction * distance - to;
    Some([place.dot(&frame.tangents[0]), place.dot(&frame.tangents[1])])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_seen_along_its_normal_mirrors_the_view() {
        let frame = Frame::new([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0.0);
        assert_eq!(frame.tangents[1], Vector3::z());
        let sphere = Shape::Sphere { centre: [0.0; 3], radius: 1.0, frame };
        let point = sphere.hit(Vector3::new(3.0, 0.0, 0.0), -Vector3::x()).expect("it is met");
        assert!((point.reflection - Vector3::x()).norm() < 1e-12);
        assert!((point.along - Vector3::y()).norm() < 1e-12);
        assert!(sphere.hit(Vector3::new(3.0, 2.0, 0.0), -Vector3::x()).is_none());
    }

    #[test]
    fn tracks_of_a_disc_run_around() {
        let frame = Frame::new([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], 0.0);
        let disc = Shape::Disc { centre: [0.0; 3], radii: [0.2, 1.0], frame };
        let from = |x: f64, y: f64| disc.hit(Vector3::new(x, y, 2.0), -Vector3::z());
        let along = from(0.0, 0.5).map(|point| point.along);
        assert_eq!(along, Some(Vector3::y()));
        assert!(from(0.0, 0.1).is_none() && from(0.8, 0.8).is_none());
        // From below nothing is seen.
        assert!(disc.hit(Vector3::new(0.0, 0.5, -2.0), Vector3::z()).is_none());
    }
}
