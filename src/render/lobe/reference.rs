//! The reference image: the semi-analytic integrals of `area_light`, pixel by pixel, in f64.

use rayon::prelude::*;

use super::illumination::Illumination;
use crate::effects::area_light;
use crate::render::RenderError;
use crate::render::shading::Columns;

/// Columns R, G, B towards the directions of view in two columns; shared out among the threads.
///
/// # Errors
/// As [`radiance`].
pub(super) fn colours(lit: &Illumination, views: &[Vec<f32>]) -> Result<Columns, RenderError> {
    let [along, across] = views else { return Ok(Vec::new()) };
    let colours: Vec<[f64; 3]> = along
        .par_iter()
        .zip(across)
        .map(|(x, y)| radiance(lit, [f64::from(*x), f64::from(*y)]))
        .collect::<Result<_, _>>()?;
    let channel = |at: usize| colours.iter().map(|rgb| rgb[at] as f32).collect();
    Ok((0..3).map(channel).collect())
}

/// Radiance in R, G, B towards a view direction in the frame of the scratch.
///
/// # Errors
/// [`RenderError::Reference`] where an integral has no value.
pub fn radiance(lit: &Illumination, view: [f64; 2]) -> Result<[f64; 3], RenderError> {
    let wide = |point: [f32; 3]| point.map(f64::from);
    let failed = |source| RenderError::Reference { view, source };
    let polygons: Vec<Vec<[f64; 3]>> =
        lit.polygons.iter().map(|p| p.vertices.iter().copied().map(wide).collect()).collect();
    let mut colour = [0.0; 3];
    for wave in &lit.waves {
        let (kw, ks) = (f64::from(wave.kw), f64::from(wave.ks));
        let mut add = |lobe: f64, radiance: [f64; 3]| {
            for ((sum, weight), light) in colour.iter_mut().zip(wave.weight).zip(radiance) {
                *sum += lobe * weight * light;
            }
        };
        for sphere in &lit.spheres {
            let (centre, radius) = (wide(sphere.centre), f64::from(sphere.radius));
            let lobe = area_light::sphere_light(kw, ks, view, centre, radius).map_err(failed)?;
            add(lobe, sphere.radiance);
        }
        for (polygon, vertices) in lit.polygons.iter().zip(&polygons) {
            let lobe = area_light::polygon_light(kw, ks, view, vertices).map_err(failed)?;
            add(lobe, polygon.radiance);
        }
    }
    Ok(colour)
}
