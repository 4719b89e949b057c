//! Views: where a scene is looked at from, pixel by pixel.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use nalgebra::Vector3;

use super::error::RenderError;
use super::scene::MAX_PIXELS;
use super::scene_file::{ANYWHERE, POSITIVE, require};
use super::section::Section;

/// A picture to take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Pixels across a frame.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Factor on radiance for what is displayed.
    pub exposure: f64,
    /// What direction a pixel stands for.
    pub projection: Projection,
}

/// What direction a pixel of a view stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Directions of view over a point: azimuth in [0, 2π) across, polar angle in [0, π/2] down.
    Equirectangular,
    /// A pinhole camera.
    Camera(Camera),
}

/// A pinhole camera; +z is up in its picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Position, in the unit of the scene.
    pub position: [f64; 3],
    /// What is in the middle of the picture.
    pub target: [f64; 3],
    /// Angle between the left and the right edge, rad.
    pub field_of_view_rad: f64,
}

/// A ray through the centre of a pixel, with its derivatives by pixels (Igehy 1999, Tracing ray
/// differentials).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it begins.
    pub origin: Vector3<f64>,
    /// Its direction, a unit vector.
    pub direction: Vector3<f64>,
    /// Change of the direction per pixel to the right and per pixel downwards.
    pub per_pixel: [Vector3<f64>; 2],
}

impl View {
    /// Reads the section of a scene.
    pub(super) fn read(mut section: Section) -> Result<Self, RenderError> {
        let kinds = [("equirectangular", false), ("camera", true)];
        let is_camera = section.named("kind", &kinds)?.needed()?;
        let pixels = [1, MAX_PIXELS as u64];
        let width = section.count("width", pixels)?.needed()? as usize;
        let height = section.count("height", pixels)?.needed()? as usize;
        require(width * height <= MAX_PIXELS, || {
            let what = format!("{width} by {height} pixels are more than {MAX_PIXELS}");
            section.wrong("height", what)
        })?;
        let exposure = section.number("exposure", POSITIVE)?.or(1.0);
        let (kind, projection) = if is_camera {
            let degrees = section.number("field_of_view_deg", [1.0, 150.0])?.needed()?;
            let camera = Camera {
                position: section.numbers("position", ANYWHERE)?.needed()?,
                target: section.numbers("target", ANYWHERE)?.needed()?,
                field_of_view_rad: degrees.to_radians(),
            };
            let is_seen = camera.position != camera.target;
            require(is_seen, || section.wrong("target", "is where the camera is"))?;
            ("kind = \"camera\"", Projection::Camera(camera))
        } else {
            ("kind = \"equirectangular\"", Projection::Equirectangular)
        };
        section.done(&["position", "target", "field_of_view_deg"], kind)?;
        Ok(Self { width, height, exposure, projection })
    }

    /// Pixels of a frame.
    pub fn pixels(&self) -> usize {
        self.width * self.height
    }

    /// Direction cosines of an equirectangular view at some pixels, counted row by row, along and
    /// across a scratch with the azimuth `direction_deg`.
    pub fn directions(&self, direction_deg: f64, pixels: Range<usize>) -> [Vec<f32>; 2] {
        let turn = direction_deg.to_radians();
        let mut columns = [Vec::with_capacity(pixels.len()), Vec::with_capacity(pixels.len())];
        for pixel in pixels {
            let (row, column) = (pixel / self.width, pixel % self.width);
            let polar = 0.5 * PI * (row as f64 + 0.5) / self.height as f64;
            let azimuth = TAU * (column as f64 + 0.5) / self.width as f64 - turn;
            let (sine, (across, along)) = (core_math::sin(polar), core_math::sincos(azimuth));
            columns[0].push((sine * along) as f32);
            columns[1].push((sine * across) as f32);
        }
        columns
    }
}

impl Camera {
    /// The ray through the centre of a pixel of a picture of `width` × `height`, counted row by row.
    pub fn ray(&self, [width, height]: [usize; 2], pixel: usize) -> Ray {
        let origin = Vector3::from(self.position);
        let forward = (Vector3::from(self.target) - origin).normalize();
        let up = if forward.xy().norm() < 1e-9 { Vector3::x() } else { Vector3::z() };
        let right = forward.cross(&up).normalize();
        let above = right.cross(&forward);
        let size = 2.0 * (0.5 * self.field_of_view_rad).tan() / width as f64;
        let x = (pixel % width) as f64 + 0.5 - 0.5 * width as f64;
        let y = 0.5 * height as f64 - (pixel / width) as f64 - 0.5;
        let through = forward + right * (x * size) + above * (y * size);
        let direction = through.normalize();
        // The derivative of v/|v| is the part of dv across v, over |v|.
        let change =
            |step: Vector3<f64>| (step - direction * direction.dot(&step)) / through.norm();
        Ray { origin, direction, per_pixel: [change(right * size), change(above * -size)] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_scratch_sees_turned_directions() {
        let projection = Projection::Equirectangular;
        let view = View { width: 8, height: 4, exposure: 1.0, projection };
        let [along, across] = view.directions(45.0, 0..32);
        // 45° is two half pixels of 22.5°: pixel 1 lies at 22.5° + 45° − 45°.
        let polar = 0.5 * PI * 0.125;
        let (sine, cosine) = core_math::sincos(22.5_f64.to_radians());
        assert_eq!(along[1], (core_math::sin(polar) * cosine) as f32);
        assert_eq!(across[1], (core_math::sin(polar) * sine) as f32);
        assert_eq!(along.len(), 32);
    }

    #[test]
    fn rays_change_by_pixels_as_their_neighbours_do() {
        let camera =
            Camera { position: [0.3, -2.0, 1.0], target: [0.0; 3], field_of_view_rad: 0.9 };
        // A picture a thousand times as fine: its pixels are a thousandth of the coarse ones.
        let (coarse, fine) = ([15, 11], [15_000, 11_000]);
        let ray = camera.ray(coarse, 4 * 15 + 11);
        let at = |x: usize, y: usize| camera.ray(fine, y * 15_000 + x).direction;
        let (x, y) = (11_500, 4_500);
        for (change, neighbour) in ray.per_pixel.iter().zip([at(x + 1, y), at(x, y + 1)]) {
            let found = (neighbour - at(x, y)) * 1000.0;
            // Of second order in a thousandth of a pixel of 0.06 rad: 3e-5 at most.
            assert!((found - change).norm() < 1e-4 * change.norm(), "{found} for {change}");
        }
    }
}
