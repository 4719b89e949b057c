//! A scene of either kind, told by its view.

use std::path::Path;

use super::error::RenderError;
use super::scene::Scene;
use super::surface::SurfaceScene;

/// A scene of either kind.
#[derive(Debug, Clone, PartialEq)]
pub enum AnyScene {
    /// The lobe of a scratch over view directions: [`crate::render::scene`].
    Lobe(Box<Scene>),
    /// A surface before a camera: [`crate::render::surface::scene`].
    Surface(Box<SurfaceScene>),
}

impl AnyScene {
    /// Reads and checks a scene: a surface where `view.kind` is `"camera"`, else a lobe.
    ///
    /// # Errors
    /// As [`Scene::read`] and [`SurfaceScene::parse`].
    pub fn read(path: &Path) -> Result<Self, RenderError> {
        let shown = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|source| RenderError::Io { path: shown.clone(), source })?;
        let name = path.file_stem().map_or("scene".into(), |stem| stem.to_string_lossy());
        let kind = toml::from_str::<toml::Table>(&text).ok();
        let kind = kind.as_ref().and_then(|table| table.get("view")?.get("kind")?.as_str());
        if kind == Some("camera") {
            return Ok(Self::Surface(Box::new(SurfaceScene::parse(&name, &shown, &text)?)));
        }
        Ok(Self::Lobe(Box::new(Scene::parse(&name, &shown, &text)?)))
    }

    /// File name without its extension.
    pub fn name(&self) -> &str {
        match self {
            Self::Lobe(scene) => &scene.name,
            Self::Surface(scene) => &scene.name,
        }
    }

    /// One line.
    pub fn description(&self) -> &str {
        match self {
            Self::Lobe(scene) => &scene.description,
            Self::Surface(scene) => &scene.description,
        }
    }

    /// Names of the approximations.
    pub fn approximations(&self) -> Vec<&str> {
        match self {
            Self::Lobe(scene) => scene.approximations.iter().map(|a| a.name.as_str()).collect(),
            Self::Surface(scene) => scene.approximations.iter().map(|a| a.name.as_str()).collect(),
        }
    }
}
