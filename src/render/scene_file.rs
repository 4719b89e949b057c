//! The TOML of a scene: its keys, and what is checked before anything is rendered.

use std::collections::BTreeMap;
use std::path::{Component, Path};

use super::claims;
use super::error::RenderError;
use super::geometry::{Geometry, Shape};
use super::lobe;
use super::polygon::Polygon;
use super::scene::{
    Approximation, Budget, Convolution, Diffraction, FILES, Factors, Light, LightShape, Material,
    Method, MonteCarlo, ReferenceMethod, SAMPLES_PER_PASS, Scene, Scratch, Spectrum, Straighten,
    TableSource,
};
use super::section::Section;
use super::view::{Projection, View};

/// Shortest and longest wavelength of a scene, nm: 100 nm to 100 µm.
const WAVELENGTHS_NM: [f64; 2] = [100.0, 1e5];
/// Most wavelengths of a spectral picture.
const MAX_WAVELENGTHS: u64 = 401;
/// Most samples per pixel: sample numbers are counted in an f32.
const MAX_SAMPLES: u64 = 1 << 24;
/// Widths of the maps that are convolved, texels.
const MAP_WIDTHS: [u64; 2] = [16, 2048];
/// Largest rank.
const MOST_TERMS: u64 = 256;
/// Coordinates.
pub(super) const ANYWHERE: [f64; 2] = [-1e9, 1e9];
/// Factors and lengths.
pub(super) const POSITIVE: [f64; 2] = [1e-9, 1e9];
/// Radiances and limits of errors.
pub(super) const NOT_NEGATIVE: [f64; 2] = [0.0, 1e9];
/// Angles, degrees.
pub(super) const TURNS_DEG: [f64; 2] = [-360.0, 360.0];
/// Sections of earlier schemas, and what they have become.
const OLD: [(&str, &str); 4] = [
    ("scratch", "[material] with kind = \"scratch\", and geometry.direction_deg"),
    ("surface", "[geometry], and material.reflectance"),
    ("diffraction", "[material.table] of a [material] with kind = \"diffraction\""),
    ("frame", "[[light]] with kind = \"environment\", map, radiance and turn_deg"),
];

impl Scene {
    /// Reads and checks a scene.
    ///
    /// # Errors
    /// [`RenderError::Toml`], [`RenderError::Value`] with line and key.
    pub fn read(path: &Path) -> Result<Self, RenderError> {
        let shown = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|e| RenderError::Toml { path: shown.clone(), report: e.to_string() })?;
        let name = path.file_stem().map_or("scene".into(), |stem| stem.to_string_lossy());
        Self::parse(&name, &shown, &text)
    }

    /// Parses and checks the text of a scene; `path` names it in messages, and files are relative to its
    /// folder.
    ///
    /// # Errors
    /// [`RenderError::Toml`] with the line, [`RenderError::Value`] with line and key.
    pub fn parse(name: &str, path: &str, text: &str) -> Result<Self, RenderError> {
        let mut top = Section::parse(path, text)?;
        if let Some((old, new)) = OLD.iter().find(|(old, _)| top.has(old)) {
            return Err(top.wrong(old, format!("[{old}] is now {new}")));
        }
        let description = top.text("description")?.or(String::new());
        let view = View::read(top.section("view")?.needed()?)?;
        let geometry = Geometry::read(top.section("geometry")?.needed()?)?;
        let material = material(&mut top, path)?;
        check_view(&top, &view, &geometry, &material)?;
        let lights = top.sections("light")?;
        require(!lights.is_empty(), || top.wrong("light", "a scene needs at least one [[light]]"))?;
        let lights = lights.into_iter().map(|section| light(section, &geometry, &material));
        let lights = lights.collect::<Result<Vec<_>, _>>()?;
        let reference = reference(top.section("reference")?.needed()?, &material)?;
        let monte_carlo = monte_carlo(&mut top, reference)?;
        let approximations = approximations(&mut top, &material, &lights)?;
        let names: Vec<&str> = approximations.iter().map(|a| a.name.as_str()).collect();
        let scene = Self {
            budget: budgets(&mut top, &names)?,
            choice: top.section("choice")?.value.map(budget).transpose()?,
            claims: claims::read(&mut top, &names)?,
            name: name.to_owned(),
            origin: path.to_owned(),
            description,
            view,
            geometry,
            material,
            lights,
            reference,
            monte_carlo,
            approximations,
        };
        let (elsewhere, kind) = match scene.material {
            Material::Scratch(..) => ("convolution", "material.kind = \"scratch\""),
            Material::Diffraction(..) => {
                ("spectrum", "material.kind = \"diffraction\": its table has R, G and B")
            }
        };
        top.done(&[elsewhere], kind)?;
        Ok(scene)
    }
}

/// Passes where a value makes sense.
pub(super) fn require(sense: bool, fault: impl FnOnce() -> RenderError) -> Result<(), RenderError> {
    if sense { Ok(()) } else { Err(fault()) }
}

fn material(top: &mut Section, path: &str) -> Result<Material, RenderError> {
    let mut section = top.section("material")?.needed()?;
    let kinds = [("scratch", true), ("diffraction", false)];
    let scratch = ["width_um", "depth_um", "coherence_radius_um"];
    if section.named("kind", &kinds)?.needed()? {
        section.only(&scratch, &["reflectance", "table"], "kind = \"scratch\"")?;
        let mut length = |key, from, to| section.number(key, [from, to])?.needed();
        let scratch = Scratch {
            width_um: length("width_um", 1e-3, 1e4)?,
            depth_um: length("depth_um", 0.0, 1e4)?,
            coherence_radius_um: length("coherence_radius_um", 0.1, 1e5)?,
        };
        return Ok(Material::Scratch(scratch, spectrum(top.section("spectrum")?.needed()?)?));
    }
    let reflectance = section.numbers("reflectance", [0.0, 1.0])?.or([1.0; 3]);
    let table = table(section.section("table")?.needed()?, path)?;
    section.done(&scratch, "kind = \"diffraction\"")?;
    let convolution = convolution(top.section("convolution")?.needed()?)?;
    Ok(Material::Diffraction(Diffraction { reflectance, table }, convolution))
}

fn table(mut section: Section, path: &str) -> Result<TableSource, RenderError> {
    if let Some(file) = section.text("file")?.value {
        section.done(&[], "")?;
        let folder = Path::new(path).parent().unwrap_or(Path::new("."));
        return Ok(TableSource::File(folder.join(file)));
    }
    let settings = section.settings()?.into_iter();
    Ok(TableSource::Simulated(settings.map(|(key, value)| format!("{key}={value}")).collect()))
}

fn spectrum(mut section: Section) -> Result<Spectrum, RenderError> {
    if section.named("kind", &[("rgb", true), ("spectral", false)])?.needed()? {
        let wavelengths = section.numbers("wavelengths_nm", WAVELENGTHS_NM)?.needed()?;
        section.done(&["from_nm", "to_nm", "samples"], "kind = \"rgb\"")?;
        return Ok(Spectrum::Rgb(wavelengths));
    }
    let from = section.number("from_nm", WAVELENGTHS_NM)?.needed()?;
    let to = section.number("to_nm", WAVELENGTHS_NM)?.needed()?;
    require(from < to, || section.wrong("to_nm", format!("expected more than {from}, got {to}")))?;
    let count = section.count("samples", [2, MAX_WAVELENGTHS])?.needed()?;
    section.done(&["wavelengths_nm"], "kind = \"spectral\"")?;
    let step = (to - from) / (count - 1) as f64;
    Ok(Spectrum::Spectral((0..count).map(|i| from + step * i as f64).collect()))
}

fn convolution(mut section: Section) -> Result<Convolution, RenderError> {
    let map_width = section.count("map_width", MAP_WIDTHS)?.needed()? as usize;
    require(map_width.is_multiple_of(2), || {
        section.wrong("map_width", format!("expected an even number, got {map_width}"))
    })?;
    let ways =
        [("lookup", Straighten::Lookup), ("back", Straighten::Back), ("none", Straighten::None)];
    let straighten = section.named("straighten", &ways)?.or(Straighten::Lookup);
    let align = section.flag("align")?.or(false);
    section.done(&[], "")?;
    Ok(Convolution { map_width, align, straighten })
}

/// That view, geometry and material are of one kind of scene.
fn check_view(
    top: &Section,
    view: &View,
    geometry: &Geometry,
    material: &Material,
) -> Result<(), RenderError> {
    let is_camera = matches!(view.projection, Projection::Camera(_));
    let is_point = matches!(geometry.shape, Shape::Point { .. });
    let (kind, view, shape) = match material {
        Material::Scratch(..) => ("scratch", (!is_camera, "equirectangular"), (is_point, "point")),
        Material::Diffraction(..) => {
            let shapes = "rectangle\", \"disc\" or \"sphere";
            ("diffraction", (is_camera, "camera"), (!is_point, shapes))
        }
    };
    for ((fits, what), key) in [(view, "view.kind"), (shape, "geometry.shape")] {
        let seen = || format!("material.kind = \"{kind}\" is seen with {key} = \"{what}\"");
        require(fits, || top.wrong(key, seen()))?;
    }
    Ok(())
}

fn light(
    mut section: Section,
    geometry: &Geometry,
    material: &Material,
) -> Result<Light, RenderError> {
    const KINDS: [&str; 3] = ["sphere", "polygon", "environment"];
    let kind = section.named("kind", &KINDS.map(|name| (name, name)))?.needed()?;
    let (suits, what) = match material {
        Material::Scratch(..) => {
            (kind != "environment", "a scratch at a point is lit by \"sphere\" and \"polygon\"")
        }
        Material::Diffraction(..) => {
            (kind == "environment", "a diffractive surface is lit by \"environment\"")
        }
    };
    require(suits, || section.wrong("kind", format!("{what}, got \"{kind}\"")))?;
    let spectral = matches!(material, Material::Scratch(_, Spectrum::Spectral(_)));
    let radiance = section.colour("radiance", NOT_NEGATIVE)?.or([1.0; 3]);
    require(!spectral || radiance == [radiance[0]; 3], || {
        let what = "three radiances need spectrum.kind = \"rgb\"; give one number";
        section.wrong("radiance", what)
    })?;
    let shape = match kind {
        "sphere" => {
            let centre: [f64; 3] = section.numbers("centre", ANYWHERE)?.needed()?;
            let radius = section.number("radius", POSITIVE)?.needed()?;
            let distance = centre.iter().map(|x| x * x).sum::<f64>().sqrt();
            require(radius < distance * (1.0 - 1e-6), || {
                let what = format!("{radius} reaches the scratch, {distance} from the centre");
                section.wrong("radius", what)
            })?;
            LightShape::Sphere { centre, radius }
        }
        "polygon" => {
            let vertices = section.points("vertices")?.needed()?;
            let polygon = Polygon::new(&vertices)
                .map_err(|fault| section.wrong("vertices", fault.to_string()))?;
            if let Shape::Point { direction_deg } = geometry.shape {
                // What is shaded is rounded: it must be a polygon too.
                lobe::turned(&polygon, direction_deg)
                    .map_err(|fault| section.wrong("vertices", format!("in f32, {fault}")))?;
            }
            LightShape::Polygon(polygon)
        }
        _ => {
            let map = section.text("map")?.needed()?;
            require(!map.is_empty(), || section.wrong("map", "is empty"))?;
            let turn_rad = section.number("turn_deg", TURNS_DEG)?.or(0.0).to_radians();
            LightShape::Environment { map, turn_rad }
        }
    };
    let own = ["centre", "radius", "vertices", "map", "turn_deg"];
    section.done(&own, &format!("kind = \"{kind}\""))?;
    Ok(Light { shape, radiance })
}

fn reference(mut section: Section, material: &Material) -> Result<ReferenceMethod, RenderError> {
    use ReferenceMethod::{Full, Integral, MonteCarlo, Quadrature};
    let methods: &[(&str, ReferenceMethod)] = match material {
        Material::Scratch(..) => &[("quadrature", Quadrature), ("monte_carlo", MonteCarlo)],
        Material::Diffraction(..) => {
            &[("full", Full), ("integral", Integral), ("monte_carlo", MonteCarlo)]
        }
    };
    let method = section.named("method", methods)?;
    section.done(&[], "")?;
    method.needed()
}

fn monte_carlo(
    top: &mut Section,
    reference: ReferenceMethod,
) -> Result<Option<MonteCarlo>, RenderError> {
    let Some(mut section) = top.section("monte_carlo")?.value else {
        require(reference != ReferenceMethod::MonteCarlo, || {
            let what = "reference.method = \"monte_carlo\" needs a section [monte_carlo]";
            top.wrong("monte_carlo", what)
        })?;
        return Ok(None);
    };
    require(reference != ReferenceMethod::Full, || {
        let what = "samples estimate the sum over the table, and reference.method = \"full\" is another quantity, under \
                    n = view = mirror direction: \"integral\" can be held against them";
        section.wrong("", what)
    })?;
    let pass = u64::from(SAMPLES_PER_PASS);
    let samples = section.count("samples", [2 * pass, MAX_SAMPLES])?.needed()?;
    require(samples.is_multiple_of(pass), || {
        section.wrong("samples", format!("expected a multiple of {pass}, got {samples}"))
    })?;
    let seed = section.count("seed", [0, u64::MAX])?.or(1);
    section.done(&[], "")?;
    Ok(Some(MonteCarlo { samples: samples as u32, seed }))
}

fn approximations(
    top: &mut Section,
    material: &Material,
    lights: &[Light],
) -> Result<Vec<Approximation>, RenderError> {
    let mut found: Vec<Approximation> = Vec::new();
    for mut section in top.sections("approximation")? {
        let name = section.text("name")?.needed()?;
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        require(!name.is_empty() && name.chars().all(plain), || {
            section.wrong("name", format!("expected letters, digits, _ and -, got \"{name}\""))
        })?;
        require(!FILES.contains(&name.as_str()), || {
            section.wrong("name", format!("\"{name}\" names another file"))
        })?;
        require(found.iter().all(|other| other.name != name), || {
            section.wrong("name", format!("\"{name}\" is there twice"))
        })?;
        let method = match material {
            Material::Scratch(..) => forms(section, lights)?,
            Material::Diffraction(..) => convolved(section)?,
        };
        found.push(Approximation { name, method });
    }
    let is_empty = found.is_empty() && matches!(material, Material::Diffraction(..));
    let what = "a scene needs at least one [[approximation]]";
    require(!is_empty, || top.wrong("approximation", what))?;
    Ok(found)
}

fn forms(mut section: Section, lights: &[Light]) -> Result<Method, RenderError> {
    let mut of = |kind, is_lit: bool| {
        let name = section.text(kind)?.value;
        if let Some(name) = name.as_ref().filter(|name| !is_in_project(name)) {
            let what = format!("expected a name inside the project, got \"{name}\"");
            return Err(section.wrong(kind, what));
        }
        require(name.is_some() || !is_lit, || {
            let what = format!("the scene has a {kind}: name the fit or form that shades it");
            section.wrong(kind, what)
        })?;
        Ok(name.filter(|_| is_lit))
    };
    let lit = |of: fn(&LightShape) -> bool| lights.iter().any(|light| of(&light.shape));
    let sphere = of("sphere", lit(|shape| matches!(shape, LightShape::Sphere { .. })))?;
    let polygon = of("polygon", lit(|shape| matches!(shape, LightShape::Polygon(_))))?;
    section.done(&["method", "rank", "factors", "fitted_to"], "material.kind = \"scratch\"")?;
    Ok(Method::Forms { sphere, polygon })
}

fn convolved(mut section: Section) -> Result<Method, RenderError> {
    const METHODS: [&str; 5] = ["two_pass", "printed", "sum", "line", "reconstructed"];
    let name = section.named("method", &METHODS.map(|name| (name, name)))?.needed()?;
    let mut rank = || Ok::<_, RenderError>(section.count("rank", [1, MOST_TERMS])?.or(1) as usize);
    let method = match name {
        "two_pass" => {
            let rank = rank()?;
            let ways = [("svd", false), ("convolution", true)];
            let factors = match section.named("factors", &ways)?.or(false) {
                true => Factors::Convolution(section.texts("fitted_to")?.or(Vec::new())),
                false => Factors::Svd,
            };
            Method::TwoPass { rank, factors }
        }
        "printed" => Method::Printed { rank: rank()? },
        "reconstructed" => Method::Reconstructed { rank: rank()? },
        "sum" => Method::Sum,
        _ => Method::Line,
    };
    let elsewhere = ["rank", "factors", "fitted_to", "sphere", "polygon"];
    section.done(&elsewhere, &format!("method = \"{name}\""))?;
    Ok(method)
}

/// Whether a fit or a file is named by its place in the project: no `..`, no absolute path.
fn is_in_project(name: &str) -> bool {
    let plain = |part| matches!(part, Component::Normal(_) | Component::CurDir);
    !name.contains('\\') && Path::new(name).components().all(plain)
}

fn budgets(top: &mut Section, names: &[&str]) -> Result<BTreeMap<String, Budget>, RenderError> {
    let Some(mut section) = top.section("budget")?.value else { return Ok(BTreeMap::new()) };
    let named = section.by_name()?.into_iter();
    named
        .map(|(name, section)| {
            let is_there = names.contains(&name.as_str());
            require(is_there, || section.wrong("", "there is no approximation of that name"))?;
            Ok((name, budget(section)?))
        })
        .collect()
}

fn budget(mut section: Section) -> Result<Budget, RenderError> {
    let budget = Budget {
        relative_rms: section.number("relative_rms", NOT_NEGATIVE)?.value,
        flip: section.number("flip", NOT_NEGATIVE)?.value,
    };
    require(budget != Budget::default() || section.is_left(), || {
        section.wrong("", "expected `relative_rms`, `flip` or both, got neither")
    })?;
    section.done(&[], "")?;
    Ok(budget)
}
