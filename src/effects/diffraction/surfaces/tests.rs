//! Geometry of the simulated surfaces.

use super::*;

const PATCH: Patch = Patch { samples: 128, side_um: 12.8, line: false };

fn mean(map: &HeightMap) -> f64 {
    map.height_nm.iter().sum::<f64>() / map.height_nm.len() as f64
}

#[test]
fn gratings_have_their_range_and_their_mean() {
    let of = |profile| grating(Grating { period_um: 1.6, angle: 0.0, profile }, PATCH);
    let sinusoid = of(Profile::Sinusoid { amplitude_nm: 30.0 });
    assert!(mean(&sinusoid).abs() < 1e-9);
    let blazed = of(Profile::Blazed { height_nm: 100.0 });
    assert!((mean(&blazed) - 50.0).abs() < 4.0);
    let rectangle = of(Profile::Rectangle { depth_nm: 100.0, duty: 0.3 });
    assert!((mean(&rectangle) + 70.0).abs() < 1e-9, "{}", mean(&rectangle));
    assert!(rectangle.height_nm.iter().all(|h| (-100.0..=0.0).contains(h)));
}

#[test]
fn a_line_is_one_row() {
    let profile = Profile::Sinusoid { amplitude_nm: 30.0 };
    let line = Patch { line: true, ..PATCH };
    let map = grating(Grating { period_um: 1.6, angle: 0.0, profile }, line);
    assert_eq!((map.nx, map.ny, map.height_nm.len()), (128, 1, 128));
}

#[test]
fn discs_are_seeded_and_half_of_a_track_is_pit() {
    let disc =
        CompactDisc { pitch_um: 1.6, pit_width_um: 0.5, depth_nm: 120.0, bit_um: 0.278, seed: 1 };
    let patch = Patch { samples: 512, side_um: 51.2, line: false };
    let map = compact_disc(disc, patch);
    assert_eq!(map, compact_disc(disc, patch));
    assert_ne!(map.height_nm, compact_disc(CompactDisc { seed: 2, ..disc }, patch).height_nm);
    assert!(map.height_nm.iter().all(|h| (-120.0..=0.0).contains(h)));
    // Half of 0.5/1.6 of the area, to the scatter of 32 tracks.
    let share = mean(&map) / -120.0;
    assert!((share / (0.5 * 0.5 / 1.6) - 1.0).abs() < 0.1, "{share}");
}

#[test]
fn pixels_have_the_open_area_that_the_matrix_leaves() {
    let lattice =
        PixelLattice { pixel_um: 3.2, matrix_share: 0.2, depth_nm: 100.0, angle: 0.0, skew: 0.0 };
    let open = 0.8 * (1.0 - 0.2 / 3.0);
    let share = mean(&pixel_lattice(lattice, PATCH)) / -100.0;
    assert!((share / open - 1.0).abs() < 0.02, "{share} {open}");
}

#[test]
fn paper_is_seeded() {
    let paper = HolographicPaper {
        cell_um: 4.0,
        pitch_um: [1.0, 2.0],
        amplitude_nm: 40.0,
        spread: 0.3,
        seed: 5,
    };
    let map = holographic_paper(paper, PATCH);
    assert_eq!(map, holographic_paper(paper, PATCH));
    assert!(map.height_nm.iter().all(|h| h.abs() <= 40.0));
    assert!(map.height_nm.iter().any(|h| h.abs() > 30.0));
}
