//! Monte Carlo over the lights: the same integral with no approximation but noise.
//!
//! Directions are uniform in the cone of a sphere, points uniform on the triangles of a polygon,
//! with counter-based random numbers (pcg4d of pixel, draw, light and seed), so that an image does
//! not depend on tiles, threads or the order of work, and the device and the lanes see the same
//! draws. A pass takes [`SAMPLES_PER_PASS`] of them per pixel and light; the standard error of a
//! pixel is that of the mean of its passes, s/√n with s² the unbiased variance of n passes.

use super::backend::{Backend, Painter};
use super::error::RenderError;
use super::illumination::{Illumination, Sphere, directions};
use super::image::{Channel, Image};
use super::kernel::{self, Kernel, SceneData};
use super::light_form::LightKind;
use super::scene::{MonteCarlo, SAMPLES_PER_PASS, Scene};
use super::tiles::{self, Event};

/// A Monte Carlo image.
#[derive(Debug, Clone)]
pub struct Sampled {
    /// R, G, B and their standard errors `stderr.R` ….
    pub image: Image,
    /// R, G, B after the first quarter of the passes (at least one), to see how the error falls.
    pub early: Image,
    /// Samples per pixel and light of `early`.
    pub early_samples: u32,
}

/// The text around the scene's constants for one kind of light.
pub(super) fn text(kind: LightKind) -> &'static str {
    match kind {
        LightKind::Sphere => concat!(
            include_str!("monte_carlo_sphere.wgsl"),
            include_str!("monte_carlo_random.wgsl")
        ),
        LightKind::Polygon => concat!(
            include_str!("monte_carlo_polygon.wgsl"),
            include_str!("monte_carlo_random.wgsl")
        ),
    }
}

/// The seed of a kind of light: 32 bits of the scene's 64, apart for spheres and polygons.
pub(super) fn seed_word(seed: u64, kind: LightKind) -> u32 {
    let salt = match kind {
        LightKind::Sphere => 0x9e37_79b9,
        LightKind::Polygon => 0x7f4a_7c15,
    };
    ((seed ^ (seed >> 32)) as u32) ^ salt
}

/// Adds the axes of the cones that spheres fill, and 1 − cos of their half-angles.
pub(super) fn add_cones(data: &mut SceneData, spheres: &[Sphere]) {
    let cones: Vec<Cone> = spheres.iter().map(Cone::of).collect();
    data.add_scalars("scene_cone", "light", cones.iter().map(|cone| cone.versine));
    for (at, name) in ["scene_axis", "scene_tangent", "scene_bitangent"].into_iter().enumerate() {
        data.add_vectors(name, "light", cones.iter().filter_map(|cone| cone.axes.get(at).copied()));
    }
}

/// The cone of directions in which a sphere is seen from the origin.
struct Cone {
    versine: f32,
    axes: [[f32; 3]; 3],
}

impl Cone {
    fn of(sphere: &Sphere) -> Self {
        let centre = nalgebra::Vector3::from(sphere.centre.map(f64::from));
        let axis = centre.normalize();
        let sine = f64::from(sphere.radius) / centre.norm();
        // 1 − cos = sin² / (1 + cos) keeps its digits for small lights.
        let versine = sine * sine / (1.0 + (1.0 - sine * sine).sqrt());
        let side = if axis.x.abs() < 0.5 { nalgebra::Vector3::x() } else { nalgebra::Vector3::y() };
        let tangent = side.cross(&axis).normalize();
        let axes = [axis, tangent, axis.cross(&tangent)];
        Self { versine: versine as f32, axes: axes.map(|v| v.map(|x| x as f32).into()) }
    }
}

/// The kernels of one pass.
///
/// # Errors
/// As [`kernel::sampling`].
pub(super) fn kernels(lit: &Illumination, seed: u64) -> Result<Vec<Kernel>, RenderError> {
    kernel::sampling(lit, seed)
}

/// Renders; `name` is the image's in events and errors.
///
/// # Errors
/// [`RenderError::Interrupted`] with what is finished.
pub(super) fn sampled(
    name: &str,
    scene: &Scene,
    kernels: &[Kernel],
    options: MonteCarlo,
    backend: Backend<'_>,
    watch: &mut dyn FnMut(Event<'_>),
) -> Result<Sampled, RenderError> {
    let painter = Painter::new(kernels, backend)?;
    let passes = (options.samples / SAMPLES_PER_PASS).max(2);
    let early = (passes / 4).max(1);
    let channels =
        ["R", "G", "B", "stderr.R", "stderr.G", "stderr.B", "early.R", "early.G", "early.B"];
    let mut image = tiles::image(name, &scene.view, &channels, watch, |pixels| {
        let [along, across] = directions(&scene.view, scene.scratch.direction_deg, pixels.clone());
        let numbers: Vec<f32> = pixels.clone().map(|pixel| pixel as f32).collect();
        let mut inputs = vec![along, across, numbers, vec![0.0; pixels.len()]];
        let mut moments = vec![Moments::default(); 3 * pixels.len()];
        let mut early_means = Vec::new();
        for pass in 0..passes {
            if let Some(first) = inputs.get_mut(3) {
                first.fill((pass * SAMPLES_PER_PASS) as f32);
            }
            let colours = painter.colours(&inputs)?;
            for (moments, colour) in moments.chunks_mut(pixels.len()).zip(colours) {
                moments.iter_mut().zip(colour).for_each(|(m, value)| m.add(f64::from(value)));
            }
            if pass + 1 == early {
                early_means = moments.iter().map(|m| m.mean as f32).collect();
            }
        }
        let means: Vec<f32> = moments.iter().map(|m| m.mean as f32).collect();
        let errors: Vec<f32> = moments.iter().map(|m| m.standard_error() as f32).collect();
        let columns = [means, errors, early_means];
        Ok(columns.iter().flat_map(|c| c.chunks(pixels.len()).map(<[f32]>::to_vec)).collect())
    })?;
    let early_channels: Vec<Channel> = image
        .channels
        .split_off(6)
        .into_iter()
        .map(|c| Channel { name: c.name.trim_start_matches("early.").to_owned(), ..c })
        .collect();
    let (width, height) = (image.width, image.height);
    Ok(Sampled {
        image,
        early: Image { width, height, channels: early_channels },
        early_samples: early * SAMPLES_PER_PASS,
    })
}

/// Mean and spread of the passes so far (Welford).
#[derive(Debug, Clone, Copy, Default)]
struct Moments {
    count: f64,
    mean: f64,
    squares: f64,
}

impl Moments {
    fn add(&mut self, value: f64) {
        self.count += 1.0;
        let step = value - self.mean;
        self.mean += step / self.count;
        self.squares += step * (value - self.mean);
    }

    /// Of the mean; NaN for a single pass.
    fn standard_error(&self) -> f64 {
        (self.squares / (self.count * (self.count - 1.0))).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form::Form;

    const RANDOM: &str = include_str!("monte_carlo_random.wgsl");

    #[test]
    fn moments_of_a_known_sample() {
        let mut moments = Moments::default();
        [1.0, 2.0, 6.0].into_iter().for_each(|value| moments.add(value));
        // Variance 7, over three.
        assert_eq!(moments.mean, 3.0);
        assert!((moments.standard_error() - (7.0_f64 / 3.0).sqrt()).abs() < 1e-15);
    }

    /// pcg4d in u32 arithmetic of Rust.
    fn random_pair(counter: [u32; 4]) -> [f32; 2] {
        let [mut x, mut y, mut z, mut w] =
            counter.map(|c| c.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
        for round in 0..2 {
            x = x.wrapping_add(y.wrapping_mul(w));
            y = y.wrapping_add(z.wrapping_mul(x));
            z = z.wrapping_add(x.wrapping_mul(y));
            w = w.wrapping_add(y.wrapping_mul(z));
            if round == 0 {
                [x, y, z, w] = [x, y, z, w].map(|v| v ^ (v >> 16));
            }
        }
        [x, y].map(|v| ((v >> 8) as f32 + 0.5) * 5.960_464_5e-8)
    }

    #[test]
    fn the_kernels_draw_the_bits_of_pcg4d() -> Result<(), crate::form::FormError> {
        let source = format!(
            "{RANDOM}fn draws(pixel: f32, draw: f32) -> vec2<f32> {{\n\
             return random_pair(u32(pixel), u32(draw), 3u, 7u); }}"
        );
        let form = Form::parse("draws.wgsl", &source, "draws")?;
        let pixels: Vec<f32> = (0..300).map(|i| (i * 55_000) as f32).collect();
        let draws: Vec<f32> = (0..300).map(|i| (i * i) as f32).collect();
        let values = form.eval_f32(&[], &[&pixels, &draws])?;
        for (i, (first, second)) in (0_u32..).zip(values[0].iter().zip(&values[1])) {
            let expected = random_pair([i * 55_000, i * i, 3, 7]);
            assert_eq!([*first, *second], expected, "counter {i}");
        }
        Ok(())
    }
}
