//! A pinhole camera.

use nalgebra::Vector3;

/// Where a picture is taken from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Position, in the unit of the scene.
    pub position: [f64; 3],
    /// What is in the middle of the picture.
    pub target: [f64; 3],
    /// Angle between the left and the right edge, rad.
    pub field_of_view_rad: f64,
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
}

impl Camera {
    /// Unit direction through the centre of a pixel; +z is up in the picture.
    pub fn direction(&self, pixel: usize) -> Vector3<f64> {
        let forward = (Vector3::from(self.target) - Vector3::from(self.position)).normalize();
        let up = if forward.xy().norm() < 1e-9 { Vector3::x() } else { Vector3::z() };
        let right = forward.cross(&up).normalize();
        let above = right.cross(&forward);
        let size = 2.0 * (0.5 * self.field_of_view_rad).tan() / self.width as f64;
        let x = (pixel % self.width) as f64 + 0.5 - 0.5 * self.width as f64;
        let y = 0.5 * self.height as f64 - (pixel / self.width) as f64 - 0.5;
        (forward + right * (x * size) + above * (y * size)).normalize()
    }
}
