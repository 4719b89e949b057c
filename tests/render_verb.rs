//! The verb `render` from outside: what it writes, prints and refuses.

use std::path::PathBuf;
use std::time::Duration;

use assert_cmd::Command;
use striae::render::image::Image;

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

/// A temporary folder with a scene and `fits/` in it.
struct Folder(tempfile::TempDir);

impl Folder {
    fn with(scene: &str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        std::fs::create_dir(folder.path().join("fits")).expect("writable");
        std::fs::write(folder.path().join("scene.toml"), scene).expect("writable");
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// `striae render scene.toml -o out` in the folder.
    fn command(&self) -> Command {
        let mut command = Command::cargo_bin("striae").expect("the binary of this package");
        command.current_dir(self.0.path()).env_remove("STRIAE_REQUIRE_GPU");
        command.args(["--project", ".", "render", "scene.toml", "-o", "out"]);
        command.timeout(Duration::from_secs(120));
        command
    }
}

/// Runs the binary on a scene.
fn render(text: &str, more: &[&str]) -> (Folder, std::process::Output) {
    let folder = Folder::with(text);
    let output = folder.command().args(more).output().expect("runs");
    (folder, output)
}

#[test]
fn the_verb_writes_images_and_a_table() {
    let scene = [
        VIEW,
        SCRATCH,
        POLYGON,
        RGB,
        QUADRATURE,
        MONTE_CARLO,
        "[[approximation]]\nname = \"line\"\npolygon = \"form:area_light/triangle_line_printed\"\n",
        "[budget.line]\nrelative_rms = 1e-9\n",
    ]
    .concat();
    let (folder, output) = render(&scene, &["--backend", "cpu"]);
    let table = String::from_utf8_lossy(&output.stdout).into_owned();
    // The published form errs by far more than the budget.
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stderr).contains("over its budget"));
    assert!(table.contains("relative RMS") && table.contains("CPU, f32 lanes"), "{table}");
    for file in [
        "reference.exr",
        "reference.png",
        "monte_carlo.exr",
        "line.exr",
        "line.png",
        "line.error.png",
        "line.error.exr",
        "sheet.png",
        "scene.json",
    ] {
        assert!(folder.path("out").join(file).is_file(), "{file}");
    }
    let image = Image::read(folder.path("out/monte_carlo.exr")).expect("reads back");
    assert_eq!((image.width, image.height, image.channels.len()), (32, 16, 6));
    let errors = Image::read(folder.path("out/line.error.exr")).expect("reads back");
    assert_eq!((errors.width, errors.height, errors.names()), (32, 16, vec!["error"]));
    let json = std::fs::read_to_string(folder.path("out/scene.json")).expect("is there");
    let json: serde_json::Value = serde_json::from_str(&json).expect("is JSON");
    assert_eq!(json["approximations"][0]["name"], "line");
}

#[test]
fn a_device_that_is_asked_for_and_missing_is_exit_four() {
    let folder = Folder::with(&[VIEW, SCRATCH, SPHERE, RGB, QUADRATURE].concat());
    let output = folder
        .command()
        .args(["--backend", "gpu"])
        .env("WGPU_ADAPTER_NAME", "no such adapter")
        .output()
        .expect("runs");
    assert_eq!(output.status.code(), Some(4), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn bad_scenes_are_refused_with_their_key() {
    let whole = [VIEW, SCRATCH, SPHERE, POLYGON, RGB, QUADRATURE, MONTE_CARLO].concat();
    let vertices =
        "vertices = [[0.1, -0.2, 1.0], [0.6, 0.0, 1.0], [0.3, 0.05, 1.0], [0.3, 0.4, 1.0]]";
    let spectral = "kind = \"spectral\"\nfrom_nm = 400\nto_nm = 700\nsamples = 8";
    let cases: &[(&str, &str, &[&str])] = &[
        ("width = 32", "width = 0", &["view.width", "got 0"]),
        ("width = 32", "width = -1", &["view.width", "got -1"]),
        ("height = 16", "height = 1000000", &["view.height", "1000000"]),
        ("exposure = 10", "exposure = nan", &["view.exposure", "NaN"]),
        ("exposure = 10", "exposure = 10\ncolour = 1", &["colour", "unknown field"]),
        ("kind = \"equirectangular\"", "kind = \"fisheye\"", &["view.kind", "fisheye"]),
        ("width_um = 3", "width_um = -3", &["material.width_um", "-3"]),
        ("width_um = 3", "width = 3", &["unknown field `width`"]),
        ("depth_um = 0.133", "depth_um = -0.1", &["material.depth_um"]),
        ("coherence_radius_um = 20", "coherence_radius_um = 0", &["material.coherence_radius_um"]),
        ("radius = 0.2", "radius = -0.2", &["light[0].radius"]),
        ("radius = 0.2", "radius = nan", &["light[0].radius", "NaN"]),
        ("radius = 0.2", "radius = 2.0", &["light[0].radius", "reaches the scratch"]),
        ("radius = 0.2\n", "", &["light[0].radius", "missing"]),
        // A wrong type is named by line and key, with what is expected.
        (
            "width = 32",
            "width = \"wide\"",
            &["scene.toml:3: view.width: expected a whole number", "the string \"wide\""],
        ),
        ("radius = 0.2", "radius = [1]", &["light[0].radius: expected a number", "an array of 1"]),
        ("centre = [0.35, 0.1, 1.0]", "centre = 3", &["light[0].centre: expected 3 numbers"]),
        ("[spectrum]\n", "[[spectrum]]\n", &["spectrum: expected a table [spectrum]"]),
        // Sections of earlier schemas say what they have become.
        (
            "[material]\n",
            "[scratch]\n",
            &["[scratch] is now [material] with kind", "direction_deg"],
        ),
        ("[spectrum]\n", "[[frame]]\n[spectrum]\n", &["[frame] is now [[light]] with kind"]),
        // What means nothing for the material is refused.
        (
            "[reference]\n",
            "[convolution]\nmap_width = 64\n[reference]\n",
            &["convolution: means nothing with material.kind = \"scratch\""],
        ),
        (
            "shape = \"point\"\n",
            "shape = \"point\"\nradius = 1\n",
            &["geometry.radius: means nothing"],
        ),
        (
            "kind = \"sphere\"",
            "kind = \"environment\"",
            &["light[0].kind: a scratch at a point is lit by"],
        ),
        ("method = \"quadrature\"", "method = \"full\"", &["reference.method: expected"]),
        (
            "seed = 3\n",
            "seed = 3\n[[claim]]\ncheck = \"speed_up\"\npublished = \"none\"\n",
            &["claim[0].published: there is no approximation `none`"],
        ),
        (
            "seed = 3\n",
            "seed = 3\n[[claim]]\ncheck = \"frame_rate\"\n",
            &["claim[0].place: is needed here"],
        ),
        (
            "seed = 3\n",
            "seed = 3\n[[claim]]\ncheck = \"x\"\n",
            &["claim[0].check: expected \"si_error\""],
        ),
        ("radius = 0.2", "radius = 0.2\nvertices = []", &["light[0].vertices"]),
        ("radius = 0.2", "radius = 0.2\ncolour = 1", &["unknown field `colour`"]),
        ("centre = [0.35, 0.1, 1.0]", "centre = [0.35, inf, 1.0]", &["light[0].centre"]),
        ("radiance = 4", "radiance = -4", &["light[0].radiance", "-4"]),
        ("radiance = 4", "radiance = \"bright\"", &["light[0].radiance", "string"]),
        ("radiance = [2, 1, 0.5]", "radiance = [2, 1]", &["light[1].radiance", "three"]),
        (vertices, "vertices = [[0, 0, 1], [1, 0, 1]]", &["light[1].vertices", "got 2"]),
        (
            vertices,
            "vertices = [[0, 0, 1], [1, 0, 1], [2, 0, 1]]",
            &["light[1].vertices", "no area"],
        ),
        (
            vertices,
            "vertices = [[0, 0, 1], [1, 0, 1], [1, 1, 2], [0, 1, 1]]",
            &["light[1].vertices", "not plane"],
        ),
        (
            vertices,
            "vertices = [[0, 0, 1], [1, 1, 1], [1, 0, 1], [0, 1, 1]]",
            &["light[1].vertices", "intersects itself"],
        ),
        (
            vertices,
            "vertices = [[-1, -1, 0], [1, -1, 0], [0, 1, 0]]",
            &["light[1].vertices", "holds the scratch"],
        ),
        (vertices, "vertices = [[0, 0, 1], [1, nan, 1], [1, 1, 1]]", &["light[1].vertices", "NaN"]),
        (
            "wavelengths_nm = [650, 532, 450]",
            "wavelengths_nm = [650, 532, 99]",
            &["spectrum.wavelengths_nm", "99"],
        ),
        (
            "wavelengths_nm = [650, 532, 450]",
            "wavelengths_nm = [100001, 532, 450]",
            &["spectrum.wavelengths_nm", "100001"],
        ),
        (
            "kind = \"rgb\"\nwavelengths_nm = [650, 532, 450]",
            spectral,
            &["light[1].radiance", "rgb"],
        ),
        ("method = \"quadrature\"", "method = \"guess\"", &["reference.method", "guess"]),
        ("samples = 1024", "samples = 100", &["monte_carlo.samples", "100"]),
        (
            "seed = 3\n",
            "seed = 3\n[[approximation]]\nname = \"a\"\nsphere = \"x/y\"\n",
            &["approximation[0].polygon", "name the fit"],
        ),
        ("seed = 3\n", "seed = 3\n[[approximation]]\nname = \"a/b\"\n", &["approximation[0].name"]),
        (
            "seed = 3\n",
            "seed = 3\n[[approximation]]\nname = \"a\"\npolygon = \"x/y\"\n\
            sphere = \"../x/y\"\n",
            &["approximation[0].sphere", "inside the project", "../x/y"],
        ),
        (
            "seed = 3\n",
            "seed = 3\n[[approximation]]\nname = \"a\"\nsphere = \"x/y\"\n\
            polygon = \"/tmp/a.wgsl#shade\"\n",
            &["approximation[0].polygon", "inside the project"],
        ),
        (
            "seed = 3\n",
            "seed = 3\n[[approximation]]\nname = \"a\"\nsphere = \"x/y\"\n\
            polygon = \"x/y\"\n[budget.a]\n",
            &["budget.a", "got neither"],
        ),
        (
            "seed = 3\n",
            "seed = 3\n[[approximation]]\nname = \"sheet\"\n",
            &["approximation[0].name", "another file"],
        ),
        (
            vertices,
            "vertices = [[1, 0, 1], [1.00000001, 0, 1], [1, 0.00000001, 1]]",
            &["light[1].vertices", "in f32"],
        ),
        ("seed = 3\n", "seed = 3\n[budget.none]\nflip = 0.1\n", &["budget.none"]),
        (
            "seed = 3\n",
            "seed = 3\n[[approximation]]\nname = \"a\"\nsphere = \"x/y\"\n\
            polygon = \"x/y\"\n",
            &["x/y", "there is no reference, fit or form"],
        ),
    ];
    for (from, to, parts) in cases {
        assert!(whole.contains(from), "{from}");
        let (folder, output) = render(&whole.replacen(from, to, 1), &["--backend", "cpu"]);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{to}: {message}");
        assert!(message.starts_with("error: ") && !message.contains("panicked"), "{message}");
        for part in *parts {
            assert!(message.contains(part), "{to}: `{part}` is not in: {message}");
        }
        assert!(!folder.path("out/reference.exr").exists(), "{to}: nothing is rendered");
    }
    let (_, output) = render(&[VIEW, SCRATCH, RGB, QUADRATURE].concat(), &[]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("at least one [[light]]"), "{message}");
    let (_, output) = render("[view", &[]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("scene.toml"));
}
