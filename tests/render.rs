//! Rendering: Monte Carlo against the reference, lanes against the device, the scenes that are
//! committed, and what is seen while they are rendered.

use std::path::PathBuf;

use striae::gpu::{self, Device};
use striae::project::Project;
use striae::registry::Registry;
use striae::render::image::Image;
use striae::render::{Backend, Event, PreparedScene, Rendered, Scene, render};

const VIEW: &str = "[view]\nkind = \"equirectangular\"\nwidth = 32\nheight = 16\nexposure = 10\n";
const SCRATCH: &str = "[geometry]\nshape = \"point\"\ndirection_deg = 90\n\
    [material]\nkind = \"scratch\"\nwidth_um = 3\ndepth_um = 0.133\ncoherence_radius_um = 20\n";
const SPHERE: &str = "[[light]]\nkind = \"sphere\"\ncentre = [0.35, 0.1, 1.0]\nradius = 0.2\n\
    radiance = 4\n";
const POLYGON: &str = "[[light]]\nkind = \"polygon\"\n\
    vertices = [[0.1, -0.2, 1.0], [0.6, 0.0, 1.0], [0.3, 0.05, 1.0], [0.3, 0.4, 1.0]]\n\
    radiance = [2, 1, 0.5]\n";
const RGB: &str = "[spectrum]\nkind = \"rgb\"\nwavelengths_nm = [650, 532, 450]\n";
const QUADRATURE: &str = "[reference]\nmethod = \"quadrature\"\n";
const MONTE_CARLO: &str = "[monte_carlo]\nsamples = 1024\nseed = 3\n";

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Both lights of the tests by registered forms with the constants of their texts.
const LINE: &str = "[[approximation]]\nname = \"line\"\n\
    sphere = \"form:area_light/sphere_line_exact_si\"\n\
    polygon = \"form:area_light/triangle_line_exact_si\"\n";

fn project() -> Project {
    Project::at(root(), Registry::builtin())
}

fn prepared(parts: &[&str]) -> PreparedScene {
    let scene = Scene::parse("test", "test.toml", &parts.concat()).expect("a scene");
    PreparedScene::new(scene, &project()).expect("forms and wavelengths")
}

fn rendered(scene: &PreparedScene, backend: Backend<'_>) -> Rendered {
    render(scene, backend, &mut |_| {}).expect("renders")
}

fn values<'a>(image: &'a Image, prefix: &str) -> Vec<&'a f32> {
    let channels = image.channels.iter().filter(|c| c.name.starts_with(prefix));
    channels.flat_map(|channel| &channel.values).collect()
}

#[test]
fn monte_carlo_agrees_with_the_reference() {
    for light in [SPHERE, POLYGON] {
        let scene = prepared(&[VIEW, SCRATCH, light, RGB, QUADRATURE, MONTE_CARLO]);
        let rendered = rendered(&scene, Backend::Lanes);
        let metrics = rendered.monte_carlo.expect("Monte Carlo was asked for").metrics;
        let test = metrics.expect("it is compared").z_test.expect("it has standard errors");
        assert!(test.passes(1e-3), "{test:?}");
        // 64 pixels or more share some light: this is no comparison of black with black.
        let lit = values(&rendered.reference, "").into_iter().filter(|x| **x > 1e-3).count();
        assert!(lit > 64, "{lit}");
    }
}

#[test]
fn a_closed_form_is_near_the_reference_on_lanes() {
    let scene = prepared(&[VIEW, SCRATCH, SPHERE, POLYGON, RGB, QUADRATURE, LINE]);
    let rendered = rendered(&scene, Backend::Lanes);
    let metrics = &rendered.approximations[0].metrics;
    // One slice for a Gaussian as wide as a fortieth of these lights.
    assert!(metrics.relative_rms < 0.1, "{metrics:?}");
    assert!(rendered.times.value().is_none(), "lanes are not timed");
}

#[test]
fn lanes_and_device_draw_the_same_picture() {
    let device = match Device::open() {
        Ok(device) => device,
        Err(error) if gpu::required() => panic!("{error}"),
        Err(error) => return println!("skipped: {error}"),
    };
    let few = "[monte_carlo]\nsamples = 256\n";
    let scene = prepared(&[VIEW, SCRATCH, SPHERE, POLYGON, RGB, QUADRATURE, few, LINE]);
    let [here, there] = [Backend::Lanes, Backend::Device(&device)].map(|b| rendered(&scene, b));
    let sampled = |rendered: &Rendered| {
        rendered.monte_carlo.as_ref().map(|m| m.sampled.image.clone()).expect("asked for")
    };
    let pairs = [
        (sampled(&here), sampled(&there)),
        (
            here.approximations[0].picture.image.clone(),
            there.approximations[0].picture.image.clone(),
        ),
    ];
    for (a, b) in pairs {
        for (name, x, y) in a.channels.iter().zip(&b.channels).map(|(x, y)| (&x.name, x, y)) {
            let largest = x.values.iter().fold(0.0_f32, |m, v| m.max(v.abs()));
            let apart =
                x.values.iter().zip(&y.values).fold(0.0_f32, |m, (a, b)| m.max((a - b).abs()));
            // The same draws: what differs is the device's sine, exp and division.
            assert!(apart <= 1e-3 * largest && apart.is_finite(), "{name}: {apart} of {largest}");
        }
    }
    let law = there.monte_carlo.expect("asked for").convergence;
    let law = law.value().expect("two numbers of samples");
    // The exponent of so small an image is noise; full scenes measure -0.46 to -0.52.
    assert!(law.rms[1] < law.rms[0], "{law:?}");
}

#[test]
fn a_seed_is_another_picture_and_the_same_seed_the_same() {
    let drawn = |seed: &str| {
        let options = format!("[monte_carlo]\nsamples = 128\nseed = {seed}\n");
        let reference = "[reference]\nmethod = \"monte_carlo\"\n";
        let scene = prepared(&[VIEW, SCRATCH, SPHERE, RGB, reference, &options]);
        rendered(&scene, Backend::Lanes).reference
    };
    let first = drawn("1");
    assert_eq!(first, drawn("1"));
    assert_ne!(first, drawn("2"));
    assert_eq!(values(&first, "stderr.").len(), 3 * 32 * 16);
}

#[test]
fn a_spectrum_of_many_wavelengths_and_lights_is_the_sum_of_its_kernels() {
    // 17 wavelengths and 17 spheres need four kernels; so many equal lights give 17 times one.
    let spectrum = "[spectrum]\nkind = \"spectral\"\nfrom_nm = 400\nto_nm = 700\nsamples = 17\n";
    let picture = |count: usize| {
        let view = VIEW.replace("width = 32\nheight = 16", "width = 8\nheight = 6");
        let scene = prepared(&[&view, SCRATCH, &SPHERE.repeat(count), spectrum, QUADRATURE, LINE]);
        rendered(&scene, Backend::Lanes).approximations.remove(0).picture
    };
    let (one, many) = (picture(1), picture(17));
    for (x, y) in one.image.channels.iter().zip(&many.image.channels) {
        for (x, y) in x.values.iter().zip(&y.values) {
            assert!((17.0 * x - y).abs() <= 2e-5 * y.abs() + 1e-6, "{x} {y}");
        }
    }
}

#[test]
fn the_committed_scenes_read_and_what_they_name_loads() {
    let scenes = project().scenes().expect("a folder");
    assert!(scenes.len() >= 8, "{scenes:?}");
    for path in scenes {
        let scene = Scene::read(&path).expect("a scene");
        assert!(!scene.description.is_empty(), "{}", path.display());
        assert!(!scene.claims.is_empty(), "{}", path.display());
        // Surfaces simulate their table, which takes a while: tests/surfaces.rs reads them.
        if scene.frames() == 1 {
            PreparedScene::new(scene, &project()).expect("its forms load");
        }
    }
}

#[test]
fn events_come_in_order_and_every_image_is_whole() {
    let scene = prepared(&[VIEW, SCRATCH, SPHERE, RGB, QUADRATURE, LINE]);
    let mut seen = Vec::new();
    render(&scene, Backend::Lanes, &mut |event| {
        if let Event::Image { name, image, whole } = event {
            seen.push((name.to_owned(), whole && image.channels[0].values.len() == 512));
        }
    })
    .expect("renders");
    assert_eq!(seen, [("reference".to_owned(), true), ("line".to_owned(), true)]);
}

#[test]
fn a_picture_is_made_once_whoever_asks() {
    let scene = prepared(&[VIEW, SCRATCH, SPHERE, RGB, QUADRATURE, LINE]);
    let mut tiles = 0;
    let mut count = |event: Event<'_>| tiles += i32::from(matches!(event, Event::Tile { .. }));
    let first = scene.picture(0, Backend::Lanes, &mut count).expect("renders");
    let again = scene.picture(0, Backend::Lanes, &mut count).expect("it is there");
    assert!(std::sync::Arc::ptr_eq(&first, &again));
    let reference = scene.exact(&mut count).expect("it is there");
    assert!(std::ptr::eq(reference, scene.exact(&mut count).expect("it is there")));
    // The picture has one tile; the reference was made for its metrics, unwatched.
    assert_eq!(tiles, 1);
    // What a render shows is that picture.
    let rendered = rendered(&scene, Backend::Lanes);
    assert!(std::sync::Arc::ptr_eq(&first, &rendered.approximations[0].picture));
    assert!(scene.picture(1, Backend::Lanes, &mut |_| ()).is_err());
}

#[test]
fn a_choice_and_claims_are_for_every_scene() {
    let more = "[choice]\nrelative_rms = 0.2\n[[claim]]\ncheck = \"speed_up\"\n\
                published = \"line\"\n";
    let scene = prepared(&[VIEW, SCRATCH, SPHERE, RGB, QUADRATURE, LINE, more]);
    let rendered = rendered(&scene, Backend::Lanes);
    assert_eq!(rendered.choice, Some(Ok("line".to_owned())));
    let findings = striae::render::claims::findings(&scene.scene, &rendered);
    assert_eq!(findings.len(), 1);
    assert_eq!(findings[0].place, "velinov2018 abstract and §6 (test)");
    assert!(findings[0].verdict.starts_with("not measured: "), "{findings:?}");
}
