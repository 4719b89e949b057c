//! Grids of any dimension: sampling, texels, and what is refused.

use striae::table::{Axis, Channel, Edge, Grid};

/// 4 × 3 × 2 texels of a function that is linear along every axis.
fn linear() -> Grid {
    let axes = [
        Axis::new("x", "1", [0.0, 4.0], 4),
        Axis::new("y", "nm", [6.0, 0.0], 3),
        Axis::new("z", "rad", [-1.0, 1.0], 2),
    ];
    let mut grid = Grid { axes: axes.into(), channels: Vec::new(), origin: "made".into() };
    let value = |index: usize| {
        let texel = grid.texel(index);
        let [x, y, z] = [0, 1, 2].map(|k| grid.axes[k].centre(texel[k]));
        function(x, y, z) as f32
    };
    let values = (0..24).map(value).collect();
    grid.channels.push(Channel::new("f", "1", values));
    grid
}

fn function(x: f64, y: f64, z: f64) -> f64 {
    (1.0 + x) * (2.0 - 0.25 * y) * (3.0 + z)
}

#[test]
fn samples_are_linear_along_every_axis() {
    let grid = linear();
    grid.check().expect("a grid");
    let f = &grid.channels[0];
    // Products of eighths: exact in f32.
    for place in [[0.5, 5.0, -0.5], [2.0, 3.0, 0.0], [1.75, 1.5, 0.25], [3.5, 1.0, 0.5]] {
        let [x, y, z] = place;
        for edge in [Edge::Held, Edge::Fading] {
            assert_eq!(grid.sample(f, &place, edge), function(x, y, z), "{place:?}");
        }
    }
    assert!(grid.sample(f, &[1.0, 1.0], Edge::Held).is_nan());
}

#[test]
fn beyond_the_outermost_centres_samples_hold_or_fade() {
    let grid = linear();
    let f = &grid.channels[0];
    let at = |x: f64, edge| grid.sample(f, &[x, 3.0, 0.5], edge);
    let outermost = function(0.5, 3.0, 0.5);
    assert_eq!([at(0.25, Edge::Held), at(0.25, Edge::Fading)], [outermost, 0.75 * outermost]);
    assert_eq!([at(-0.25, Edge::Held), at(-0.25, Edge::Fading)], [0.0, 0.25 * outermost]);
    assert_eq!([at(-0.5, Edge::Held), at(-0.5, Edge::Fading)], [0.0; 2]);
    assert!(at(f64::NAN, Edge::Fading).is_nan());
}

#[test]
fn texels_are_found_by_their_indices() {
    let grid = linear();
    let values = &grid.channels[0].values;
    for (index, value) in values.iter().enumerate() {
        assert_eq!(grid.at("f", &grid.texel(index)), Some(*value));
    }
    assert_eq!([grid.at("f", &[4, 0, 0]), grid.at("f", &[0, 0]), grid.at("g", &[0; 3])], [None; 3]);
    let table = grid.to_table();
    assert_eq!(table.names(), ["x", "y", "z", "f"]);
    let row = |i: usize| -> Vec<f64> { table.columns.iter().map(|c| c.values[i]).collect() };
    assert_eq!(row(4 + 12), [0.5, 3.0, 0.5, function(0.5, 3.0, 0.5)]);
}

#[test]
fn the_dimension_is_checked_and_faults_name_the_texel() {
    let mut grid = linear();
    let message = grid.check_plane().expect_err("three axes").to_string();
    assert!(message.contains("made: 3 axes, expected 2"), "{message}");
    grid.channels[0].values[17] = f32::INFINITY;
    let message = grid.check().expect_err("infinite").to_string();
    assert!(message.contains("texel (1, 1, 1)"), "{message}");
    grid.axes.clear();
    assert!(grid.check().is_err() && (grid.x().count, grid.y().count) == (1, 1));
}
