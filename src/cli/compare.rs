//! `compare`: how an image or a table differs from another.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::{Args, ValueEnum};

use super::compare_text::{Compared, Comparison, Flip, Judgement};
use super::context::Context;
use super::output::name;
use super::{Ending, assignment};
use crate::render::compare::columns::column_differences;
use crate::render::compare::error_map::ErrorMap;
use crate::render::compare::flip::{self, FlipMap, STANDARD_PIXELS_PER_DEGREE};
use crate::render::compare::metrics::ImageDifference;
use crate::render::compare::z_test::{Pooling, ZTest};
use crate::render::compare::{CompareError, ExposureRule, Exposures};
use crate::render::image::{Format, Image};
use crate::table::{ReadOptions, Table};

const MORE: &str = "\
A is judged against B: images (.exr, .png), channel by channel, or tables (.csv) with the same
columns, column by column. A value that is not finite makes a metric NaN, and NaN is above every
limit. Metrics:
  mean          |mean of A - mean of B| / |mean of B|
  rms           root of the mean squared error
  relative_rms  rms / root mean square of B
  max           largest error
  flip          mean FLIP (Andersson et al.): HDR-FLIP of .exr, LDR-FLIP of .png or with --exposure
  z             largest |z| of the noise test, where an image has channels stderr.R, …: blocks of
                8 x 8 pixels, pooled where few contribute, and whole channels
  significance  1 - p of that test after Sidak's correction; noise alone exceeds 0.99 in about
                1 comparison of 100, with few hits per pixel in more
mean, rms, relative_rms and max are those of all channels together and of the worst column.

The error map shows the root mean square over the channels of each pixel's error, relative to that
of B, in magma from black at 0 to light yellow at the scale; green where it is not finite.

Exit code 1 if a metric is above its limit, 2 if A and B cannot be compared.

Examples:
  striae compare ours.exr reference.exr -o error.png --fail-above flip=0.02
  striae compare noisy.exr reference.exr --fail-above significance=0.99
  striae compare new.csv old.csv --fail-above relative_rms=1e-6";

/// Compare an image or a table with a reference
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// Image or table to judge
    a: PathBuf,
    /// Reference
    b: PathBuf,
    /// PNG of the relative error in false colours
    #[arg(long, short, value_name = "PNG")]
    output: Option<PathBuf>,
    /// Error that has the last colour [default: the largest, rounded up]
    #[arg(long, value_name = "ERROR", requires = "output", allow_negative_numbers = true)]
    scale: Option<f64>,
    /// PNG of FLIP in its own colours, from 0 to 1
    #[arg(long, value_name = "PNG")]
    flip_map: Option<PathBuf>,
    /// Exit with 1 if the metric is above the limit or NaN; may be repeated
    #[arg(long, value_name = "METRIC=LIMIT", value_parser = limit)]
    fail_above: Vec<(Metric, f64)>,
    /// Compare for FLIP what a display shows at this exposure, in stops from -100 to 100
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true)]
    exposure: Option<f64>,
    /// Choose the exposures of HDR-FLIP by the pixels of B that are not black
    #[arg(long, conflicts_with = "exposure")]
    lit_pixels: bool,
    /// Pixels per degree of the observer, from 1 to 1000
    #[arg(long, value_name = "PIXELS", default_value_t = STANDARD_PIXELS_PER_DEGREE)]
    ppd: f64,
}

/// What `--fail-above` can name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(super) enum Metric {
    Mean,
    Rms,
    RelativeRms,
    Max,
    Flip,
    Z,
    Significance,
}

fn limit(text: &str) -> Result<(Metric, f64), String> {
    let (metric, limit) = assignment::number(text)?;
    let known = Metric::from_str(&metric, false).map_err(|_| {
        let names: Vec<String> = Metric::value_variants().iter().copied().map(name).collect();
        format!("unknown metric {metric:?}; known metrics: {}", names.join(", "))
    })?;
    Ok((known, limit))
}

/// Compares, prints, and fails if a metric is above its limit.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let (a, b) = (&arguments.a, &arguments.b);
    let both = || format!("{} against {}", a.display(), b.display());
    let compared = match (is_table(a), is_table(b)) {
        (true, true) => tables(arguments).with_context(both)?,
        (false, false) => images(arguments).with_context(both)?,
        _ => bail!("{}: one is a table, the other an image", both()),
    };
    let judge = |&(metric, limit): &(Metric, f64)| match compared.metric(metric) {
        Ok(value) => Ok(Judgement { metric, value, limit }),
        Err(why) => bail!("--fail-above {}: {}: {why}", name(metric), both()),
    };
    let judgements = arguments.fail_above.iter().map(judge).collect::<Result<Vec<_>, _>>()?;
    let passed = judgements.iter().all(Judgement::passed);
    let comparison = Comparison { a, b, compared: &compared, judgements: &judgements };
    context.output.sections(&comparison.json(), || vec![comparison.section()])?;
    for note in compared.notes() {
        context.output.note(&note);
    }
    Ok(if passed { Ending::Done } else { Ending::GateFailed })
}

fn is_table(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
}

fn tables(arguments: &Arguments) -> anyhow::Result<Compared> {
    for (option, path) in [("--output", &arguments.output), ("--flip-map", &arguments.flip_map)] {
        if path.is_some() {
            bail!("{option}: tables have no picture of their errors");
        }
    }
    let read = |path| Table::read_csv_with(path, ReadOptions { allow_non_finite: true });
    let (test, reference) = (read(&arguments.a)?, read(&arguments.b)?);
    Ok(Compared::tables(column_differences(&test, &reference)?))
}

fn images(arguments: &Arguments) -> anyhow::Result<Compared> {
    let (test, reference) = (Image::read(&arguments.a)?, Image::read(&arguments.b)?);
    let difference = ImageDifference::of(&test, &reference)?;
    let has_errors =
        |image: &Image| image.quantities().all(|c| image.standard_error(&c.name).is_some());
    let noisy = has_errors(&test) || has_errors(&reference);
    let z = noisy.then(|| ZTest::of(&test, &reference, Pooling::default())).transpose()?;
    let flip = match reference.colours() {
        Ok(_) => Ok(flip(arguments, &test, &reference)?),
        Err(error) => Err(error.to_string()),
    };
    if let Some(path) = &arguments.flip_map {
        match &flip {
            Ok(Flip { map: Some(map), .. }) => ErrorMap::of_flip(map).write_png(path, false)?,
            Ok(Flip { conditions: why, .. }) | Err(why) => bail!("--flip-map: {why}"),
        }
    }
    let mut scale = None;
    if let Some(path) = &arguments.output {
        let map = ErrorMap::relative(&test, &reference, arguments.scale)?;
        map.write_png(path, true)?;
        scale = Some(map.scale);
    }
    Ok(Compared::images(&difference, flip, z, scale))
}

/// FLIP, of the kind that the files and the options ask for. A reference that is black throughout
/// has no exposures: its FLIP is NaN.
fn flip(arguments: &Arguments, test: &Image, reference: &Image) -> anyhow::Result<Flip> {
    let ppd = arguments.ppd;
    let ldr = |exposure| flip::ldr_flip(test, reference, exposure, ppd);
    let described = |map: FlipMap, conditions: String| Flip {
        value: map.mean,
        conditions: format!("{conditions}, {ppd:.2} pixels per degree"),
        negative: map.negative,
        map: Some(map),
    };
    let is_hdr = |path| Format::of(path).is_ok_and(|format| format == Format::Exr);
    if let Some(exposure) = arguments.exposure {
        return Ok(described(ldr(exposure)?, format!("LDR at {exposure} stops")));
    }
    if !(is_hdr(&arguments.a) || is_hdr(&arguments.b)) {
        return Ok(described(ldr(0.0)?, "LDR".to_owned()));
    }
    let rule = match arguments.lit_pixels {
        true => ExposureRule::LitPixels,
        false => ExposureRule::Standard,
    };
    match Exposures::of(reference, rule) {
        Ok(exposures) => {
            let Exposures { start, stop, count, rule } = exposures;
            let rule = rule.name();
            let text = format!("HDR, {count} exposures of {start:.2} to {stop:.2} stops ({rule})");
            Ok(described(flip::hdr_flip(test, reference, &exposures, ppd)?, text))
        }
        Err(why @ CompareError::Setting { .. }) => {
            let conditions = format!("undefined: {why}");
            Ok(Flip { value: f64::NAN, conditions, negative: 0, map: None })
        }
        Err(error) => Err(error.into()),
    }
}
