//! Factors in files.

use striae::factor::{Alignment, Decomposition, LowRank};
use striae::table::{Table, sidecar_path};

use super::tables::display;

fn kernel() -> LowRank {
    let mut table = display(24, [0.1, 1.6], 8.0);
    table.axes[1].count = 12;
    for channel in &mut table.channels {
        channel.values.truncate(24 * 12);
    }
    let alignment = Alignment::of_directions(0.1, 1.6).expect("not parallel");
    Decomposition::of_aligned(&table, alignment).expect("finite").low_rank(4).expect("rank 4")
}

#[test]
fn what_is_written_reads_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let kernel = kernel();
    kernel.write(folder.path()).expect("writable");
    let read = LowRank::read(folder.path()).expect("its own files");
    assert_eq!((&read.x, &read.y, read.alignment), (&kernel.x, &kernel.y, kernel.alignment));
    for (a, b) in kernel.channels.iter().zip(&read.channels) {
        assert_eq!(a.name, b.name);
        let rounded = |lists: &[Vec<f64>]| -> Vec<Vec<f64>> {
            lists.iter().map(|l| l.iter().map(|v| f64::from(*v as f32)).collect()).collect()
        };
        assert_eq!(rounded(&a.vertical), b.vertical);
        assert_eq!(rounded(&a.horizontal), b.horizontal);
    }
    let table = Table::read_csv(folder.path().join("vertical.csv")).expect("a table");
    assert_eq!(table.names()[..3], ["h_y", "R_1", "R_2"]);
    assert_eq!(table.column("B_4").expect("there").values, kernel.channels[2].vertical[3]);
    let table = Table::read_csv(folder.path().join("horizontal.csv")).expect("a table");
    assert_eq!((table.names()[0], table.rows()), ("h_x", 24));
}

#[test]
fn files_that_do_not_belong_together_are_refused() {
    let refused = |spoil: &dyn Fn(&std::path::Path), part: &str| {
        let folder = tempfile::tempdir().expect("a folder");
        kernel().write(folder.path()).expect("writable");
        spoil(folder.path());
        let error = LowRank::read(folder.path()).expect_err("spoilt").to_string();
        assert!(error.contains(part), "{part:?} is not in: {error}");
    };
    for name in ["vertical.exr", "horizontal.exr", "horizontal.exr.axes.toml", "alignment.toml"] {
        refused(&|folder| std::fs::remove_file(folder.join(name)).expect("there"), name);
    }
    refused(
        &|f| std::fs::write(f.join("alignment.toml"), "matrix = 1").expect("writable"),
        "alignment.toml",
    );
    refused(&|f| std::fs::write(f.join("vertical.exr"), "no").expect("writable"), "vertical.exr");
    let copy = |folder: &std::path::Path, other: &LowRank| {
        let there = tempfile::tempdir().expect("a folder");
        other.write(there.path()).expect("writable");
        let name = there.path().join("horizontal.exr");
        for (from, to) in [
            (name.clone(), folder.join("horizontal.exr")),
            (sidecar_path(&name), sidecar_path(&folder.join("horizontal.exr"))),
        ] {
            std::fs::copy(from, to).expect("writable");
        }
    };
    refused(&|f| copy(f, &kernel().truncated(2)), "4 vertical terms and 2");
    let mut renamed = kernel();
    renamed.channels[1].name = "Y".into();
    refused(&|f| copy(f, &renamed), "\"G\"");
    renamed.channels.pop();
    refused(&|f| copy(f, &renamed), "3 channels");
    assert!(LowRank::read(std::path::Path::new("no such folder")).is_err());
    let mut ragged = kernel();
    ragged.channels[0].vertical.pop();
    assert!(ragged.write(tempfile::tempdir().expect("a folder").path()).is_err());
}
