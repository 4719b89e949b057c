//! CSV: what is read and written, and what is refused.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};
use striae::table::{Column, ReadOptions, Table, TableError, shortest_number, store, units};

use crate::assert_says;

const GOOD: &str = "# Au, two rows\nwavelength [nm],n,u(n),k [1],u(wavelength) [um]\n\
                    400,1.5,0.01,1.9,0.001\n500,0.9,0.02,1.8,0.002\n";

fn refusal(text: &str) -> String {
    match Table::read_csv_str("t.csv", text) {
        Ok(table) => panic!("{text:?} was read as {table:?}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn headers_units_and_uncertainties_are_read() -> Result<(), TableError> {
    let table = Table::read_csv_str("t.csv", GOOD)?;
    assert_eq!(table.names(), ["wavelength", "n", "k"]);
    assert_eq!(table.rows(), 2);
    let wavelength = table.require("wavelength")?;
    assert_eq!(wavelength.unit, "nm");
    // The uncertainty was in µm and comes in the column's unit.
    assert_eq!(wavelength.uncertainty, Some(vec![1.0, 2.0]));
    let n = table.require("n")?;
    assert_eq!((n.unit.as_str(), &n.uncertainty), ("1", &Some(vec![0.01, 0.02])));
    assert_eq!(table.require("k")?.uncertainty, None);
    assert_eq!(table.values_in("wavelength", "um")?, [0.4, 0.5]);
    Ok(())
}

#[test]
fn line_ends_blank_lines_spaces_and_byte_order_marks_do_not_matter() -> Result<(), TableError> {
    let plain = Table::read_csv_str("t", "x [mm],y\n1,2\n3,4\n")?;
    for text in [
        "\u{feff}x [mm],y\n1,2\n3,4\n",
        "x [mm],y\r\n1,2\r\n3,4",
        "# c\n x[mm] , y\n\n1, 2\n#3,4\n3 ,4\n\n",
    ] {
        assert_eq!(Table::read_csv_str("t", text)?, plain);
    }
    Ok(())
}

#[test]
fn written_numbers_read_back_exactly() -> Result<(), Box<dyn std::error::Error>> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut values = vec![0.0, -0.0, 1.0, 0.1, 1e300, 5e-324, f64::MAX, f64::MIN_POSITIVE, 2e16];
    while values.len() < 10_000 {
        let value = f64::from_bits(random.next_u64());
        values.extend(value.is_finite().then_some(value));
    }
    let uncertainty: Vec<f64> = values.iter().map(|v| v.abs()).collect();
    let mut x = Column::new("a, b", "W/(m^2 nm)", values.clone());
    x.uncertainty = Some(uncertainty);
    let table = Table { columns: vec![x, Column::new("y", "1", values)], origin: "t".into() };

    let folder = tempfile::tempdir()?;
    let path = folder.path().join("t.csv");
    table.write_csv(&path, &["made by a test\nin two lines".into()])?;
    let read = Table::read_csv(&path)?;
    let bits = |t: &Table| -> Vec<Vec<u64>> {
        let all = t.columns.iter().flat_map(|c| [Some(&c.values), c.uncertainty.as_ref()]);
        all.flatten().map(|v| v.iter().map(|x| x.to_bits()).collect()).collect()
    };
    assert_eq!(bits(&read), bits(&table));
    assert_eq!(read.names(), table.names());
    let text = std::fs::read_to_string(&path)?;
    assert!(text.starts_with("# made by a test\n# in two lines\n\"a, b [W/(m^2 nm)]\","));
    assert_says(&read.origin, &["t.csv (sha256 ", &store::sha256_hex(text.as_bytes())]);
    Ok(())
}

#[test]
fn numbers_are_written_short() {
    for (value, text) in
        [(2.0, "2"), (-0.5, "-0.5"), (1e-9, "1e-9"), (0.1, "0.1"), (1e22, "1e22"), (-0.0, "-0")]
    {
        assert_eq!(shortest_number(value), text);
    }
}

#[test]
fn non_finite_numbers_need_the_option() -> Result<(), TableError> {
    for (cell, name) in [("NaN", "NaN"), ("inf", "inf"), ("-Infinity", "-inf"), ("1e999", "inf")] {
        let text = format!("x,y\n1,2\n3,{cell}\n");
        assert_says(&refusal(&text), &["t.csv:3", "row 2", "\"y\"", "finite", name]);
        let table = Table::parse_csv("t", &text, ReadOptions { allow_non_finite: true })?;
        assert!(!table.values_in("y", "1")?[1].is_finite());
    }
    Ok(())
}

#[test]
fn every_fault_of_the_header_is_named() {
    assert_says(&refusal(""), &["t.csv", "no header"]);
    assert_says(&refusal("# only a comment\n"), &["t.csv", "no header"]);
    assert_says(&refusal("x,\n1,2\n"), &["t.csv:1", "column 2", "no name"]);
    assert_says(&refusal("x, [nm]\n1,2\n"), &["column 2", "no name"]);
    assert_says(&refusal("#c\nx,y,x\n1,2,3\n"), &["t.csv:2", "\"x\"", "twice"]);
    assert_says(&refusal("x,u(x),u(x)\n1,2,3\n"), &["\"u(x)\"", "twice"]);
    assert_says(&refusal("x [parsec]\n1\n"), &["t.csv", "\"x\"", "\"parsec\"", "nm", "sr^-1"]);
    assert_says(&refusal("x [nm\n1\n"), &["\"x [nm\"", "bracket"]);
    assert_says(&refusal("x [nm] y\n1\n"), &["bracket"]);
    assert_says(&refusal("x,u(y)\n1,2\n"), &["\"u(y)\"", "no column \"y\""]);
    assert_says(&refusal("x [nm],u(x) [deg]\n1,2\n"), &["u(x)", "length", "\"deg\""]);
}

#[test]
fn every_fault_of_a_row_is_named() {
    assert_says(&refusal("x,y\n"), &["t.csv", "no rows"]);
    assert_says(&refusal("x,y\n1,2\n3\n4,5\n"), &["t.csv:3", "row 2", "1 cells", "has 2"]);
    assert_says(&refusal("x,y\n1,2,3\n"), &["3 cells"]);
    // Comments, blank lines and either line end count as the lines that they are.
    let text = "#a\n#b\n\nx,y\n1,2\n#c\n\n#d\n3,z\n";
    assert_says(&refusal(text), &["t.csv:9", "row 2", "\"z\""]);
    assert_says(&refusal(&text.replace('\n', "\r\n")), &["t.csv:9", "row 2", "\"z\""]);
    assert_says(&refusal("x,y\n1,2\n3,4\n5"), &["t.csv:4", "truncated"]);
    assert_says(&refusal("x,y\n1,2\n3,4o\n"), &["t.csv:3", "row 2", "\"y\"", "\"4o\""]);
    assert_says(&refusal("x,y\n1,\n"), &["t.csv:2", "\"y\"", "number", "\"\""]);
    assert_says(&refusal("x,u(x)\n1,-2\n"), &["t.csv:2", "row 1", "u(x)", "negative", "-2"]);
}

#[test]
fn a_file_that_is_not_text_or_not_there_is_named() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("bad.csv");
    std::fs::write(&path, b"x,y\n1,\xff\n")?;
    let message = Table::read_csv(&path).err().ok_or("read")?.to_string();
    assert_says(&message, &["bad.csv:2", "UTF-8", "byte 6"]);
    let missing = Table::read_csv(folder.path().join("none.csv")).err().ok_or("read")?;
    assert_says(&missing.to_string(), &["none.csv", "cannot read"]);
    Ok(())
}

#[test]
fn a_column_that_is_not_there_is_answered_with_those_that_are() -> Result<(), TableError> {
    let table = Table::read_csv_str("t.csv", GOOD)?;
    let message = table.require("m").map_or_else(|e| e.to_string(), |_| String::new());
    assert_says(&message, &["t.csv", "\"m\"", "wavelength, n, k"]);
    let message = table.values_in("n", "nm").map_or_else(|e| e.to_string(), |_| String::new());
    assert_says(&message, &["\"n\"", "length", "\"1\""]);
    Ok(())
}

#[test]
fn tables_made_in_memory_are_checked_before_writing() {
    let column = |name: &str, unit: &str, values: &[f64]| Column::new(name, unit, values.to_vec());
    let fault = |columns: Vec<Column>| {
        let table = Table { columns, origin: "made".into() };
        table.to_csv(&[]).map_or_else(|e| e.to_string(), |text| panic!("written as {text}"))
    };
    assert_says(&fault(vec![]), &["made", "no columns"]);
    for name in ["", " x", "#x", "u(x)", "x [nm]", "x\ny", "\"x"] {
        assert_says(&fault(vec![column(name, "1", &[1.0])]), &["made", "column 1"]);
    }
    let (x, y) = (column("x", "1", &[1.0]), column("y", "1", &[1.0, 2.0]));
    assert_says(&fault(vec![x.clone(), y]), &["\"y\"", "2 values", "expected 1"]);
    assert_says(&fault(vec![x.clone(), x.clone()]), &["\"x\"", "twice"]);
    assert_says(&fault(vec![column("x", "cubit", &[1.0])]), &["\"cubit\""]);
    let negative = Column { uncertainty: Some(vec![-1.0]), ..x };
    assert_says(&fault(vec![negative]), &["u(x)", "negative"]);
}

#[test]
fn an_old_file_stays_whole_when_writing_fails() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("t.csv");
    store::atomic_write(&path, b"old")?;
    store::atomic_write(&path, b"new")?;
    assert_eq!(std::fs::read(&path)?, b"new");
    assert_eq!(std::fs::read_dir(&folder)?.count(), 1, "a temporary file was left");

    let missing = folder.path().join("none").join("t.csv");
    let message = store::atomic_write(&missing, b"x").err().ok_or("written")?.to_string();
    assert_says(&message, &["t.csv", "folder", "none", "does not exist"]);
    let message = store::atomic_write(folder.path(), b"x").err().ok_or("written")?.to_string();
    assert_says(&message, &["is a folder"]);
    let message = store::atomic_write(&path.join("t.csv"), b"x").err().ok_or("written")?;
    assert_says(&message.to_string(), &["does not exist"]);
    Ok(())
}

#[test]
fn units_convert_within_their_dimension() -> Result<(), TableError> {
    for (from, to, factor) in [
        ("nm", "m", 1e-9),
        ("m", "nm", 1e9),
        ("um", "nm", 1e3),
        ("nm", "um", 1e-3),
        ("nm", "nm", 1.0),
        ("%", "1", 1e-2),
        ("deg", "rad", std::f64::consts::PI / 180.0),
        ("nm^-1", "um^-1", 1e3),
        ("eV", "J", 1.602_176_634e-19),
    ] {
        let got = units::conversion(from, to, "t", "x")?;
        assert!((got / factor - 1.0).abs() <= f64::EPSILON, "{from} to {to}: {got:e}");
    }
    assert_eq!(units::conversion("um", "nm", "t", "x")?, 1000.0);
    assert_eq!(units::conversion("nm", "m", "t", "x")?, 1e-9);
    assert!(units::conversion("nm", "sr^-1", "t", "x").is_err());
    let mut symbols: Vec<&str> = units::KNOWN.iter().map(|u| u.symbol).collect();
    symbols.sort_unstable();
    symbols.dedup();
    assert_eq!(symbols.len(), units::KNOWN.len(), "a unit is listed twice");
    Ok(())
}
