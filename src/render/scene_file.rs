//! The TOML of a scene: its keys, and what is checked before anything is rendered.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::error::RenderError;
use super::illumination::Facets;
use super::light_form::is_in_project;
use super::polygon::Polygon;
use super::scene::{
    ApproximationChoice, Budget, Light, MAX_PIXELS, MonteCarlo, ReferenceMethod, SAMPLES_PER_PASS,
    Scene, Scratch, Shape, Spectrum, View,
};
use super::scene_keys::Keys;

/// Shortest and longest wavelength of a scene, nm: 100 nm to 100 µm.
const WAVELENGTHS_NM: [f64; 2] = [100.0, 1e5];
/// Most wavelengths of a spectral picture.
const MAX_WAVELENGTHS: usize = 401;
/// Most samples per pixel: sample numbers are counted in an f32.
const MAX_SAMPLES: u32 = 1 << 24;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    #[serde(default)]
    description: String,
    view: ViewFile,
    scratch: ScratchFile,
    #[serde(default)]
    light: Vec<LightFile>,
    spectrum: SpectrumFile,
    reference: ReferenceFile,
    monte_carlo: Option<MonteCarloFile>,
    #[serde(default)]
    approximation: Vec<ApproximationFile>,
    #[serde(default)]
    budget: BTreeMap<String, Budget>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ViewFile {
    kind: String,
    width: i64,
    height: i64,
    exposure: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScratchFile {
    width_um: f64,
    depth_um: f64,
    coherence_radius_um: f64,
    #[serde(default)]
    direction_deg: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LightFile {
    kind: String,
    centre: Option<[f64; 3]>,
    radius: Option<f64>,
    vertices: Option<Vec<[f64; 3]>>,
    radiance: Option<toml::Value>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SpectrumFile {
    kind: String,
    wavelengths_nm: Option<[f64; 3]>,
    from_nm: Option<f64>,
    to_nm: Option<f64>,
    samples: Option<i64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReferenceFile {
    method: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MonteCarloFile {
    samples: i64,
    seed: Option<u64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ApproximationFile {
    name: String,
    sphere: Option<String>,
    polygon: Option<String>,
}

impl Scene {
    /// Reads and checks a scene.
    ///
    /// # Errors
    /// [`RenderError::Io`], [`RenderError::Toml`] with the line, [`RenderError::Value`] with the
    /// key.
    pub fn read(path: &Path) -> Result<Self, RenderError> {
        let shown = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|source| RenderError::Io { path: shown.clone(), source })?;
        let name = path.file_stem().map_or("scene".into(), |stem| stem.to_string_lossy());
        Self::parse(&name, &shown, &text)
    }

    /// The same from text; `path` names it in messages.
    ///
    /// # Errors
    /// As [`Scene::read`].
    pub fn parse(name: &str, path: &str, text: &str) -> Result<Self, RenderError> {
        let file: SceneFile = toml::from_str(text).map_err(|error| RenderError::Toml {
            path: path.to_owned(),
            report: error.to_string().trim_end().to_owned(),
        })?;
        let keys = Keys { path };
        let spectrum = keys.spectrum(&file.spectrum)?;
        let scene = Self {
            name: name.to_owned(),
            description: file.description,
            view: keys.view(&file.view)?,
            scratch: keys.scratch(&file.scratch)?,
            lights: keys.lights(file.light, &spectrum)?,
            spectrum,
            reference: keys.reference(&file.reference)?,
            monte_carlo: file.monte_carlo.map(|section| keys.monte_carlo(&section)).transpose()?,
            approximations: keys.approximations(file.approximation)?,
            budget: file.budget,
        };
        keys.consistent(&scene)?;
        Ok(scene)
    }
}

impl Keys<'_> {
    fn view(&self, view: &ViewFile) -> Result<View, RenderError> {
        if view.kind != "equirectangular" {
            return Err(self.unknown_kind(
                "view.kind",
                &view.kind,
                "\"equirectangular\" or \"camera\"",
            ));
        }
        let side = |key, pixels: i64| match usize::try_from(pixels) {
            Ok(side) if (1..=MAX_PIXELS).contains(&side) => Ok(side),
            _ => Err(self.wrong(key, format!("expected 1 to {MAX_PIXELS} pixels, got {pixels}"))),
        };
        let (width, height) = (side("view.width", view.width)?, side("view.height", view.height)?);
        if width * height > MAX_PIXELS {
            let what = format!("{width} by {height} pixels are more than {MAX_PIXELS}");
            return Err(self.wrong("view.height", what));
        }
        let exposure = self.within("view.exposure", view.exposure.unwrap_or(1.0), 1e-9, 1e9)?;
        Ok(View { width, height, exposure })
    }

    fn scratch(&self, scratch: &ScratchFile) -> Result<Scratch, RenderError> {
        let number =
            |key: &str, value, from, to| self.within(&format!("scratch.{key}"), value, from, to);
        Ok(Scratch {
            width_um: number("width_um", scratch.width_um, 1e-3, 1e4)?,
            depth_um: number("depth_um", scratch.depth_um, 0.0, 1e4)?,
            coherence_radius_um: number(
                "coherence_radius_um",
                scratch.coherence_radius_um,
                0.1,
                1e5,
            )?,
            direction_deg: number("direction_deg", scratch.direction_deg, -360.0, 360.0)?,
        })
    }

    fn lights(
        &self,
        lights: Vec<LightFile>,
        spectrum: &Spectrum,
    ) -> Result<Vec<Light>, RenderError> {
        if lights.is_empty() {
            return Err(self.wrong("light", "a scene needs at least one [[light]]"));
        }
        let numbered = lights.into_iter().enumerate();
        numbered.map(|(at, light)| self.light(&format!("light[{at}]"), light, spectrum)).collect()
    }

    fn light(&self, at: &str, light: LightFile, spectrum: &Spectrum) -> Result<Light, RenderError> {
        let key = |name: &str| format!("{at}.{name}");
        let radiance = self.radiance(&key("radiance"), light.radiance, spectrum)?;
        let shape = match light.kind.as_str() {
            "sphere" => {
                self.unwanted(&key("vertices"), &light.vertices, "sphere")?;
                let centre = self.needed(&key("centre"), light.centre)?;
                let radius = self.needed(&key("radius"), light.radius)?;
                self.sphere(at, centre, radius)?
            }
            "polygon" => {
                self.unwanted(&key("centre"), &light.centre, "polygon")?;
                self.unwanted(&key("radius"), &light.radius, "polygon")?;
                let vertices = self.needed(&key("vertices"), light.vertices)?;
                let polygon = Polygon::new(&vertices)
                    .map_err(|fault| self.wrong(key("vertices"), fault.to_string()))?;
                Shape::Polygon(polygon)
            }
            other => {
                return Err(self.unknown_kind(&key("kind"), other, "\"sphere\" or \"polygon\""));
            }
        };
        Ok(Light { shape, radiance })
    }

    fn sphere(&self, at: &str, centre: [f64; 3], radius: f64) -> Result<Shape, RenderError> {
        for value in centre {
            self.within(&format!("{at}.centre"), value, -1e9, 1e9)?;
        }
        self.within(&format!("{at}.radius"), radius, 1e-9, 1e9)?;
        let distance = centre.iter().map(|x| x * x).sum::<f64>().sqrt();
        if radius >= distance * (1.0 - 1e-6) {
            let what = format!("{radius} reaches the scratch, {distance} from the centre");
            return Err(self.wrong(format!("{at}.radius"), what));
        }
        Ok(Shape::Sphere { centre, radius })
    }

    fn radiance(
        &self,
        key: &str,
        value: Option<toml::Value>,
        spectrum: &Spectrum,
    ) -> Result<[f64; 3], RenderError> {
        let number = |value: &toml::Value| match value {
            toml::Value::Float(number) => self.within(key, *number, 0.0, 1e9),
            toml::Value::Integer(number) => self.within(key, *number as f64, 0.0, 1e9),
            other => Err(self.wrong(key, format!("expected a number, got {}", other.type_str()))),
        };
        match value {
            None => Ok([1.0; 3]),
            Some(toml::Value::Array(channels)) => {
                if !matches!(spectrum, Spectrum::Rgb(_)) {
                    let what = "three radiances need spectrum.kind = \"rgb\"; give one number";
                    return Err(self.wrong(key, what));
                }
                let channels: Vec<f64> = channels.iter().map(number).collect::<Result<_, _>>()?;
                channels
                    .try_into()
                    .map_err(|_| self.wrong(key, "expected one number or three (R, G, B)"))
            }
            Some(value) => Ok([number(&value)?; 3]),
        }
    }

    fn spectrum(&self, spectrum: &SpectrumFile) -> Result<Spectrum, RenderError> {
        let [shortest, longest] = WAVELENGTHS_NM;
        let wavelength = |key: &str, value| self.within(key, value, shortest, longest);
        match spectrum.kind.as_str() {
            "rgb" => {
                self.unwanted("spectrum.from_nm", &spectrum.from_nm, "rgb")?;
                self.unwanted("spectrum.to_nm", &spectrum.to_nm, "rgb")?;
                self.unwanted("spectrum.samples", &spectrum.samples, "rgb")?;
                let key = "spectrum.wavelengths_nm";
                let wavelengths = self.needed(key, spectrum.wavelengths_nm)?;
                for value in wavelengths {
                    wavelength(key, value)?;
                }
                Ok(Spectrum::Rgb(wavelengths))
            }
            "spectral" => {
                self.unwanted("spectrum.wavelengths_nm", &spectrum.wavelengths_nm, "spectral")?;
                let from = wavelength(
                    "spectrum.from_nm",
                    self.needed("spectrum.from_nm", spectrum.from_nm)?,
                )?;
                let to =
                    wavelength("spectrum.to_nm", self.needed("spectrum.to_nm", spectrum.to_nm)?)?;
                if from >= to {
                    return Err(self
                        .wrong("spectrum.to_nm", format!("expected more than {from}, got {to}")));
                }
                let samples = self.needed("spectrum.samples", spectrum.samples)?;
                let count = usize::try_from(samples).unwrap_or(0);
                if !(2..=MAX_WAVELENGTHS).contains(&count) {
                    let what =
                        format!("expected 2 to {MAX_WAVELENGTHS} wavelengths, got {samples}");
                    return Err(self.wrong("spectrum.samples", what));
                }
                let step = (to - from) / (count - 1) as f64;
                Ok(Spectrum::Spectral((0..count).map(|i| from + step * i as f64).collect()))
            }
            other => Err(self.unknown_kind("spectrum.kind", other, "\"rgb\" or \"spectral\"")),
        }
    }

    fn reference(&self, reference: &ReferenceFile) -> Result<ReferenceMethod, RenderError> {
        match reference.method.as_str() {
            "quadrature" => Ok(ReferenceMethod::Quadrature),
            "monte_carlo" => Ok(ReferenceMethod::MonteCarlo),
            other => Err(self.unknown_kind(
                "reference.method",
                other,
                "\"quadrature\" or \"monte_carlo\"",
            )),
        }
    }

    fn monte_carlo(&self, section: &MonteCarloFile) -> Result<MonteCarlo, RenderError> {
        let samples = u32::try_from(section.samples).unwrap_or(0);
        let enough = (2 * SAMPLES_PER_PASS..=MAX_SAMPLES).contains(&samples);
        if !enough || !samples.is_multiple_of(SAMPLES_PER_PASS) {
            let what = format!(
                "expected a multiple of {SAMPLES_PER_PASS} from {} to {MAX_SAMPLES}, got {}",
                2 * SAMPLES_PER_PASS,
                section.samples
            );
            return Err(self.wrong("monte_carlo.samples", what));
        }
        Ok(MonteCarlo { samples, seed: section.seed.unwrap_or(1) })
    }

    fn approximations(
        &self,
        approximations: Vec<ApproximationFile>,
    ) -> Result<Vec<ApproximationChoice>, RenderError> {
        let mut chosen: Vec<ApproximationChoice> = Vec::new();
        for (at, file) in approximations.into_iter().enumerate() {
            let key = format!("approximation[{at}].name");
            let known: Vec<&str> = chosen.iter().map(|other| other.name.as_str()).collect();
            self.approximation_name(&key, &file.name, &known)?;
            let ApproximationFile { name, sphere, polygon } = file;
            chosen.push(ApproximationChoice { name, sphere, polygon });
        }
        Ok(chosen)
    }

    /// What depends on several sections.
    fn consistent(&self, scene: &Scene) -> Result<(), RenderError> {
        if scene.reference == ReferenceMethod::MonteCarlo && scene.monte_carlo.is_none() {
            let what = "reference.method = \"monte_carlo\" needs a section [monte_carlo]";
            return Err(self.wrong("monte_carlo", what));
        }
        for (at, light) in scene.lights.iter().enumerate() {
            if let Shape::Polygon(polygon) = &light.shape {
                // What is shaded is rounded: it must be a polygon too.
                Facets::new(polygon, scene.scratch.direction_deg, light.radiance).map_err(
                    |fault| self.wrong(format!("light[{at}].vertices"), format!("in f32, {fault}")),
                )?;
            }
        }
        for (at, choice) in scene.approximations.iter().enumerate() {
            let kinds = [
                ("sphere", &choice.sphere, scene.has_spheres()),
                ("polygon", &choice.polygon, scene.has_polygons()),
            ];
            for (kind, fit, lit) in kinds {
                if let Some(name) = fit.as_ref().filter(|name| !is_in_project(name)) {
                    let what = format!("expected a name inside the project, got \"{name}\"");
                    return Err(self.wrong(format!("approximation[{at}].{kind}"), what));
                }
                if lit && fit.is_none() {
                    let what = format!("the scene has a {kind}: name the fit that shades it");
                    return Err(self.wrong(format!("approximation[{at}].{kind}"), what));
                }
            }
        }
        let names: Vec<&str> = scene.approximations.iter().map(|a| a.name.as_str()).collect();
        self.budgets(&scene.budget, &names)?;
        Ok(())
    }
}
