//! The TOML of a surface scene: its keys, and what is checked before anything is rendered.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::camera::Camera;
use super::scene::{
    Approximation, Convolution, Factors, Frame, Method, ReferenceMethod, Straighten, SurfaceScene,
    TableSource,
};
use super::shape::{self, Shape};
use crate::render::RenderError;
use crate::render::scene::{Budget, FILES, MAX_PIXELS};
use crate::render::scene_keys::Keys;

/// Widths of the maps that are convolved, texels.
const MAP_WIDTHS: [f64; 2] = [16.0, 2048.0];
/// Largest rank.
const MOST_TERMS: f64 = 256.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    #[serde(default)]
    description: String,
    view: ViewFile,
    surface: SurfaceFile,
    diffraction: BTreeMap<String, toml::Value>,
    #[serde(default)]
    frame: Vec<FrameFile>,
    convolution: ConvolutionFile,
    reference: ReferenceFile,
    #[serde(default)]
    approximation: Vec<ApproximationFile>,
    #[serde(default)]
    budget: BTreeMap<String, Budget>,
    choice: Option<Budget>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ViewFile {
    kind: String,
    width: i64,
    height: i64,
    position: [f64; 3],
    target: [f64; 3],
    field_of_view_deg: f64,
    exposure: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SurfaceFile {
    shape: String,
    #[serde(default)]
    centre: [f64; 3],
    normal: [f64; 3],
    tangent: [f64; 3],
    half_size: Option<[f64; 2]>,
    radii: Option<[f64; 2]>,
    radius: Option<f64>,
    reflectance: Option<[f64; 3]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FrameFile {
    environment: String,
    #[serde(default)]
    turn_deg: f64,
    scale: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ConvolutionFile {
    map_width: i64,
    #[serde(default)]
    align: bool,
    straighten: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReferenceFile {
    method: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ApproximationFile {
    name: String,
    method: String,
    rank: Option<i64>,
    factors: Option<String>,
}

impl SurfaceScene {
    /// Parses and checks a scene; `path` names it in messages, and files are relative to its folder.
    ///
    /// # Errors
    /// [`RenderError::Toml`] with the line, [`RenderError::Value`] with the key.
    pub fn parse(name: &str, path: &str, text: &str) -> Result<Self, RenderError> {
        let file: SceneFile = toml::from_str(text).map_err(|error| RenderError::Toml {
            path: path.to_owned(),
            report: error.to_string().trim_end().to_owned(),
        })?;
        let keys = Keys { path };
        let (camera, exposure) = keys.camera(&file.view)?;
        let scene = Self {
            name: name.to_owned(),
            description: file.description,
            camera,
            exposure,
            shape: keys.shape(&file.surface)?,
            reflectance: keys.reflectance(file.surface.reflectance)?,
            table: keys.table(file.diffraction)?,
            frames: keys.frames(file.frame)?,
            convolution: keys.convolution(&file.convolution)?,
            reference: match file.reference.method.as_str() {
                "full" => ReferenceMethod::Full,
                "integral" => ReferenceMethod::Integral,
                other => {
                    let known = "\"full\" or \"integral\"";
                    return Err(keys.unknown_kind("reference.method", other, known));
                }
            },
            approximations: keys.approximations_of_surface(file.approximation)?,
            budget: file.budget,
            choice: file.choice,
        };
        let names: Vec<&str> = scene.approximations.iter().map(|a| a.name.as_str()).collect();
        keys.budgets(&scene.budget, &names)?;
        if let Some(choice) = &scene.choice {
            keys.budget("choice", choice)?;
        }
        Ok(scene)
    }
}

impl Keys<'_> {
    fn camera(&self, view: &ViewFile) -> Result<(Camera, f64), RenderError> {
        if view.kind != "camera" {
            return Err(self.unknown_kind("view.kind", &view.kind, "\"camera\""));
        }
        let most = MAX_PIXELS as f64;
        let side = |key: &str, value: i64| self.within(key, value as f64, 1.0, most);
        let width = side("view.width", view.width)? as usize;
        let height = side("view.height", view.height)? as usize;
        if width.saturating_mul(height) > MAX_PIXELS {
            let what = format!("{width} by {height} pixels are more than {MAX_PIXELS}");
            return Err(self.wrong("view.height", what));
        }
        self.vector("view.position", view.position)?;
        self.vector("view.target", view.target)?;
        let apart: f64 = view.position.iter().zip(view.target).map(|(a, b)| (a - b).powi(2)).sum();
        if apart == 0.0 {
            return Err(self.wrong("view.target", "is where the camera is"));
        }
        let degrees = self.within("view.field_of_view_deg", view.field_of_view_deg, 1.0, 150.0)?;
        let exposure = self.within("view.exposure", view.exposure.unwrap_or(1.0), 1e-9, 1e9)?;
        let (position, target) = (view.position, view.target);
        let field_of_view_rad = degrees.to_radians();
        Ok((Camera { position, target, field_of_view_rad, width, height }, exposure))
    }

    fn vector(&self, key: &str, vector: [f64; 3]) -> Result<(), RenderError> {
        vector.iter().try_for_each(|value| self.within(key, *value, -1e9, 1e9).map(|_| ()))
    }

    fn shape(&self, surface: &SurfaceFile) -> Result<Shape, RenderError> {
        for (key, vector) in [
            ("surface.centre", surface.centre),
            ("surface.normal", surface.normal),
            ("surface.tangent", surface.tangent),
        ] {
            self.vector(key, vector)?;
        }
        if surface.normal == [0.0; 3] {
            return Err(self.wrong("surface.normal", "expected a vector that is not 0"));
        }
        let frame = shape::Frame::new(surface.normal, surface.tangent, 0.0);
        let centre = surface.centre;
        let positive = |key: &str, value: f64| self.within(key, value, 1e-6, 1e9);
        let kind = surface.shape.as_str();
        let only = |own: &str| {
            for (key, is_there) in [
                ("half_size", surface.half_size.is_some()),
                ("radii", surface.radii.is_some()),
                ("radius", surface.radius.is_some()),
            ] {
                if is_there && key != own {
                    let what = format!("means nothing with shape = \"{kind}\"");
                    return Err(self.wrong(format!("surface.{key}"), what));
                }
            }
            Ok(())
        };
        match kind {
            "rectangle" => {
                only("half_size")?;
                let half_size = self.needed("surface.half_size", surface.half_size)?;
                for side in half_size {
                    positive("surface.half_size", side)?;
                }
                Ok(Shape::Rectangle { centre, half_size, frame })
            }
            "disc" => {
                only("radii")?;
                let radii = self.needed("surface.radii", surface.radii)?;
                self.within("surface.radii", radii[0], 0.0, 1e9)?;
                self.within("surface.radii", radii[1], radii[0], 1e9)?;
                Ok(Shape::Disc { centre, radii, frame })
            }
            "sphere" => {
                only("radius")?;
                let radius =
                    positive("surface.radius", self.needed("surface.radius", surface.radius)?)?;
                Ok(Shape::Sphere { centre, radius, frame })
            }
            other => {
                let known = "\"rectangle\", \"disc\" or \"sphere\"";
                Err(self.unknown_kind("surface.shape", other, known))
            }
        }
    }

    fn reflectance(&self, reflectance: Option<[f64; 3]>) -> Result<[f64; 3], RenderError> {
        let reflectance = reflectance.unwrap_or([1.0; 3]);
        for value in reflectance {
            self.within("surface.reflectance", value, 0.0, 1.0)?;
        }
        Ok(reflectance)
    }

    fn table(&self, settings: BTreeMap<String, toml::Value>) -> Result<TableSource, RenderError> {
        let text = |key: &str, value: &toml::Value| match value {
            toml::Value::String(text) => Ok(text.clone()),
            toml::Value::Integer(number) => Ok(number.to_string()),
            toml::Value::Float(number) => Ok(number.to_string()),
            toml::Value::Boolean(flag) => Ok(flag.to_string()),
            other => {
                let what =
                    format!("expected text, a number or a truth value, got {}", other.type_str());
                Err(self.wrong(format!("diffraction.{key}"), what))
            }
        };
        if let Some(file) = settings.get("table") {
            if let Some(key) = settings.keys().find(|key| *key != "table") {
                let what = "means nothing beside diffraction.table";
                return Err(self.wrong(format!("diffraction.{key}"), what));
            }
            let folder = Path::new(self.path).parent().unwrap_or(Path::new("."));
            return Ok(TableSource::File(folder.join(text("table", file)?)));
        }
        let lines = settings.iter().map(|(key, value)| Ok(format!("{key}={}", text(key, value)?)));
        Ok(TableSource::Simulated(lines.collect::<Result<_, RenderError>>()?))
    }

    fn frames(&self, frames: Vec<FrameFile>) -> Result<Vec<Frame>, RenderError> {
        if frames.is_empty() {
            return Err(self.wrong("frame", "a scene needs at least one [[frame]]"));
        }
        let numbered = frames.into_iter().enumerate();
        numbered
            .map(|(at, frame)| {
                let key = |name: &str| format!("frame[{at}].{name}");
                let turn = self.within(&key("turn_deg"), frame.turn_deg, -360.0, 360.0)?;
                let scale = self.within(&key("scale"), frame.scale.unwrap_or(1.0), 1e-9, 1e9)?;
                let environment = frame.environment;
                if environment.is_empty() {
                    return Err(self.wrong(key("environment"), "is empty"));
                }
                Ok(Frame { environment, turn_rad: turn.to_radians(), scale })
            })
            .collect()
    }

    fn convolution(&self, section: &ConvolutionFile) -> Result<Convolution, RenderError> {
        let [least, most] = MAP_WIDTHS;
        let key = "convolution.map_width";
        let width = self.within(key, section.map_width as f64, least, most)? as usize;
        if !width.is_multiple_of(2) {
            return Err(self.wrong(key, format!("expected an even number, got {width}")));
        }
        let straighten = match section.straighten.as_deref() {
            None | Some("lookup") => Straighten::Lookup,
            Some("back") => Straighten::Back,
            Some("none") => Straighten::None,
            Some(other) => {
                let known = "\"lookup\", \"back\" or \"none\"";
                return Err(self.unknown_kind("convolution.straighten", other, known));
            }
        };
        Ok(Convolution { map_width: width, align: section.align, straighten })
    }

    fn approximations_of_surface(
        &self,
        files: Vec<ApproximationFile>,
    ) -> Result<Vec<Approximation>, RenderError> {
        if files.is_empty() {
            return Err(self.wrong("approximation", "a scene needs at least one [[approximation]]"));
        }
        let mut chosen: Vec<Approximation> = Vec::new();
        for (at, file) in files.into_iter().enumerate() {
            let key = |name: &str| format!("approximation[{at}].{name}");
            let known: Vec<&str> = chosen.iter().map(|other| other.name.as_str()).collect();
            self.approximation_name(&key("name"), &file.name, &known)?;
            let ranked = matches!(file.method.as_str(), "two_pass" | "printed" | "reconstructed");
            if !ranked {
                self.unwanted(&key("rank"), &file.rank, &file.method)?;
            }
            if file.method != "two_pass" {
                self.unwanted(&key("factors"), &file.factors, &file.method)?;
            }
            let terms = file.rank.unwrap_or(1) as f64;
            let rank = self.within(&key("rank"), terms, 1.0, MOST_TERMS)? as usize;
            let factors = match file.factors.as_deref() {
                None | Some("svd") => Factors::Svd,
                Some("convolution") => Factors::Convolution,
                Some(other) => {
                    let known = "\"svd\" or \"convolution\"";
                    return Err(self.unknown_kind(&key("factors"), other, known));
                }
            };
            let method = match file.method.as_str() {
                "two_pass" => Method::TwoPass { rank, factors },
                "printed" => Method::Printed { rank },
                "sum" => Method::Sum,
                "line" => Method::Line,
                "reconstructed" => Method::Reconstructed { rank },
                other => {
                    let known = "\"two_pass\", \"printed\", \"sum\", \"line\" or \"reconstructed\"";
                    return Err(self.unknown_kind(&key("method"), other, known));
                }
            };
            chosen.push(Approximation { name: file.name, method });
        }
        Ok(chosen)
    }

    /// A name that can name files, none of [`FILES`] and not in `taken`.
    pub(in crate::render) fn approximation_name(
        &self,
        key: &str,
        name: &str,
        taken: &[&str],
    ) -> Result<(), RenderError> {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if name.is_empty() || !name.chars().all(plain) {
            let what = format!("expected letters, digits, _ and -, got \"{name}\"");
            return Err(self.wrong(key, what));
        }
        if FILES.contains(&name) {
            return Err(self.wrong(key, format!("\"{name}\" names another file")));
        }
        if taken.contains(&name) {
            return Err(self.wrong(key, format!("\"{name}\" is there twice")));
        }
        Ok(())
    }

    /// Budgets of approximations that are there.
    pub(in crate::render) fn budgets(
        &self,
        budgets: &BTreeMap<String, Budget>,
        names: &[&str],
    ) -> Result<(), RenderError> {
        for (name, budget) in budgets {
            if !names.contains(&name.as_str()) {
                let what = "there is no approximation of that name";
                return Err(self.wrong(format!("budget.{name}"), what));
            }
            self.budget(&format!("budget.{name}"), budget)?;
        }
        Ok(())
    }

    fn budget(&self, key: &str, budget: &Budget) -> Result<(), RenderError> {
        if *budget == Budget::default() {
            return Err(self.wrong(key, "expected `relative_rms`, `flip` or both, got neither"));
        }
        for (name, limit) in [("relative_rms", budget.relative_rms), ("flip", budget.flip)] {
            if let Some(limit) = limit {
                self.within(&format!("{key}.{name}"), limit, 0.0, 1e9)?;
            }
        }
        Ok(())
    }
}
