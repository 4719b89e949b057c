//! The report layer from outside: what a page becomes, and what a figure never does.

mod report_sample;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use quick_xml::Reader;
use quick_xml::events::Event;
use report_sample::{pages, provenance};
use striae::document::plot::{Plot, PlotAxis, Series};
use striae::document::text::Layout;
use striae::document::{
    Block, Cell, Figure, Inline, Page, PrintedColumn, PrintedTable, Section, Span,
};
use striae::document::{json, text};
use striae::report::html::{SiteError, write_site};
use striae::report::plot::{Drawing, Rect, draw};

type Result<T = (), E = Box<dyn std::error::Error>> = std::result::Result<T, E>;

/// Units of an SVG per pixel of its figure.
const UNITS: f64 = 10.0;

fn drawings() -> Result<Vec<(String, Drawing)>> {
    let mut all = Vec::new();
    for page in pages() {
        for figure in page.figures() {
            all.push((figure.file_stem.clone(), draw(figure)));
        }
    }
    Ok(all)
}

/// Every element of a document, with its attributes; an error if it is not well-formed.
fn elements(svg: &str) -> Result<Vec<(String, BTreeMap<String, String>)>> {
    let mut reader = Reader::from_str(svg);
    reader.config_mut().check_end_names = true;
    let (mut found, mut depth) = (Vec::new(), 0_i32);
    loop {
        let event = reader.read_event()?;
        match &event {
            Event::Start(tag) | Event::Empty(tag) => {
                depth += i32::from(matches!(event, Event::Start(_)));
                let mut attributes = BTreeMap::new();
                for attribute in tag.attributes() {
                    let attribute = attribute?;
                    attributes.insert(
                        String::from_utf8(attribute.key.as_ref().to_vec())?,
                        String::from_utf8(attribute.value.to_vec())?,
                    );
                }
                found.push((String::from_utf8(tag.name().as_ref().to_vec())?, attributes));
            }
            Event::End(_) => depth -= 1,
            Event::Eof => break,
            _ => {}
        }
    }
    assert_eq!(depth, 0, "unclosed elements");
    Ok(found)
}

#[test]
fn svgs_are_well_formed_small_and_whole_numbered() -> Result {
    for (stem, drawing) in drawings()? {
        for svg in [drawing.svg.clone(), drawing.standalone()] {
            assert!(svg.len() < 150_000, "{stem}: {} bytes", svg.len());
            let elements = elements(&svg)?;
            for tag in ["title", "desc", "text"] {
                assert!(elements.iter().any(|(name, _)| name == tag), "{stem}: no {tag}");
            }
            assert!(!svg.contains("#FE"), "{stem}: a stand-in colour is left");
            for (name, attributes) in &elements {
                for key in ["x", "y", "cx", "cy", "x1", "y1", "points"] {
                    let value = attributes.get(key).map_or("", String::as_str);
                    assert!(!value.contains('.'), "{stem}: {name} {key}={value}");
                }
            }
        }
    }
    Ok(())
}

#[test]
fn what_is_drawn_is_the_same_to_the_byte() -> Result {
    assert_eq!(drawings()?, drawings()?);
    Ok(())
}

#[test]
fn the_legend_lies_outside_every_plot_area_and_no_data_lies_in_it() -> Result {
    for (stem, drawing) in drawings()? {
        let legend = drawing.legend.ok_or(format!("{stem} has no legend"))?;
        for area in &drawing.plot_areas {
            assert!(!legend.overlaps(area), "{stem}: {legend:?} covers {area:?}");
        }
        // Read from the file itself: every line and marker with a series' colour is either in a
        // plot area or in the legend, and both occur.
        let (mut plotted, mut keyed) = (0, 0);
        for (_, attributes) in elements(&drawing.svg)? {
            if !attributes.get("class").is_some_and(|c| c.starts_with(['k', 'm'])) {
                continue;
            }
            for (x, y) in places(&attributes) {
                let dot = Rect { left: x - 0.2, top: y - 0.2, width: 0.4, height: 0.4 };
                if legend.overlaps(&dot) {
                    keyed += 1;
                } else {
                    // A marker at the edge of a plot area may reach over it.
                    let grown = |a: &Rect| Rect {
                        left: a.left - 7.0,
                        top: a.top - 7.0,
                        width: a.width + 14.0,
                        height: a.height + 14.0,
                    };
                    let within = drawing.plot_areas.iter().any(|a| grown(a).overlaps(&dot));
                    assert!(within, "{stem}: something is drawn at {x}, {y}");
                    plotted += 1;
                }
            }
        }
        assert!(plotted > 0 && keyed > 0, "{stem}: {plotted} in plots, {keyed} in the legend");
    }
    Ok(())
}

/// Places of an element in pixels of the figure.
fn places(attributes: &BTreeMap<String, String>) -> Vec<(f64, f64)> {
    let number = |key: &str| attributes.get(key).and_then(|v| v.parse::<f64>().ok());
    let pairs = attributes.get("points").map_or("", String::as_str).split(' ');
    let mut places: Vec<_> = pairs
        .filter_map(|pair| pair.split_once(','))
        .filter_map(|(x, y)| Some((x.parse::<f64>().ok()?, y.parse::<f64>().ok()?)))
        .collect();
    for (x, y) in [("x", "y"), ("cx", "cy"), ("x1", "y1"), ("x2", "y2")] {
        places.extend(number(x).zip(number(y)));
    }
    places.iter().map(|(x, y)| (x / UNITS, y / UNITS)).collect()
}

#[test]
fn labels_cover_neither_each_other_nor_leave_the_plot() -> Result {
    let mut checked = 0;
    for (stem, drawing) in drawings()? {
        for (area, labels) in drawing.plot_areas.iter().zip(&drawing.labels) {
            for (index, label) in labels.iter().enumerate() {
                assert!(area.contains(label), "{stem}: a label leaves the plot");
                for other in &labels[index + 1..] {
                    assert!(!label.overlaps(other), "{stem}: {label:?} covers {other:?}");
                    checked += 1;
                }
            }
        }
    }
    assert!(checked >= 45, "ten labels make 45 pairs, {checked} were seen");
    Ok(())
}

fn plotted(x: PlotAxis, y: PlotAxis, points: Vec<(f64, f64)>) -> Result<Drawing> {
    Ok(draw(&Figure::new("f", "c", Plot::new("t", x, y).series(Series::line("s", points)))))
}

#[test]
fn points_that_cannot_be_drawn_are_counted() -> Result {
    let points = vec![(1.0, 1e-3), (2.0, f64::NAN), (3.0, 0.0), (4.0, -1.0), (5.0, 1e-6)];
    let drawing = plotted(PlotAxis::linear("x", "1"), PlotAxis::log("y", "1"), points)?;
    assert_eq!(
        drawing.notes,
        ["Points of “s” not drawn: 1 not finite, 2 not positive on a logarithmic axis."]
    );
    assert!(!drawing.svg.contains("NaN"));
    let points = vec![(0.0, 0.0), (1.0, 1.0), (2.0, 5.0)];
    let drawing =
        plotted(PlotAxis::linear("x", "1"), PlotAxis::linear("y", "1").range(0.0, 2.0), points)?;
    assert_eq!(drawing.notes, ["Points of “s” not drawn: 1 outside the axes."]);
    Ok(())
}

#[test]
fn hopeless_data_still_gives_a_figure() -> Result {
    let cases: [Vec<(f64, f64)>; 6] = [
        vec![],
        vec![(f64::NAN, f64::NAN)],
        vec![(0.0, 0.0)],
        vec![(1.0, 3.0), (1.0, 3.0)],
        vec![(-1e308, 1e308), (1e308, f64::INFINITY)],
        vec![(5e-324, 5e-324), (1e-300, 1e140)],
    ];
    let scales = [
        PlotAxis::linear,
        PlotAxis::log,
        |l, u| PlotAxis::symlog(l, u, 1e-6),
        |l, u| PlotAxis::symlog(l, u, f64::NAN),
    ];
    for points in &cases {
        for scale in scales {
            for range in [None, Some([2.0, 1.0]), Some([f64::NAN, 1.0]), Some([-1.0, 1e300])] {
                let axis = PlotAxis { range, ..scale("x", "1") };
                let drawing = plotted(axis.clone(), axis, points.clone())?;
                elements(&drawing.svg)?;
                assert!(!drawing.svg.contains("NaN") && !drawing.svg.contains("inf"));
            }
        }
    }
    Ok(())
}

#[test]
fn a_long_series_is_thinned_and_keeps_its_peak() -> Result {
    let wave = |i: i32| {
        let x = f64::from(i) * 1e-3;
        (x, if i == 123_456 { 7.0 } else { (x * 40.0).sin() })
    };
    let drawing = plotted(
        PlotAxis::linear("x", "1"),
        PlotAxis::linear("y", "1").range(-1.0, 7.0),
        (0..200_000).map(wave).collect(),
    )?;
    assert!(drawing.svg.len() < 150_000, "{} bytes", drawing.svg.len());
    let top = drawing.plot_areas[0].top;
    let reaches = elements(&drawing.svg)?
        .iter()
        .filter(|(_, a)| a.get("class").is_some_and(|c| c == "k0"))
        .any(|(_, a)| places(a).iter().any(|p| (p.1 - top).abs() < 0.1));
    assert!(reaches, "the peak is lost");
    Ok(())
}

fn written() -> Result<(PathBuf, Vec<PathBuf>)> {
    let dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join("report");
    let files = write_site(&dir, &pages(), &provenance())?.files;
    Ok((dir, files))
}

#[test]
fn pages_need_nothing_from_elsewhere() -> Result {
    let (dir, files) = written()?;
    let html: Vec<_> =
        files.iter().filter(|f| f.extension().is_some_and(|e| e == "html")).collect();
    assert_eq!(html.len(), 3);
    for file in html {
        let page = std::fs::read_to_string(file)?;
        for forbidden in ["<script", "<link", "<img", "src=", "@import", "url(", "javascript:"] {
            assert!(!page.contains(forbidden), "{}: {forbidden}", file.display());
        }
        for part in page.split("href=\"").skip(1) {
            let (href, _) = part.split_once('"').ok_or("an unclosed attribute")?;
            if href.starts_with("https://") {
                continue;
            }
            match href.strip_prefix('#') {
                Some(id) => assert!(page.contains(&format!("id=\"{id}\"")), "no #{id}"),
                None => assert!(dir.join(href).is_file(), "no {href}"),
            }
        }
        for needed in ["<html lang=\"en\">", "<main id=\"content\">", "prefers-color-scheme"] {
            assert!(page.contains(needed), "{}: no {needed}", file.display());
        }
        assert_eq!(page.matches("<table>").count(), page.matches("<caption>").count());
    }
    Ok(())
}

#[test]
fn the_json_is_valid_and_says_what_is_missing() -> Result {
    let text = json::report(&pages(), &provenance())?;
    let value: serde_json::Value = serde_json::from_str(&text)?;
    let keys: Vec<_> = value.as_object().ok_or("no object")?.keys().collect();
    assert_eq!(keys, ["schema", "provenance", "pages"]);
    assert!(text.contains(r#"{"number":null,"reason":"not a number"}"#));
    assert!(text.contains(r#""not_measured":"no adapter found""#));
    assert!(!text.contains("NaN"));
    assert_eq!(text, json::report(&pages(), &provenance())?);
    Ok(())
}

#[test]
fn what_was_not_measured_never_looks_like_a_pass() -> Result {
    let (dir, _) = written()?;
    let page = std::fs::read_to_string(dir.join("sine_integral.html"))?;
    let badges = page.matches("class=\"badge not-measured\"").count();
    assert!(badges > 0);
    assert_eq!(page.matches("not measured: no device").count(), 1);
    assert!(page.contains("<span class=\"missing\">not measured<span class=\"reason\">"));
    let plain = text::report(&pages(), &provenance());
    assert!(plain.contains("not measured: no adapter found"));
    Ok(())
}

#[test]
fn a_second_run_changes_nothing_and_removes_only_its_own_figures() -> Result {
    let dir = tempfile::tempdir()?;
    let first = write_site(dir.path(), &pages(), &provenance())?;
    let stamps = |files: &[PathBuf]| -> std::io::Result<Vec<_>> {
        files.iter().map(|f| std::fs::metadata(f)?.modified()).collect()
    };
    let before = stamps(&first.files)?;
    let foreign = dir.path().join("figures/mine.svg");
    std::fs::write(&foreign, "<svg/>")?;
    let second = write_site(dir.path(), &pages(), &provenance())?;
    assert_eq!(first, second);
    assert_eq!(before, stamps(&second.files)?);
    let third = write_site(dir.path(), &pages()[..1], &provenance())?;
    assert!(!third.removed.is_empty());
    assert!(third.removed.iter().all(|f| !f.exists() && first.files.contains(f)));
    assert!(foreign.is_file());
    // A manifest that names anything else removes nothing.
    let victim = dir.path().join("victim.svg");
    std::fs::write(&victim, "x")?;
    let manifest = dir.path().join("figures/manifest.json");
    std::fs::write(&manifest, r#"{"figures": ["../victim.svg", "mine.txt"]}"#)?;
    assert!(write_site(dir.path(), &pages()[..1], &provenance())?.removed.is_empty());
    std::fs::write(&manifest, "not JSON")?;
    assert!(write_site(dir.path(), &pages()[..1], &provenance())?.removed.is_empty());
    assert!(victim.is_file());
    Ok(())
}

#[test]
fn unusable_names_and_folders_are_refused() -> Result {
    let dir = tempfile::tempdir()?;
    let refused = |pages: &[Page]| write_site(dir.path(), pages, &provenance()).err();
    let page = |slug: &str| Page::new(slug, "t", "s");
    assert!(matches!(refused(&[page("../up")]), Some(SiteError::Name { .. })));
    assert!(matches!(refused(&[page("a"), page("a")]), Some(SiteError::Twice { .. })));
    let empty = Figure::grid("f", "c", Vec::new(), 2);
    let with = page("a").section(Section::new("s").block(empty));
    assert!(matches!(refused(&[with]), Some(SiteError::Plot { .. })));
    assert!(dir.path().read_dir()?.next().is_none(), "nothing is written before all is rendered");
    let file = dir.path().join("file");
    std::fs::write(&file, "")?;
    let error = write_site(&file, &[page("a")], &provenance()).err().ok_or("no error")?;
    assert!(error.to_string().contains("file"), "{error}");
    Ok(())
}

#[test]
fn text_from_outside_is_escaped() -> Result {
    let nasty = "<b>&\"'</b>\u{1}]]>";
    let mut table = PrintedTable::new(nasty, vec![PrintedColumn::text(nasty)]);
    table.push(vec![Cell::link(nasty, "javascript:alert(1)")]);
    let plot = Plot::new(nasty, PlotAxis::linear(nasty, "<1>"), PlotAxis::linear("y", "1"))
        .series(Series::markers(nasty, [(0.0, 1.0)]))
        .annotate(0.0, 1.0, nasty);
    let page = Page::new("p", nasty, nasty).section(
        Section::new(nasty)
            .block(table)
            .block(Figure::new("f", nasty, plot))
            .block(Block::List(vec![nasty.into()])),
    );
    let dir = tempfile::tempdir()?;
    write_site(dir.path(), &[page], &provenance())?;
    let html = std::fs::read_to_string(dir.path().join("p.html"))?;
    assert!(!html.contains("<b>") && !html.contains("javascript:"));
    elements(&std::fs::read_to_string(dir.path().join("figures/f.svg"))?)?;
    Ok(())
}

#[test]
fn short_rows_show_what_they_lack_and_empty_tables_say_so() -> Result {
    let columns = vec![PrintedColumn::text("a"), PrintedColumn::number("b", "1").grouped("g")];
    let empty = PrintedTable::new("empty", columns.clone());
    let mut short = PrintedTable::new("short", columns);
    short.push(vec![Cell::text("x")]);
    assert_eq!(short.rows()[0][1], Cell::missing("no value given"));
    let plain = |table: &PrintedTable| {
        text::sections(&[Section::default().block(table.clone())], Layout::default())
    };
    assert!(plain(&short).contains("g: b [1]"));
    assert!(plain(&empty).contains("nothing to show"));
    let page = Page::new("p", "t", "s").section(Section::new("s").block(empty).block(short));
    let dir = tempfile::tempdir()?;
    write_site(dir.path(), &[page], &provenance())?;
    let html = std::fs::read_to_string(dir.path().join("p.html"))?;
    assert!(html.contains("nothing to show") && html.contains("no value given"));
    assert!(html.contains("scope=\"colgroup\" colspan=\"1\">g</th>"));
    Ok(())
}

#[test]
fn inline_markup_is_code_and_links_and_nothing_else() {
    let text = Inline::from("over [-10, 10] `max_abs` of [a](b.html), an open ` and [c");
    assert_eq!(
        text.spans(),
        [
            Span::Plain("over [-10, 10] "),
            Span::Code("max_abs"),
            Span::Plain(" of "),
            Span::Link { text: "a", href: "b.html" },
            Span::Plain(", an open ` and [c"),
        ]
    );
    assert_eq!(text.to_plain(), "over [-10, 10] max_abs of a (b.html), an open ` and [c");
}

#[test]
fn numbers_show_the_digits_asked_for() {
    for (value, digits, shown) in [
        (0.05098, 4, "0.05098"),
        (0.050_983_4, 4, "0.05098"),
        // Zeros say that digits were cut off behind them.
        (0.050_999_6, 4, "0.05100"),
        (0.5, 4, "0.5"),
        (0.1 + 0.2, 17, "0.30000000000000004"),
        (1.234_567e-7, 3, "1.23e-7"),
        (999.96, 4, "1000"),
        (-12.5, 3, "-12.5"),
        (2001.0, 4, "2001"),
        (123_456.0, 3, "123456"),
        (0.0, 4, "0"),
        (1e300, 2, "1.0e300"),
        (f64::NAN, 4, "not a number"),
        (f64::NEG_INFINITY, 4, "-infinity"),
    ] {
        assert_eq!(Cell::number(value, digits).to_plain(), shown);
    }
}
