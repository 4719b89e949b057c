//! Monte Carlo: the same integral with no approximation but noise.
//!
//! Random numbers are counter-based (pcg4d of pixel, draw, light and seed), so that an image does not
//! depend on tiles, threads or the order of work, and the device and the lanes see the same draws. A
//! pass takes [`SAMPLES_PER_PASS`] of them per pixel and light; the standard error of a pixel is that of
//! the mean of its passes, s/√n with s² the unbiased variance of n passes.

use super::error::RenderError;
use super::image::{Channel, Image};
use super::scene::{MonteCarlo, SAMPLES_PER_PASS};
use super::shading::Sampler;
use super::tiles::{self, Event};

/// `random_pair` of a counter, for kernels that draw.
pub(super) const RANDOM: &str = include_str!("monte_carlo_random.wgsl");

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

/// 32 bits of the 64 of a seed, moved apart by `salt` for what is drawn side by side.
pub(super) fn seed_word(seed: u64, salt: u32) -> u32 {
    ((seed ^ (seed >> 32)) as u32) ^ salt
}

/// Renders; `name` is the image's in events and errors, `size` its width and height.
///
/// # Errors
/// [`RenderError::Interrupted`] with what is finished.
pub(super) fn sampled(
    name: &str,
    size: [usize; 2],
    sampler: &Sampler<'_>,
    options: MonteCarlo,
    watch: &mut dyn FnMut(Event<'_>),
) -> Result<Sampled, RenderError> {
    let passes = (options.samples / SAMPLES_PER_PASS).max(2);
    let early = (passes / 4).max(1);
    let channels =
        ["R", "G", "B", "stderr.R", "stderr.G", "stderr.B", "early.R", "early.G", "early.B"];
    let mut image = tiles::image(name, size, &channels, watch, |pixels| {
        let mut moments = vec![Moments::default(); 3 * pixels.len()];
        let mut early_means = Vec::new();
        for pass in 0..passes {
            let colours = sampler(pixels.clone(), pass * SAMPLES_PER_PASS)?;
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
