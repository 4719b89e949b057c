#[path = "../low_rank/tables.rs"]
#[allow(dead_code)]
mod tables;
use std::time::Instant;
use striae::fit::low_rank::*;
use striae::measured::environment::Environment;
use tables::*;

fn hdr(name: &str) -> Environment {
    let p = format!("/work/shared/measured/hdri_polyhaven_cc0/{name}.hdr");
    let im = image::open(&p).unwrap().into_rgb32f();
    Environment {
        width: im.width() as usize,
        height: im.height() as usize,
        radiance: im.pixels().map(|p| p.0).collect(),
        origin: name.into(),
    }
}

#[test]
fn convolution() {
    let n: usize = std::env::var("N").ok().and_then(|v| v.parse().ok()).unwrap_or(96);
    let d = |a: f64| a.to_radians();
    let tables = vec![
        ("display skew", display(n, [d(8.0), d(95.0)], 8.0)),
        ("cross skew", cross(n, [d(12.0), d(97.0)])),
        ("disc", disc(n, d(0.0))),
        ("disc30", disc(n, d(30.0))),
        ("holographic", holographic(n, 3)),
    ];
    let envs: Vec<(&str, Vec<Environment>, Vec<Environment>)> = vec![
        ("windows", vec![windows(1)], vec![windows(2)]),
        ("lamps", vec![lamps(1)], vec![lamps(2)]),
        ("hall", vec![hdr("hall")], vec![hdr("studio")]),
        (
            "hall+workshop+park",
            vec![hdr("hall"), hdr("workshop"), hdr("park")],
            vec![hdr("studio")],
        ),
    ];
    for (tn, t) in &tables {
        for (en, train, held) in &envs {
            let b = Instant::now();
            let norm =
                ConvolutionNorm::from_environments(train, &t.x, &t.y, &NormOptions::default())
                    .unwrap();
            let held_norm = ConvolutionNorm::from_environments(
                held,
                &t.x,
                &t.y,
                &NormOptions { seed: 77, ..Default::default() },
            )
            .unwrap();
            println!(
                "{tn} / {en}: norms {:.2}s R(1,0)={:.4} R(5,0)={:.4} R(20,0)={:.4}",
                b.elapsed().as_secs_f64(),
                norm.correlation(1, 0),
                norm.correlation(5, 0),
                norm.correlation(20, 0)
            );
            let dec = Decomposition::of(t).unwrap();
            for rank in [1, 3] {
                let svd = dec.low_rank(rank).unwrap();
                let b = Instant::now();
                let (k, rep) =
                    convolved(t, Alignment::identity(), rank, &norm, &ConvolvedOptions::default())
                        .unwrap();
                let secs = b.elapsed().as_secs_f64();
                let m = |v: &[f64]| (v.iter().map(|e| e * e).sum::<f64>() / v.len() as f64).sqrt();
                let s0 = m(&norm.relative_errors(t, &svd).unwrap());
                let s1 = m(&norm.relative_errors(t, &k).unwrap());
                let h0 = m(&held_norm.relative_errors(t, &svd).unwrap());
                let h1 = m(&held_norm.relative_errors(t, &k).unwrap());
                let e0 = seen_error(t, &svd, &held[0], 64, 5).unwrap();
                let e1 = seen_error(t, &k, &held[0], 64, 5).unwrap();
                let f0 = m(&svd.relative_errors(t).unwrap());
                let f1 = m(&k.relative_errors(t).unwrap());
                println!(
                    "  r{rank} train {s0:.4}->{s1:.4} ({:+.0}%) held {h0:.4}->{h1:.4} ({:+.0}%) seen {e0:.4}->{e1:.4} ({:+.0}%) frob {f0:.4}->{f1:.4}  {secs:.2}s",
                    100.0 * (s1 / s0 - 1.0),
                    100.0 * (h1 / h0 - 1.0),
                    100.0 * (e1 / e0 - 1.0)
                );
                println!("     G: {:?}", rep[1]);
            }
        }
    }
}

#[test]
fn alignment() {
    let d = |a: f64| a.to_radians();
    for n in [96, 192] {
        for (a, b) in [
            (0.0, 90.0),
            (10.0, 100.0),
            (-7.3, 82.7),
            (33.3, 123.3),
            (44.0, 134.0),
            (0.0, 75.0),
            (12.0, 97.0),
            (-20.0, 85.0),
        ] {
            for (name, t) in [
                ("display", display(n, [d(a), d(b)], 8.0)),
                ("cross", cross(n, [d(a), d(b)])),
                ("noisy display", noisy(display(n, [d(a), d(b)], 8.0), 0.02, 4)),
                ("noisy cross", noisy(cross(n, [d(a), d(b)]), 0.02, 4)),
            ] {
                let begin = Instant::now();
                let f = main_directions(&t, &SearchOptions::default()).unwrap();
                let [x, y] = f.angles_rad.map(f64::to_degrees);
                let [sx, sy] = f.searched_rad.map(f64::to_degrees);
                println!(
                    "n {n} {name} ({a}, {b}): found {x:.3} {y:.3} err {:+.4} {:+.4} searched {sx} {sy} beyond {:?} {:.2}s resampling {:.4}",
                    x - a,
                    y - b,
                    f.beyond_rank_one.map(|v| (v * 1e4).round() / 1e4),
                    begin.elapsed().as_secs_f64(),
                    resampling_error(&t, &f.alignment).unwrap()
                );
            }
        }
    }
}

#[test]
fn printed() {
    let n = 128;
    for (name, t) in [
        ("display", display(n, [0.14, 1.66], 8.0)),
        ("cross", cross(n, [0.0, std::f64::consts::FRAC_PI_2])),
        ("holographic", holographic(n, 3)),
        ("disc30", disc(n, 0.5)),
    ] {
        let dec = Decomposition::of(&t).unwrap();
        for r in [1, 3, 10, 21] {
            let k = dec.low_rank(r).unwrap();
            println!(
                "{name} r{r}: right {:.4?} printed {:.4?}",
                k.relative_errors(&t).unwrap(),
                k.cross_rank_printed().relative_errors(&t).unwrap()
            );
        }
    }
}

#[test]
fn others() {
    let n = 128;
    for (name, t) in [
        ("display", display(n, [0.14, 1.66], 8.0)),
        ("cross", cross(n, [0.1, 1.6])),
        ("holographic", holographic(n, 3)),
    ] {
        let w = Weight::of_incidence(&t.x, &t.y, &Alignment::identity());
        let dec = Decomposition::of(&t).unwrap();
        for r in [1, 3, 10] {
            let svd = dec.low_rank(r).unwrap();
            let b = Instant::now();
            let j = shared(&t, Alignment::identity(), r, Stopping::default()).unwrap();
            let tj = b.elapsed().as_secs_f64();
            let b = Instant::now();
            let wt = weighted(&t, Alignment::identity(), r, &w, Stopping::default()).unwrap();
            let tw = b.elapsed().as_secs_f64();
            let b = Instant::now();
            let nn = nonnegative(&t, Alignment::identity(), r, Stopping::default()).unwrap();
            let tn = b.elapsed().as_secs_f64();
            println!(
                "{name} r{r}: svd {:.4?} joint {:.4?} {tj:.2}s | weighted err svd {:.5?} fit {:.5?} {tw:.2}s | nonneg {:.4?} {tn:.2}s colours {:.2?}",
                svd.relative_errors(&t).unwrap(),
                j.low_rank.relative_errors(&t).unwrap(),
                w.relative_errors(&t, &svd).unwrap(),
                w.relative_errors(&t, &wt).unwrap(),
                nn.relative_errors(&t).unwrap(),
                j.colours
            );
        }
    }
}

#[test]
fn sizes() {
    for n in [128, 256, 512] {
        let t = display(n, [0.14, 1.66], 8.0);
        let b = Instant::now();
        let norm =
            ConvolutionNorm::from_environments(&[hdr("hall")], &t.x, &t.y, &NormOptions::default())
                .unwrap();
        let tn = b.elapsed().as_secs_f64();
        for rank in [1, 3] {
            let b = Instant::now();
            let (_, rep) =
                convolved(&t, Alignment::identity(), rank, &norm, &ConvolvedOptions::default())
                    .unwrap();
            println!(
                "n {n} r {rank}: norm {tn:.2}s fit {:.2}s {:?}",
                b.elapsed().as_secs_f64(),
                rep[1]
            );
        }
        let b = Instant::now();
        Decomposition::of(&t).unwrap();
        println!("svd {:.3}s", b.elapsed().as_secs_f64());
    }
}
