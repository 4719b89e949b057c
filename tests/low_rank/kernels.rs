//! Kernels from factors, as printed and as meant; kernels along lines.

use striae::factor::{Decomposition, DirectionalKernel, directional};
use striae::table::{Axis, Channel, Grid};

use super::tables::{cross, disc, display, noisy, table};

fn spacing(axis: &Axis) -> f64 {
    axis.step().abs()
}

fn energy(grid: &Grid, channel: usize) -> f64 {
    let sum: f64 = grid.channels[channel].values.iter().map(|v| f64::from(*v)).sum();
    sum * spacing(grid.x()) * spacing(grid.y())
}

#[test]
fn a_kernel_is_its_table_at_the_texels_and_linear_between() {
    let t = display(20, [0.1, 1.6], 8.0);
    let kernel = Decomposition::of(&t).expect("finite").low_rank(20).expect("full rank");
    let (x, y) = (t.x().centre(7), t.y().centre(3));
    let at = |ix: usize, iy: usize| f64::from(t.channels[0].values[iy * 20 + ix]);
    assert!((kernel.evaluate(0, [x, y]) - at(7, 3)).abs() < 1e-12);
    let middle = 0.5 * (x + t.x().centre(8));
    assert!((kernel.evaluate(0, [middle, y]) - 0.5 * (at(7, 3) + at(8, 3))).abs() < 1e-12);
    let edge = t.x().to - 1e-9;
    assert!((kernel.evaluate(0, [edge, y]) - at(19, 3)).abs() < 1e-12, "constant to the edge");
    for outside in [[0.36, 0.0], [0.0, -0.36], [f64::NAN, 0.0]] {
        assert_eq!(kernel.evaluate(0, outside), 0.0);
    }
    assert_eq!(kernel.evaluate(9, [x, y]), 0.0, "no such channel");
    let first = kernel.truncated(1);
    assert_eq!((first.rank(), kernel.rank()), (1, 20));
    assert_eq!(first, Decomposition::of(&t).expect("finite").low_rank(1).expect("rank 1"));
    let grid = kernel.to_grid(t.x(), t.y()).expect("finite");
    let same = grid.channels[2].values.iter().zip(&t.channels[2].values);
    assert!(same.into_iter().all(|(a, b)| (a - b).abs() < 1e-6));
}

#[test]
fn the_passes_as_printed_are_right_only_at_rank_one() {
    for (name, t) in [
        ("display", display(64, [0.14, 1.66], 8.0)),
        ("cross", cross(64, [0.1, 1.6])),
        ("disc", disc(64, 0.5)),
    ] {
        let decomposition = Decomposition::of(&t).expect("finite");
        for rank in [1, 3, 10, 21] {
            let kernel = decomposition.low_rank(rank).expect("rank");
            let right = kernel.relative_errors(&t).expect("same")[1];
            let printed = kernel.cross_rank_printed().relative_errors(&t).expect("same")[1];
            println!("{name}, rank {rank}: {right:.4} as meant, {printed:.4} as printed");
            if rank == 1 {
                assert_eq!(right, printed);
            } else {
                // A sum of products that do not belong together is a kernel of rank 1, and no better
                // than the best of rank 1.
                let one = decomposition.spectra().nth(1).expect("G").relative_errors[1];
                assert!(printed >= one && right < one, "{name}: {right} {printed} {one}");
            }
        }
    }
}

#[test]
fn lines_keep_the_energy_and_say_what_they_lose() {
    let t = noisy(cross(64, [0.2, 1.6]), 0.01, 1);
    let directions = [0.2f64, 1.6].map(|a| [2.0 * a.cos(), 2.0 * a.sin()]);
    for half_width in [0.01, 0.05, f64::INFINITY] {
        let lines = directional(&t, &directions, half_width).expect("two lines");
        for (channel, (name, lost)) in lines.lost.iter().enumerate() {
            let sums = lines.kernels.iter().map(|kernel| {
                assert_eq!(&kernel.channels[channel].0, name);
                assert!((kernel.direction[0].hypot(kernel.direction[1]) - 1.0).abs() < 1e-15);
                kernel.channels[channel].1.iter().sum::<f64>() * spacing(&kernel.axis)
            });
            let kept = sums.sum::<f64>() / energy(&t, channel);
            assert!((kept + lost - 1.0).abs() < 1e-12, "{name}: kept {kept}, lost {lost}");
            if half_width.is_infinite() {
                assert_eq!(*lost, 0.0);
            } else {
                assert!(*lost > 0.0 && *lost < 0.7, "{lost}");
            }
        }
    }
}

/// The lines drawn on a table with the given axes: each texel of a line's axis, cut into
/// `PIECES`, goes to the four nearest texels in proportion, over their area. A line one texel wide
/// stands for the δ across it; what falls beyond the axes is lost.
fn drawn(kernels: &[DirectionalKernel], x: &Axis, y: &Axis) -> Grid {
    const PIECES: usize = 8;
    let names: Vec<&String> = kernels
        .first()
        .map(|k| k.channels.iter().map(|(name, _)| name).collect())
        .unwrap_or_default();
    let area = spacing(x) * spacing(y);
    let mut channels = Vec::with_capacity(names.len());
    for (index, name) in names.into_iter().enumerate() {
        let mut values = vec![0.0f64; x.count * y.count];
        for kernel in kernels {
            let Some((_, profile)) = kernel.channels.get(index) else { continue };
            let step = spacing(&kernel.axis);
            for (i, value) in profile.iter().enumerate().filter(|(_, v)| **v != 0.0) {
                for piece in 0..PIECES {
                    let offset = (piece as f64 + 0.5) / PIECES as f64 - 0.5;
                    let s = kernel.axis.centre(i) + offset * step;
                    let [dx, dy] = kernel.direction;
                    let share = value * step / (PIECES as f64 * area);
                    spread(&mut values, x, y, [s * dx, s * dy], share);
                }
            }
        }
        let values = values.iter().map(|v| *v as f32).collect();
        channels.push(Channel::new(name, "1", values));
    }
    Grid::new([x.clone(), y.clone()], channels, format!("{} lines", kernels.len())).expect("finite")
}

fn spread(values: &mut [f64], x: &Axis, y: &Axis, h: [f64; 2], amount: f64) {
    let (tx, ty) = (x.texel(h[0]), y.texel(h[1]));
    let (left, top) = (tx.floor(), ty.floor());
    for (i, wx) in [(left, 1.0 - (tx - left)), (left + 1.0, tx - left)] {
        for (j, wy) in [(top, 1.0 - (ty - top)), (top + 1.0, ty - top)] {
            if i < 0.0 || j < 0.0 || i as usize >= x.count {
                continue;
            }
            if let Some(slot) = values.get_mut(j as usize * x.count + i as usize) {
                *slot += amount * wx * wy;
            }
        }
    }
}

#[test]
fn one_line_integrates_across_and_the_drawing_keeps_its_energy() {
    // Gaussian along, any shape across: the kernel along x is the Gaussian times the width.
    let t =
        table(64, 1.0, |x, y| [(-20.0 * x * x).exp() * if y.abs() < 0.5 { 1.0 } else { 0.0 }; 3]);
    let lines = directional(&t, &[[1.0, 0.0]], f64::INFINITY).expect("a line");
    let kernel = &lines.kernels[0];
    for (s, value) in kernel.axis.centres().iter().zip(&kernel.channels[0].1) {
        if s.abs() < 1.0 {
            assert!((value - (-20.0 * s * s).exp()).abs() < 1e-6, "{s}: {value}");
        }
    }
    let picture = drawn(&lines.kernels, t.x(), t.y());
    let part = energy(&picture, 0) / energy(&t, 0);
    assert!((part - 1.0).abs() < 1e-6, "{part}");
    assert!(directional(&t, &[], 1.0).is_err());
    assert!(directional(&t, &[[0.0, 0.0]], 1.0).is_err());
    assert!(directional(&t, &[[1.0, 0.0]], 0.0).is_err());
    assert!(directional(&t, &[[1.0, f64::NAN]], 1.0).is_err());
}
