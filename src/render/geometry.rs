//! Geometry: shapes with a field of tangents. What a ray meets is all that shading asks of them, so
//! that a mesh is one more case here and nothing elsewhere.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;

use super::error::RenderError;
use super::scene_file::{ANYWHERE, NOT_NEGATIVE, TURNS_DEG, require};
use super::section::Section;
use super::view::Ray;

/// A shape, with the directions along which its micro-geometry runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Geometry {
    /// The shape.
    pub shape: Shape,
    /// Its centre.
    pub centre: [f64; 3],
    /// Its frame.
    pub frame: Frame,
}

/// A shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// The point over which directions of view are mapped: a surface with the normal +z, its first
    /// direction at an azimuth.
    Point {
        /// Azimuth of the first direction, degrees.
        direction_deg: f64,
    },
    /// A sphere. Its first direction runs east about the axis, which is the second tangent.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// A rectangle with the same directions everywhere.
    Rectangle {
        /// Half of the sides along the two tangents.
        half_size: [f64; 2],
    },
    /// A disc with a hole and circular tracks: the first direction points away from the centre,
    /// across the tracks.
    Disc {
        /// Radii of the hole and of the rim.
        radii: [f64; 2],
    },
}

/// Orthonormal: normal × tangents[0] = tangents[1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Normal.
    pub normal: Vector3<f64>,
    /// The two tangents.
    pub tangents: [Vector3<f64>; 2],
}

/// What a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Where, in the unit of the scene.
    pub position: Vector3<f64>,
    /// Unit normal on the side that is seen; the first tangent is the direction along which h_x is
    /// measured.
    pub frame: Frame,
    /// Place on the shape, [0, 1] each: across and up a rectangle; azimuth over 2π and place between
    /// hole and rim of a disc; azimuth over 2π about the axis, from the normal of the object at a half,
    /// and polar angle over π of a sphere.
    pub uv: [f64; 2],
    /// What half a pixel to the right and half a pixel down come to on the plane that touches the shape
    /// here: two conjugate half diameters of the ellipse that the disc in a pixel is mapped to.
    pub footprint: [Vector3<f64>; 2],
    /// The direction of view mirrored in the surface: r_v, a unit vector.
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

    /// With a normal and a first tangent that are perpendicular unit vectors.
    pub fn of(normal: Vector3<f64>, first: Vector3<f64>) -> Self {
        Self { normal, tangents: [first, normal.cross(&first)] }
    }

    /// Rows (normal, first, second): the matrix whose transpose turns a map into the frame, so that
    /// the normal stands at azimuth 0 on the equator with the first tangent as its east.
    pub fn rows(&self) -> [Vector3<f64>; 3] {
        [self.normal, self.tangents[0], self.tangents[1]]
    }
}

impl Hit {
    /// A hit in `frame` seen in the mirror direction of `reflection`, at the origin and without extent:
    /// for shading that asks for directions alone.
    pub fn of_directions(frame: Frame, reflection: Vector3<f64>) -> Self {
        let nowhere = Vector3::zeros();
        Self { position: nowhere, frame, uv: [0.0; 2], footprint: [nowhere; 2], reflection }
    }
}

impl Geometry {
    /// A point with its first direction at an azimuth, at the origin.
    pub fn point(direction_deg: f64) -> Self {
        let frame = Frame::new([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], direction_deg.to_radians());
        Self { shape: Shape::Point { direction_deg }, centre: [0.0; 3], frame }
    }

    /// Reads the section of a scene.
    pub(super) fn read(mut section: Section) -> Result<Self, RenderError> {
        const SHAPES: [(&str, &[&str]); 4] = [
            ("point", &["direction_deg"]),
            ("rectangle", &["half_size", "centre", "normal", "tangent"]),
            ("disc", &["radii", "centre", "normal", "tangent"]),
            ("sphere", &["radius", "centre", "normal", "tangent"]),
        ];
        const ALL: [&str; 7] =
            ["direction_deg", "half_size", "radii", "radius", "centre", "normal", "tangent"];
        let shapes = SHAPES.map(|(name, own)| (name, (name, own)));
        let (name, own) = section.named("shape", &shapes)?.needed()?;
        section.only(own, &ALL, &format!("shape = \"{name}\""))?;
        if name == "point" {
            return Ok(Self::point(section.number("direction_deg", TURNS_DEG)?.or(0.0)));
        }
        let centre = section.numbers("centre", ANYWHERE)?.or([0.0; 3]);
        let normal = section.numbers("normal", ANYWHERE)?.needed()?;
        let tangent = section.numbers("tangent", ANYWHERE)?.needed()?;
        require(normal != [0.0; 3], || section.wrong("normal", "expected a vector that is not 0"))?;
        let shape = match name {
            "rectangle" => {
                Shape::Rectangle { half_size: section.numbers("half_size", [1e-6, 1e9])?.needed()? }
            }
            "disc" => {
                let radii: [f64; 2] = section.numbers("radii", NOT_NEGATIVE)?.needed()?;
                require(radii[0] < radii[1], || {
                    section
                        .wrong("radii", format!("expected the hole before the rim, got {radii:?}"))
                })?;
                Shape::Disc { radii }
            }
            _ => Shape::Sphere { radius: section.number("radius", [1e-6, 1e9])?.needed()? },
        };
        Ok(Self { shape, centre, frame: Frame::new(normal, tangent, 0.0) })
    }

    /// The shape turned about its normal.
    #[must_use]
    pub fn turned(self, turn_rad: f64) -> Self {
        let Frame { normal, tangents: [first, _] } = self.frame;
        Self { frame: Frame::new(normal.into(), first.into(), turn_rad), ..self }
    }

    /// What `ray` meets first, if anything; a point is never met.
    pub fn hit(&self, ray: &Ray) -> Option<Hit> {
        let frame = &self.frame;
        let (distance, normal, along, uv) = match self.shape {
            Shape::Point { .. } => return None,
            Shape::Sphere { radius } => {
                let to = ray.origin - Vector3::from(self.centre);
                let half = to.dot(&ray.direction);
                let under = half * half - to.norm_squared() + radius * radius;
                let distance = -half - under.max(0.0).sqrt();
                if under < 0.0 || distance <= 0.0 {
                    return None;
                }
                let normal = (to + ray.direction * distance) / radius;
                let axis = frame.tangents[1];
                let east = axis.cross(&normal);
                let east = if east.norm() < 1e-9 { frame.tangents[0] } else { east };
                let azimuth = normal.dot(&frame.tangents[0]).atan2(normal.dot(&frame.normal));
                let polar = normal.dot(&axis).clamp(-1.0, 1.0).acos();
                (distance, normal, east.normalize(), [azimuth / TAU + 0.5, polar / PI])
            }
            Shape::Rectangle { half_size } => {
                let (distance, [u, v]) = self.plane_hit(ray)?;
                if u.abs() > half_size[0] || v.abs() > half_size[1] {
                    return None;
                }
                let uv = [0.5 + 0.5 * u / half_size[0], 0.5 + 0.5 * v / half_size[1]];
                (distance, frame.normal, frame.tangents[0], uv)
            }
            Shape::Disc { radii: [hole, rim] } => {
                let (distance, [u, v]) = self.plane_hit(ray)?;
                let radius = u.hypot(v);
                if radius < hole || radius > rim || radius == 0.0 {
                    return None;
                }
                let outwards = (frame.tangents[0] * u + frame.tangents[1] * v) / radius;
                let uv = [v.atan2(u) / TAU + 0.5, (radius - hole) / (rim - hole)];
                (distance, frame.normal, outwards, uv)
            }
        };
        let facing = ray.direction.dot(&normal);
        if facing >= 0.0 {
            return None;
        }
        // On the plane that touches: distance · d(direction), and the change of the distance that keeps
        // it there.
        let half_pixel = |change: Vector3<f64>| {
            (change - ray.direction * (change.dot(&normal) / facing)) * (0.5 * distance)
        };
        Some(Hit {
            position: ray.origin + ray.direction * distance,
            frame: Frame::of(normal, along),
            uv,
            footprint: ray.per_pixel.map(half_pixel),
            reflection: ray.direction - normal * (2.0 * facing),
        })
    }

    /// How far along the ray it meets the plane of the shape, and where along the tangents.
    fn plane_hit(&self, ray: &Ray) -> Option<(f64, [f64; 2])> {
        let to = Vector3::from(self.centre) - ray.origin;
        let distance = to.dot(&self.frame.normal) / ray.direction.dot(&self.frame.normal);
        if !(distance.is_finite() && distance > 0.0) {
            return None;
        }
        let place = ray.direction * distance - to;
        Some((distance, self.frame.tangents.map(|tangent| place.dot(&tangent))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::view::Camera;

    fn ray(origin: [f64; 3], direction: Vector3<f64>) -> Ray {
        Ray { origin: origin.into(), direction, per_pixel: [Vector3::zeros(); 2] }
    }

    #[test]
    fn a_sphere_seen_along_its_normal_mirrors_the_view() {
        let frame = Frame::new([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0.0);
        assert_eq!(frame.tangents[1], Vector3::z());
        let sphere = Geometry { shape: Shape::Sphere { radius: 1.0 }, centre: [0.0; 3], frame };
        let hit = sphere.hit(&ray([3.0, 0.0, 0.0], -Vector3::x())).expect("it is met");
        assert!((hit.reflection - Vector3::x()).norm() < 1e-12);
        assert!((hit.frame.tangents[0] - Vector3::y()).norm() < 1e-12);
        assert_eq!((hit.position, hit.uv), (Vector3::x(), [0.5, 0.5]));
        assert!(sphere.hit(&ray([3.0, 2.0, 0.0], -Vector3::x())).is_none());
    }

    #[test]
    fn tracks_of_a_disc_run_around() {
        let frame = Frame::new([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], 0.0);
        let shape = Shape::Disc { radii: [0.2, 1.0] };
        let disc = Geometry { shape, centre: [0.0; 3], frame };
        let from = |x: f64, y: f64| disc.hit(&ray([x, y, 2.0], -Vector3::z()));
        let hit = from(0.0, 0.6).expect("it is met");
        assert_eq!(hit.frame.tangents[0], Vector3::y());
        assert!((hit.uv[0] - 0.75).abs() < 1e-12 && (hit.uv[1] - 0.5).abs() < 1e-12);
        assert!(from(0.0, 0.1).is_none() && from(0.8, 0.8).is_none());
        // From below nothing is seen.
        assert!(disc.hit(&ray([0.0, 0.5, -2.0], Vector3::z())).is_none());
    }

    #[test]
    fn a_point_has_a_frame_and_is_never_met() {
        let point = Geometry::point(90.0);
        assert!((point.frame.tangents[0] - Vector3::y()).norm() < 1e-12);
        assert!(point.hit(&ray([0.0, 0.0, 2.0], -Vector3::z())).is_none());
    }

    /// Positions a thousandth of a pixel aside, against the footprint; normals, tangents and uv come
    /// along continuously.
    #[test]
    fn footprints_are_what_neighbouring_rays_meet() {
        let frame = Frame::new([0.2, -0.3, 1.0], [1.0, 0.4, 0.0], 0.3);
        let centre = [0.1, 0.0, -0.2];
        let shapes = [
            Shape::Rectangle { half_size: [1.0, 0.8] },
            Shape::Disc { radii: [0.0, 1.0] },
            Shape::Sphere { radius: 0.7 },
        ];
        let camera = Camera { position: [0.3, -2.5, 1.5], target: centre, field_of_view_rad: 0.7 };
        let (coarse, fine) = ([20, 16], [20_000, 16_000]);
        for shape in shapes.map(|shape| Geometry { shape, centre, frame }) {
            for (x, y) in [(10, 8), (11, 7), (8, 9)] {
                let hit = shape.hit(&camera.ray(coarse, y * 20 + x)).expect("it is met");
                let at = |dx: usize, dy: usize| {
                    let pixel = (1000 * y + 500 + dy) * 20_000 + 1000 * x + 500 + dx;
                    shape.hit(&camera.ray(fine, pixel)).expect("it is met")
                };
                let (here, beside) = (at(0, 0), [at(1, 0), at(0, 1)]);
                // Half a fine pixel from the centre of the coarse one, 1.4e-4 of the scene away.
                assert!((here.position - hit.position).norm() < 1e-4, "{shape:?}");
                for (half, next) in hit.footprint.iter().zip(&beside) {
                    let found = (next.position - here.position) * 500.0;
                    // A sphere bends within the pixel: second order in a thousandth of it.
                    assert!((found - half).norm() < 2e-3 * half.norm(), "{found} for {half}");
                    assert!(half.dot(&hit.frame.normal).abs() < 1e-12, "it lies in the surface");
                    assert!(next.uv.iter().zip(here.uv).all(|(a, b)| (a - b).abs() < 1e-3));
                }
                let [first, second] = hit.frame.tangents;
                assert!((hit.frame.normal.cross(&first) - second).norm() < 1e-12);
                assert!(hit.uv.iter().all(|place| (0.0..=1.0).contains(place)), "{:?}", hit.uv);
            }
        }
    }
}
