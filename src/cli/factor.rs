//! `factor`: low-rank factors of a two-dimensional table.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, bail};
use clap::{Args, ValueEnum};

use super::Ending;
use super::context::Context;
use super::factor_pictures::{picture, write_lines};
use super::factor_table::{Factored, Lines, Row};
use super::output::name;
use crate::factor::{
    Alignment, ConvolutionNorm, ConvolvedOptions, Decomposition, LowRank, LowRankError,
    MainDirections, NormOptions, SearchOptions, Stopping, Weight, aligned, convolved, directional,
    main_directions, nonnegative, shared, weighted,
};
use crate::measured::environment::Environment;
use crate::table::{Axis, Grid, GridChannel, store};

const MORE: &str = "\
S(x, y) becomes a sum of products of one factor along y and one along x, per channel. Methods:
  svd          least Frobenius error of each channel, by singular value decomposition
  joint        one pair of spatial factors for all channels, with a weight per channel and term
  weighted     least error under (1 + cos)^2 / 4, the factor by which light at h is seen
  convolution  least error after convolution with the environments (needs --environment)
  nonnegative  least Frobenius error with factors that are not negative
`all` leaves out what the table or the options do not allow, and says so.

Writes into DIR:
  errors.csv                           method, rank, channel, errors and milliseconds
  alignment.toml                       from h to the axes of the factors
  METHOD/vertical.exr, horizontal.exr  factors of the largest rank, f32, one row per term
  METHOD/vertical.csv, horizontal.csv  the same in f64
  METHOD/alignment.toml                beside them, so that the folder stands alone
  table.png, METHOD_RANK.png           the table and what the factors give, one exposure for all
  line_N.csv                           with --directional: kernels along lines

Examples:
  striae factor holographic.exr --rank 1..10 -o factors
  striae factor phone.exr --align --error 0.1 --method svd,convolution \\
      --environment hall.hdr --environment studio.hdr -o factors
  striae factor cd.exr --directional 1 -o factors";

/// Factorise a two-dimensional table (.exr) into low-rank kernels
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// Table to factorise, with its axes in TABLE.axes.toml
    table: PathBuf,
    /// Rank, or ranks from a to b [default: 1..3, as far as the table has them]
    #[arg(long, value_name = "R|A..B", value_parser = ranks, conflicts_with = "error")]
    rank: Option<(usize, usize)>,
    /// The smallest rank at which svd has at most this relative error in every channel
    #[arg(long, value_name = "ERROR", allow_negative_numbers = true)]
    error: Option<f64>,
    /// Straighten the two main directions of the pattern first
    #[arg(long)]
    align: bool,
    /// Least angle between the two main directions, in degrees from 1 to 90
    #[arg(long, value_name = "DEG", default_value_t = 60.0, allow_negative_numbers = true)]
    min_angle: f64,
    /// Methods, separated by commas, or all
    #[arg(long, value_name = "METHOD", value_delimiter = ',', default_value = "svd")]
    method: Vec<Method>,
    /// Environment (.hdr, .exr) under which errors are weighed; may be repeated
    #[arg(long, value_name = "FILE")]
    environment: Vec<PathBuf>,
    /// Random normals per environment
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u16).range(1..))]
    orientations: u16,
    /// Kernels along the N main directions, 1 (the whole table across) or 2
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=2))]
    directional: Option<u8>,
    /// Half width of the bands of --directional 2, in h [default: 1/20 of half the smaller side]
    #[arg(long, value_name = "H", requires = "directional", allow_negative_numbers = true)]
    half_width: Option<f64>,
    /// Folder to write into; made if it is not there
    #[arg(long, short, value_name = "DIR")]
    output: PathBuf,
}

/// What `--method` can name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Method {
    Svd,
    Joint,
    Weighted,
    Convolution,
    Nonnegative,
    All,
}

fn ranks(text: &str) -> Result<(usize, usize), String> {
    let one = |part: &str| match part.trim().parse::<usize>() {
        Ok(rank) if rank > 0 => Ok(rank),
        _ => Err(format!("expected a rank from 1, got {part:?}")),
    };
    match text.split_once("..") {
        None => one(text).map(|rank| (rank, rank)),
        Some((from, to)) => {
            let (from, to) = (one(from)?, one(to.strip_prefix('=').unwrap_or(to))?);
            if from > to {
                return Err(format!("{from}..{to} holds no rank; write {to}..{from}"));
            }
            Ok((from, to))
        }
    }
}

/// Factorises, writes and prints.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let table = Grid::read_exr(&arguments.table)?;
    if table.channels.iter().all(|channel| channel.values.iter().all(|v| *v == 0.0)) {
        return Err(LowRankError::AllZero { origin: table.origin }.into());
    }
    let environments =
        arguments.environment.iter().map(Environment::read).collect::<Result<Vec<_>, _>>()?;
    let (methods, left_out) = methods(arguments, &table)?;
    let search = SearchOptions {
        minimum_angle_rad: arguments.min_angle.to_radians(),
        ..SearchOptions::default()
    };
    let searched = arguments.align || arguments.directional.is_some();
    let directions = if searched { Some(main_directions(&table, &search)?) } else { None };
    let alignment = match &directions {
        Some(found) if arguments.align => found.alignment,
        _ => Alignment::identity(),
    };
    let straight = aligned(&table, &alignment)?;
    let begin = Instant::now();
    let decomposition = Decomposition::of_aligned(&straight, alignment)?;
    let svd_ms = milliseconds(begin);
    let ranks = chosen_ranks(arguments, &decomposition)?;
    decomposition.low_rank(*ranks.end())?;
    let options = NormOptions {
        orientations: usize::from(arguments.orientations),
        seed: context.seed.unwrap_or(NormOptions::default().seed),
        alignment,
        ..NormOptions::default()
    };
    let (x, y) = (straight.x(), straight.y());
    let norm = (!environments.is_empty())
        .then(|| ConvolutionNorm::from_environments(&environments, x, y, &options))
        .transpose()?;

    let work = Work { table: &straight, alignment, decomposition: &decomposition, svd_ms, norm };
    let mut kernels = Vec::new();
    let mut rows = Vec::new();
    for method in methods {
        for rank in ranks.clone() {
            let (kernel, ms) = work.factorised(method, rank)?;
            rows.extend(work.rows(method, rank, &kernel, ms)?);
            kernels.push((method, rank, kernel));
        }
    }
    let lines = along_lines(arguments, &table, directions.as_ref())?;
    std::fs::create_dir_all(&arguments.output)
        .with_context(|| arguments.output.display().to_string())?;
    write(&arguments.output, &work, &kernels, *ranks.end())?;
    if let Some(lines) = &lines {
        write_lines(&lines.all, &arguments.output)?;
    }
    let factored = Factored {
        table: &straight,
        spectra: decomposition.spectra().collect(),
        directions: directions.as_ref(),
        aligned: arguments.align,
        rows: &rows,
        lines,
        folder: &arguments.output,
    };
    store::atomic_write(&arguments.output.join("errors.csv"), factored.csv()?.as_bytes())?;
    context.output.sections(&factored.json(), || vec![factored.section()])?;
    for note in left_out {
        context.output.note(&note);
    }
    Ok(Ending::Done)
}

/// The methods asked for, in order, and why some of `all` are left out.
fn methods(arguments: &Arguments, table: &Grid) -> anyhow::Result<(Vec<Method>, Vec<String>)> {
    let no_light = arguments.environment.is_empty();
    if !arguments.method.contains(&Method::All) {
        let mut methods: Vec<Method> = Vec::new();
        for method in &arguments.method {
            if !methods.contains(method) {
                methods.push(*method);
            }
        }
        if no_light && methods.contains(&Method::Convolution) {
            bail!("--method convolution: no --environment to convolve with");
        }
        return Ok((methods, Vec::new()));
    }
    let mut methods = vec![Method::Svd, Method::Joint, Method::Weighted];
    let mut left_out = Vec::new();
    if no_light {
        left_out.push("convolution: not measured, no --environment was given".to_owned());
    } else {
        methods.push(Method::Convolution);
    }
    let negative = |c: &GridChannel| c.values.iter().any(|v| *v < 0.0);
    match table.channels.iter().find(|c| negative(c)) {
        Some(channel) => left_out.push(format!(
            "nonnegative: not measured, channel {:?} has negative values",
            channel.name
        )),
        None => methods.push(Method::Nonnegative),
    }
    Ok((methods, left_out))
}

fn chosen_ranks(
    arguments: &Arguments,
    decomposition: &Decomposition,
) -> Result<std::ops::RangeInclusive<usize>, LowRankError> {
    Ok(match (arguments.rank, arguments.error) {
        (Some((from, to)), _) => from..=to,
        (None, Some(error)) => {
            let rank = decomposition.rank_for_error(error)?;
            rank..=rank
        }
        (None, None) => 1..=decomposition.largest_rank().min(3),
    })
}

/// What the methods share.
struct Work<'a> {
    table: &'a Grid,
    alignment: Alignment,
    decomposition: &'a Decomposition,
    svd_ms: f64,
    norm: Option<ConvolutionNorm>,
}

impl Work<'_> {
    /// The kernel and how long it took, in milliseconds.
    fn factorised(&self, method: Method, rank: usize) -> anyhow::Result<(LowRank, f64)> {
        let (table, alignment, stopping) = (self.table, self.alignment, Stopping::default());
        let begin = Instant::now();
        let kernel = match method {
            Method::Svd | Method::All => {
                return Ok((self.decomposition.low_rank(rank)?, self.svd_ms));
            }
            Method::Joint => shared(table, alignment, rank, stopping)?.low_rank,
            Method::Weighted => {
                let weight = Weight::of_incidence(table.x(), table.y(), &alignment);
                weighted(table, alignment, rank, &weight, stopping)?
            }
            Method::Convolution => {
                let Some(norm) = &self.norm else { bail!("no environment to convolve with") };
                convolved(table, alignment, rank, norm, &ConvolvedOptions::default())?.0
            }
            Method::Nonnegative => nonnegative(table, alignment, rank, stopping)?,
        };
        Ok((kernel, milliseconds(begin)))
    }

    fn rows(
        &self,
        method: Method,
        rank: usize,
        kernel: &LowRank,
        ms: f64,
    ) -> Result<Vec<Row>, LowRankError> {
        let errors = kernel.relative_errors(self.table)?;
        let seen = self.norm.as_ref().map(|norm| norm.relative_errors(self.table, kernel));
        let seen = seen.transpose()?;
        let channels = self.table.channels.iter().zip(errors).enumerate();
        let row = |(at, (channel, relative_error)): (usize, (&GridChannel, f64))| Row {
            method: name(method),
            rank,
            channel: channel.name.clone(),
            relative_error,
            after_convolution: seen.as_ref().map(|seen| seen[at]),
            ms,
        };
        Ok(channels.map(row).collect())
    }
}

fn milliseconds(begin: Instant) -> f64 {
    begin.elapsed().as_secs_f64() * 1e3
}

/// Pictures per method at most: the smallest ranks, and the largest.
const PICTURES: usize = 6;

fn write(
    folder: &Path,
    work: &Work<'_>,
    kernels: &[(Method, usize, LowRank)],
    largest: usize,
) -> anyhow::Result<()> {
    store::atomic_write(&folder.join("alignment.toml"), work.alignment.to_toml()?.as_bytes())?;
    let exposure = picture(work.table, &folder.join("table.png"), None)?;
    let mut drawn: Vec<Method> = Vec::new();
    for (method, rank, kernel) in kernels {
        let before = drawn.iter().filter(|m| *m == method).count();
        if before < PICTURES - 1 || *rank == largest {
            let file = format!("{}_{rank}.png", name(*method));
            picture(&kernel.product()?, &folder.join(file), Some(exposure))?;
            drawn.push(*method);
        }
        if *rank == largest {
            let own = folder.join(name(*method));
            std::fs::create_dir_all(&own).with_context(|| own.display().to_string())?;
            kernel.write(&own)?;
        }
    }
    Ok(())
}

/// Kernels along the main directions, if they were asked for.
fn along_lines(
    arguments: &Arguments,
    table: &Grid,
    found: Option<&MainDirections>,
) -> Result<Option<Lines>, LowRankError> {
    let (Some(count), Some(found)) = (arguments.directional, found) else { return Ok(None) };
    let half = |axis: &Axis| axis.from.abs().min(axis.to.abs());
    let [x, y] = found.angles_rad.map(|angle| [angle.cos(), angle.sin()]);
    let (directions, half_width) = match count {
        1 => (vec![if found.brighter_is_x { x } else { y }], f64::INFINITY),
        _ => {
            let own = half(table.x()).min(half(table.y())) / 20.0;
            (vec![x, y], arguments.half_width.unwrap_or(own))
        }
    };
    let all = directional(table, &directions, half_width)?;
    Ok(Some(Lines { all, half_width }))
}
