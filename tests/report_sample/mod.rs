//! A report with every kind of block, with figures of the shapes that effects show: error curves,
//! error against cost, small multiples.

use striae::document::plot::{Plot, PlotAxis, Series};
use striae::document::{
    Block, Cell, Colophon, Figure, NoticeLevel, Page, PrintedColumn, PrintedTable, Section, Verdict,
};

pub(crate) fn provenance() -> Colophon {
    Colophon {
        version: "0.1.0".to_owned(),
        adapter: Some("llvmpipe (LLVM 19.1.7, 256 bits), Vulkan".to_owned()),
        command: "striae report -o reports".to_owned(),
    }
}

pub(crate) fn pages() -> Vec<Page> {
    vec![sine_integral(), fresnel()]
}

fn grid(first: f64, last: f64, count: u32) -> impl Iterator<Item = f64> {
    let step = (last - first) / f64::from(count - 1);
    (0..count).map(move |i| first + f64::from(i) * step)
}

fn error_curves() -> Figure {
    let curve = |amplitude: f64, decay: f64, phase: f64| {
        grid(-10.0, 10.0, 2001).map(move |x| {
            let envelope = (-decay * x.abs()).exp();
            (x, amplitude * (envelope * (2.0 * x + phase).sin() - 0.4 * envelope * x.sin()))
        })
    };
    let plot = Plot::new(
        "Error over the fitted domain",
        PlotAxis::linear("x", "rad"),
        PlotAxis::linear("form − Si(x)", "1"),
    )
    .series(Series::line("published, eq. 29", curve(0.05, 0.1, 0.0)).strong())
    .series(Series::line("refitted, least squares", curve(0.034, 0.14, 0.4)))
    .series(Series::line("refitted, minimax", curve(0.028, 0.02, 1.2)))
    .series(Series::line("tail unbiased", curve(0.041, 0.22, 2.0)));
    Figure::new(
        "sine_integral-error",
        "Signed error of four forms over [−10, 10], 2001 points that were not fitted.",
        plot,
    )
}

fn error_magnitude() -> Figure {
    let curve = |scale: f64, rate: f64| {
        grid(-2.0, 4.0, 1800).map(move |p| {
            let x = 10f64.powf(p);
            (x, scale * (x * rate).sin().abs() / (1.0 + 0.01 * x))
        })
    };
    let plot = Plot::new(
        "Magnitude of the error",
        PlotAxis::log("x", "rad"),
        PlotAxis::log("|error|", "1"),
    )
    .series(Series::line("published, eq. 29", curve(0.05, 1.0)).strong())
    .series(Series::line("rational, large", curve(3e-7, 0.9)))
    .series(Series::line("table, 256 entries", curve(2e-4, 3.0)))
    .series(Series::line("with zeros", [(0.1, 0.0), (1.0, 1e-3), (10.0, f64::NAN)]));
    Figure::new("sine_integral-magnitude", "The same, log–log, far into the tail.", plot)
}

fn error_against_cost() -> Figure {
    let forms = [
        ("published", 1.00, 0.05098),
        ("refitted", 1.00, 0.0427),
        ("tail unbiased", 1.01, 0.0449),
        ("minimax", 1.02, 0.0381),
        ("rational_small", 0.62, 0.021),
        ("rational_medium", 0.78, 3.1e-4),
        ("rational_large", 0.97, 4.2e-7),
        ("table_64", 0.55, 6.0e-3),
        ("table_256", 0.57, 3.7e-4),
        ("table_1024", 0.81, 2.4e-5),
    ];
    let group = |prefix: &str| -> Vec<(f64, f64)> {
        forms.iter().filter(|f| f.0.starts_with(prefix)).map(|f| (f.1, f.2)).collect()
    };
    let elementary: Vec<_> = forms.iter().take(4).map(|f| (f.1, f.2)).collect();
    let mut plot = Plot::new(
        "Error against cost",
        PlotAxis::log("cost on the device, relative to the published form", "1"),
        PlotAxis::log("max |error|, f32, |x| ≤ 1e4", "1"),
    )
    .series(Series::markers("elementary functions", elementary))
    .series(Series::markers("rational", group("rational")))
    .series(Series::markers("table lookup", group("table")))
    .with_frontier();
    for (name, cost, error) in forms {
        plot = plot.annotate(cost, error, name);
    }
    Figure::new(
        "sine_integral-cost",
        "Largest error of the shipped f32 constants against cost; lower left is better.",
        plot,
    )
}

fn wide_table() -> PrintedTable {
    let mut columns = vec![PrintedColumn::code("form")];
    for region in ["[-10, 10]", "[10, 1e4]", "scene"] {
        for lane in ["f64", "f32", "device"] {
            columns
                .push(PrintedColumn::number(lane, "1").grouped(format!("max |error|, {region}")));
        }
    }
    columns.push(PrintedColumn::number("cost", "ns"));
    columns.push(PrintedColumn::verdict("gate"));
    let mut table =
        PrintedTable::new("Residuals of every form, on points that were not fitted.", columns);
    for (index, name) in ["published", "refitted", "minimax", "rational_large"].iter().enumerate() {
        let scale = [0.05098, 0.0427, 0.0381, 4.2e-7][index];
        let mut row = vec![Cell::text(format!("sine_integral/{name}"))];
        for region in 0..3 {
            let value = scale / f64::from(1 + region);
            row.push(Cell::number(value, 4));
            row.push(match index {
                1 => Cell::number(f64::NAN, 4),
                _ => Cell::number(value * 1.1, 4),
            });
            row.push(Cell::missing("no adapter found"));
        }
        row.push(Cell::number(12.25, 4));
        row.push(match index {
            0 => Cell::verdict(Verdict::Pass),
            1 => Cell::verdict(Verdict::Warn),
            2 => Cell::verdict(Verdict::Fail),
            _ => Cell::verdict_as(Verdict::NotMeasured, "no device"),
        });
        table.push(row);
    }
    table
}

fn findings() -> PrintedTable {
    let mut table = PrintedTable::new(
        "Claims as printed, beside what is found.",
        vec![
            PrintedColumn::text("place"),
            PrintedColumn::text("printed"),
            PrintedColumn::text("found"),
            PrintedColumn::verdict("verdict"),
            PrintedColumn::code("command"),
        ],
    );
    table.push(vec![
        Cell::text("Velinov et al. 2018, eq. 29"),
        Cell::text("maximal error 0.05"),
        Cell::text("0.05098 at x = 3.56"),
        Cell::verdict_as(Verdict::Pass, "holds"),
        Cell::text("striae check sine_integral"),
    ]);
    table.push(vec![
        Cell::link("fig. 7", "https://doi.org/10.1111/cgf.13376"),
        Cell::text("the fit is exact at infinity"),
        Cell::text("off by 0.0021 as x → ∞, because the tail is not constrained by the domain"),
        Cell::verdict_as(Verdict::Fail, "does not hold"),
        Cell::text("striae eval sine_integral/published"),
    ]);
    table
}

fn sine_integral() -> Page {
    Page::new(
        "sine_integral",
        "Sine integral",
        "Si(x) = ∫₀ˣ sin(t)/t dt, the profile integral of a scratch; renderers use the difference \
         of two values of it. Forms are fitted over [−10, 10] and judged to 1e4.",
    )
    .section(
        Section::new("What was fitted")
            .paragraph(
                "The published form `si_published` keeps its constants; the others are refitted to \
                 `sine_integral`, whose relative error is at most 1e-14 (see the \
                 [DLMF](https://dlmf.nist.gov/6)).",
            )
            .block(Block::Notice {
                level: NoticeLevel::NotMeasured,
                text: "the device column: no adapter was found, so nothing is said about it."
                    .into(),
            })
            .block(Block::Notice {
                level: NoticeLevel::Warning,
                text: "`refitted` is within 2 % of its gate.".into(),
            })
            .block(Block::List(vec![
                "least squares over 2001 points".into(),
                "minimax, with 7 alternations of sign".into(),
            ])),
    )
    .section(Section::new("Error curves").block(error_curves()).block(error_magnitude()))
    .section(Section::new("Error against cost").block(error_against_cost()))
    .section(Section::new("Residuals").block(wide_table()))
    .section(Section::new("Printed and found").block(findings()))
}

fn fresnel() -> Page {
    let materials = ["Au", "Ag", "Cu", "Al", "Fe", "Cr", "Ti", "Ni", "W", "brass", "Si"];
    let plots = materials.iter().zip(1_u32..).map(|(name, index)| {
        let dip = f64::from(index) * 0.02;
        let exact = grid(0.0, 1.0, 200).map(move |mu| (mu, 1.0 - (1.0 - mu.powi(5)) * (0.4 - dip)));
        let schlick =
            grid(0.0, 1.0, 200).map(move |mu| (mu, 1.0 - (1.0 - mu.powi(4)) * (0.38 - dip)));
        Plot::new(*name, PlotAxis::linear("μ", "1").range(0.0, 1.0), PlotAxis::linear("R", "1"))
            .series(Series::line("exact", exact).strong())
            .series(Series::dashed("Schlick", schlick))
            .series(Series::markers("measured", grid(0.1, 0.9, 5).map(|mu| (mu, 0.8))))
    });
    let signed = grid(-10.0, 10.0, 400).map(|x| (x, 1e-6 * x.powi(5)));
    let signed_plot =
        Plot::new("Signed error", PlotAxis::linear("x", "1"), PlotAxis::symlog("error", "1", 1e-6))
            .series(Series::markers("error", signed.step_by(20)));
    Page::new("fresnel", "Fresnel reflectance", "Conductors and dielectrics.").section(
        Section::new("Reflectance")
            .block(Figure::grid("fresnel-r", "Reflectance by material.", plots.collect(), 4))
            .block(Block::Details {
                summary: "Signed error, both signs on one logarithmic axis".into(),
                blocks: vec![Figure::new("fresnel-signed", "Signed error.", signed_plot).into()],
            }),
    )
}
