//! `examples/own_effect.rs` as a test: an effect from outside the crate is fitted, judged and reported
//! like those that are built in.

#[path = "../examples/own_effect.rs"]
#[allow(dead_code, reason = "the program's entry is not used here")]
mod own_effect;

use std::fs;

use own_effect::{EFFECT, make, smith_masking};
use striae::document::{Verdict, number};
use striae::effect::{
    Distribution, DomainError, Effect, Evaluate, FormText, Quantity, Reference, Region, arguments,
    points,
};
use striae::fit::outcome::Status;
use striae::numeric::measured::Measured;
use striae::numeric::quadrature::GaussLegendre;
use striae::project::Project;
use striae::registry::{Registry, RegistryError};
use striae::run::{self, Run};
use striae::table::Table;
use striae::validate::draws::Draws;
use striae::validate::laws::LawStanding;

/// G₁ from what it means: μ over the projected area that is seen, by quadrature over the visible slopes p
/// in the plane of incidence, whose density is α² / (2 (α² + p²)^{3/2}); p = α tan t.
fn masking_by_quadrature(mu: f64, alpha: f64) -> f64 {
    let sine = (1.0 - mu * mu).sqrt();
    let seen = |t: f64| 0.5 * (mu * t.cos() - alpha * sine * t.sin());
    let edge = mu.atan2(alpha * sine);
    let rule = GaussLegendre::new(32);
    mu / rule.integral_in_panels(seen, -std::f64::consts::FRAC_PI_2, edge, 4)
}

#[test]
fn the_reference_agrees_with_what_masking_means() {
    let mut worst = 0.0_f64;
    for mu in [1e-3, 0.05, 0.3, 0.7, 0.99, 1.0] {
        for alpha in [1e-2, 0.1, 0.5, 1.0] {
            let exact = smith_masking(mu, alpha).expect("in the domain");
            worst = worst.max((masking_by_quadrature(mu, alpha) / exact - 1.0).abs());
        }
    }
    println!("largest relative difference {worst:e}");
    assert!(worst <= 1e-14, "relative difference {worst:e}");
    assert!(smith_masking(-0.1, 0.5).is_err() && smith_masking(0.5, 0.0).is_err());
    assert_eq!(smith_masking(0.0, 1e-4), Ok(0.0));
}

#[test]
fn an_effect_from_outside_is_judged_and_reported() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let made = make(folder.path()).expect("an effect that can be judged");

    let [outcome] = made.fitted.outcomes() else { panic!("one fit") };
    assert_eq!((outcome.name.as_str(), outcome.status), ("masking/refit", Status::Converged));
    let slope = outcome.parameters["slope"].value;
    assert!((slope / 0.402_771_02 - 1.0).abs() < 1e-6, "slope {slope}");

    // RMS and maximal error over the region in f32, as measured; grazing errors are smaller throughout.
    let page = fs::read_to_string(folder.path().join("reports/latest/masking.html")).expect("page");
    for (name, rms, largest) in [
        ("masking/schlick", 0.046_116_421, 0.154_246_840),
        ("masking/refit", 0.031_816_423, 0.110_761_139),
    ] {
        let all = &made.studied.study.candidates;
        let judged = all.iter().find(|judged| judged.name == name).expect("judged");
        let [(region, found)] = &judged.regions[..] else { panic!("one region") };
        let [(hard, grazing)] = &judged.hard_cases[..] else { panic!("one set of hard cases") };
        assert_eq!((region.as_str(), hard.as_str()), ("every roughness", "grazing"));
        assert!((found.f32.rms / rms - 1.0).abs() < 1e-6, "{name}: {:?}", found.f32);
        assert!((found.f32.max_abs / largest - 1.0).abs() < 1e-6, "{name}: {:?}", found.f32);
        assert!(grazing.f32.max_abs < 0.05, "{name}: {:?}", grazing.f32);
        let shown = number(found.f32.max_abs, 4);
        assert!(page.contains(&shown), "the page does not show {name}'s error {shown}");
    }
    let laws = &made.studied.study.laws;
    assert_eq!(laws.len(), 2, "{laws:?}");
    assert!(laws.iter().all(|law| law.verdict == LawStanding::Holds), "{laws:?}");
    let [finding] = &made.studied.study.findings[..] else { panic!("one claim") };
    assert_eq!(finding.found, "RMS error 0.0461 with 1/2, 0.0318 at the least squares");
    assert_eq!(finding.verdict, "differs");
    assert!(made.check.passed() && made.check.gates.is_empty());
    assert_eq!(made.check.constants.len(), 1, "the fit is made again");

    for shown in
        [EFFECT.title, "every roughness", "grazing", "end points", "holds", "Error by roughness"]
    {
        assert!(page.contains(shown), "the page does not show {shown:?}");
    }
    assert!(page.contains("No gate holds this"));
}

#[test]
fn names_of_an_effect_from_outside_are_its_own() {
    let with = Registry::builtin().clone().with_effect(&EFFECT).expect("registered");
    assert!(with.form("masking/schlick").is_some() && with.reference("smith_masking").is_some());
    let twice = with.with_effect(&EFFECT).expect_err("refused");
    assert_eq!(twice, RegistryError::Taken { kind: "effect", name: "masking" });
}

/// Flakes of a pixel that are lit: a reference that is a distribution, and forms that draw from it.
const FLAKES: Effect = Effect {
    name: "flakes",
    title: "Lit flakes",
    description: "How many of a pixel's flakes are lit, each with the same probability.",
    references: &[LIT_FLAKES],
    forms: || DRAWN.map(|(name, text)| FormText::new(name, text)).to_vec(),
    regions: &[PIXELS],
    hard_cases: &[NONE_OR_ALL],
    ..Effect::EMPTY
};

const LIT_FLAKES: Reference = Reference {
    name: "lit_flakes",
    description: "number of lit flakes",
    arguments: &[
        Quantity { name: "flakes", unit: "1", domain: "a whole number from 0 to 64" },
        Quantity { name: "lit", unit: "1", domain: "[0, 1]" },
    ],
    unit: "1",
    accuracy: "relative error <= 1e-13 (tests/own_effect.rs, by the factorials)",
    source: "the binomial distribution",
    evaluate: Evaluate::Distribution(|point| {
        let [flakes, lit] = arguments(point)?;
        let outside = |quantity, expected, got| DomainError { quantity, expected, got };
        if !(flakes.fract() == 0.0 && (0.0..=64.0).contains(&flakes)) {
            return Err(outside("flakes", "a whole number from 0 to 64", flakes));
        }
        if !(0.0..=1.0).contains(&lit) {
            return Err(outside("lit", "[0, 1]", lit));
        }
        // One flake after the other: it is lit or it is not.
        let mut probabilities = vec![0.0; flakes as usize + 1];
        probabilities[0] = 1.0;
        for _ in 0..flakes as usize {
            for count in (0..probabilities.len()).rev() {
                let below = if count == 0 { 0.0 } else { probabilities[count - 1] };
                probabilities[count] = (1.0 - lit) * probabilities[count] + lit * below;
            }
        }
        Ok(Distribution { mean: flakes * lit, variance: flakes * lit * (1.0 - lit), probabilities })
    }),
};

/// Fair draws, draws with too few digits, and draws in which all flakes share one.
const DRAWN: [(&str, &str); 4] = [
    (
        "hashed.wgsl",
        "\
// pcg of Jarzynski and Olano 2020, Hash Functions for GPU Rendering.
fn hashed(x: u32) -> u32 {
    let state = x * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}
",
    ),
    (
        "fair.wgsl",
        "\
// approximates: lit_flakes
// about: a number of 24 bits per flake, hashed from the seed
// cites: this test
// uses: hashed

fn lit_flakes(flakes: u32, lit: f32, seed: u32) -> f32 {
    var count = 0.0;
    for (var i = 0u; i < flakes; i++) {
        let uniform01 = f32(hashed(hashed(seed) + i) >> 8u) / 16777216.0;
        count += select(0.0, 1.0, uniform01 < lit);
    }
    return count;
}
",
    ),
    (
        "coarse.wgsl",
        "\
// approximates: lit_flakes
// about: a number of 4 bits per flake
// cites: this test
// uses: hashed

override steps: f32 = 15.0;

fn lit_flakes(flakes: u32, lit: f32, seed: u32) -> f32 {
    var count = 0.0;
    for (var i = 0u; i < flakes; i++) {
        count += select(0.0, 1.0, f32(hashed(hashed(seed) + i) >> 28u) / steps < lit);
    }
    return count;
}
",
    ),
    (
        "shared.wgsl",
        "\
// approximates: lit_flakes
// about: one number for all flakes
// cites: this test
// uses: hashed

fn lit_flakes(flakes: u32, lit: f32, seed: u32) -> f32 {
    let uniform01 = f32(hashed(seed) >> 8u) / 16777216.0;
    return select(0.0, f32(flakes), uniform01 < lit);
}
",
    ),
];

const PIXELS: Region = Region {
    name: "pixels",
    description: "2 to 16 flakes, of which from few to most are lit",
    points: || {
        let lit = [0.01, 0.1, 0.3, 0.55, 0.9];
        flakes(&[2.0, 5.0, 16.0].map(|count| lit.map(|lit| [count, lit])).concat(), "pixels")
    },
    ..Region::EMPTY
};

const NONE_OR_ALL: Region = Region {
    name: "none or all",
    description: "no flake, none lit, all lit",
    points: || flakes(&[[0.0, 0.5], [8.0, 0.0], [8.0, 1.0]], "none or all"),
    ..Region::EMPTY
};

fn flakes(rows: &[[f64; 2]], origin: &str) -> Table {
    points::rounded(points::of_rows([("flakes", "1"), ("lit", "1")], rows, origin.to_owned()))
}

#[test]
fn the_distribution_is_that_of_the_factorials() {
    let Evaluate::Distribution(binomial) = LIT_FLAKES.evaluate else { panic!("a distribution") };
    let found = binomial(&[16.0, 0.3]).expect("in the domain");
    let mut ways = 1.0;
    for (count, p) in found.probabilities.iter().enumerate() {
        let count = count as f64;
        let exact = ways * 0.3_f64.powf(count) * 0.7_f64.powf(16.0 - count);
        assert!((p / exact - 1.0).abs() <= 1e-13, "{count}: {p} for {exact}");
        ways *= (16.0 - count) / (count + 1.0);
    }
    assert!(binomial(&[0.5, 0.3]).is_err() && binomial(&[2.0, 1.5]).is_err());
}

#[test]
fn draws_are_judged_reported_and_gated() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let gate = |name: &str, domain: &str, metric: &str, limit: f64| {
        format!(
            "[[gate]]\nsubject = \"flakes/{name}\"\ndomain = \"{domain}\"\nmetric = \"{metric}\"\n\
             limit = {limit}\nwhy = \"fair draws\"\n"
        )
    };
    let gates = |name: &str| {
        let limits = [("mean_z", 4.0), ("variance_ratio", 1.3), ("chi2_p", 0.01)];
        limits.map(|(metric, limit)| gate(name, "pixels", metric, limit)).concat()
    };
    fs::create_dir_all(folder.path().join("fits")).expect("a folder");
    fs::write(folder.path().join("fits/gates.toml"), gates("fair")).expect("written");
    let registry = Registry::builtin().clone().with_effect(&FLAKES).expect("registered");
    let project = Project::open(folder.path(), &registry).expect("a project");
    let run = Run::new(&project, Measured::NotMeasured("not asked for".to_owned()));

    let studied = run.studies(&[&FLAKES], &|_| ()).expect("judged");
    let found = |name: &str| -> Vec<(&str, &Draws)> {
        let all = studied[0].study.candidates.iter();
        let one = all.filter(|one| one.name == name).collect::<Vec<_>>();
        let [one] = one[..] else { panic!("{name} is judged once") };
        assert!(one.regions.is_empty() && one.hard_cases.is_empty(), "draws have no error");
        one.draws.iter().map(|(region, of)| (region.as_str(), &of.f32)).collect()
    };
    for name in ["flakes/fair", "flakes/coarse", "flakes/shared"] {
        let [("pixels", pixels), ("none or all", edges)] = found(name)[..] else {
            panic!("{name}")
        };
        println!("{name}: {:?}", Draws { points: Vec::new(), ..pixels.clone() });
        assert_eq!((pixels.points.len(), pixels.fair()), (15, name == "flakes/fair"), "{name}");
        assert!(pixels.points.iter().all(|point| point.draws == (1 << 17) / 15), "{name}");
        assert!(edges.fair() || name == "flakes/coarse", "{name}: {edges:?}");
    }
    // A mean that is off by 561 standard errors at 69905 draws a point is off by 198 at 8738 of them.
    let coarse = found("flakes/coarse")[0].1.worst_mean_z;
    assert!((coarse / 198.0 - 1.0).abs() < 0.05, "{coarse}");
    // The variance of 16 flakes that share their number is 16 times that of 16 that do not.
    let shared = found("flakes/shared")[0].1.worst_variance_ratio;
    assert!((12.0..20.0).contains(&shared), "{shared}");

    let check = run.check(None, true).expect("judged");
    assert!(check.passed(), "{:?}", check.gates);
    assert_eq!(check.proofs.map(|proofs| proofs.proofs.len()), Some(3), "each gate can fail");
    for name in ["coarse", "shared"] {
        let file = folder.path().join("unfair.toml");
        fs::write(&file, gates(name)).expect("written");
        let check = run.check(Some(&file), false).expect("judged");
        let found: Vec<Verdict> = check.gates.iter().map(|gate| gate.verdict).collect();
        assert_eq!(found, [Verdict::Fail; 3], "{name}: {:?}", check.gates);
        let line = check.gates[2].summary();
        assert!(line.starts_with("chi2_p 0 of 0.01") && line.contains("flakes = "), "{line}");
    }
    for (metric, what) in [
        (
            "max_abs",
            "draws from a distribution have mean_z, variance_ratio and chi2_p, got max_abs",
        ),
        ("chi2", "of chi2_p the smallest"),
    ] {
        let file = folder.path().join("wrong.toml");
        fs::write(&file, gate("fair", "pixels", metric, 1.0)).expect("written");
        let error = run.check(Some(&file), false).expect_err("refused").to_string();
        assert!(error.contains(what), "{error}");
    }

    let check = run.check_if_gated().expect("judged");
    run.report_on(&studied, &project.report(), &check, &|_| ()).expect("written");
    let page = fs::read_to_string(project.report().join("flakes.html")).expect("a page");
    for shown in ["Draws", "smallest p of χ²", "not fair", "none or all", "chi2_p f32"] {
        assert!(page.contains(shown), "the page does not show {shown:?}");
    }
    let table = run::accuracy_table(&studied);
    assert!(table.contains("flakes/coarse\tpixels\tf32\t"), "{table}");
}
