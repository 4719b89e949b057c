//! Passes over a map: turned, convolved, looked up, on the device or on CPU lanes from one text.

use super::{SphereMap, Taps};
use crate::form::{DataTable, Form};
use crate::render::RenderError;
use crate::render::backend::{Backend, Kernel, Painter, add};
use crate::render::shading::Columns;
use crate::render::times::TimedPass;

/// The text of all passes.
pub(in crate::render) const TEXT: &str = include_str!("sphere_map.wgsl");
/// The file of that text.
const FILE: &str = "src/render/sphere_map/sphere_map.wgsl";
/// Most taps of one evaluation.
pub(in crate::render) const MOST_TAPS: usize = 1024;
/// No turn.
pub(in crate::render) const STILL: [[f64; 3]; 3] =
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A kernel over `layers`, which have one size: a text, its file and the function, with `more` tables.
pub(in crate::render) fn kernel(
    (text, file, function): (&str, &str, &str),
    layers: &[SphereMap],
    taps: &Taps,
    per_evaluation: usize,
    turn: [[f64; 3]; 3],
    more: Vec<DataTable>,
) -> Result<Kernel, RenderError> {
    let (width, height) = layers.first().map_or((2, 1), |layer| (layer.width, layer.height));
    let maps: Vec<f32> = layers.iter().flat_map(|layer| layer.rgb.iter().copied()).collect();
    let numbers = if taps.count() == 0 { &[0.0; 6] } else { taps.numbers() };
    let mut tables = vec![DataTable::new("environment", maps), DataTable::new("taps", numbers)];
    tables.extend(more);
    let form = Form::parse_with(file, text, function, tables)?;
    let value = |name: &str| match name {
        "width" => width as f32,
        "height" => height as f32,
        "tap_count" => taps.count() as f32,
        "tap_block" => per_evaluation as f32,
        turn_name => {
            let place = |axis: Option<char>| "xyz".find(axis.unwrap_or('x')).unwrap_or(0);
            let mut axes = turn_name.chars().rev();
            let (column, row) = (place(axes.next()), place(axes.next()));
            turn[row][column] as f32
        }
    };
    let constants = form.parameters().iter().map(|parameter| value(&parameter.name)).collect();
    Ok(Kernel { form, constants })
}

/// The map whose value at d is that of `map` at R d; `turn` holds the rows of R.
///
/// # Errors
/// [`RenderError`] if the kernel does not compile or the device fails.
pub fn turned(
    map: &SphereMap,
    turn: [[f64; 3]; 3],
    backend: Backend<'_>,
) -> Result<SphereMap, RenderError> {
    let kernel = of_map(map, "turned", turn)?;
    Ok(map.with(&Painter::new(vec![kernel], backend)?.colours(&map.places())?))
}

/// Looks the map up in directions given as columns x, y, z.
///
/// # Errors
/// [`RenderError`] if the kernel does not compile.
pub(in crate::render) fn lookup<'d>(
    map: &SphereMap,
    backend: Backend<'d>,
) -> Result<Painter<'d>, RenderError> {
    Painter::new(vec![of_map(map, "seen", STILL)?], backend)
}

fn of_map(map: &SphereMap, function: &str, turn: [[f64; 3]; 3]) -> Result<Kernel, RenderError> {
    let layer = std::slice::from_ref(map);
    kernel((TEXT, FILE, function), layer, &Taps::default(), 1, turn, Vec::new())
}

/// Every layer with its own list of taps, one result per layer. A single layer may take several
/// lists, each with a result of its own.
///
/// # Errors
/// As [`turned`].
pub fn convolved(
    layers: &[SphereMap],
    lists: &[Taps],
    backend: Backend<'_>,
) -> Result<Vec<SphereMap>, RenderError> {
    let Some(map) = layers.first() else { return Ok(Vec::new()) };
    let (kernel, blocks) = convolution(layers, lists)?;
    let painter = Painter::new(vec![kernel], backend)?;
    let places = map.places();
    blocks.iter().map(|blocks| Ok(map.with(&summed(&painter, &places, blocks)?))).collect()
}

/// First tap and layer of the blocks of a list.
type Blocks = Vec<[f32; 2]>;

/// The kernel of [`convolved`], and per list the first tap and the layer of each of its blocks: lists
/// are padded to whole blocks, so that a block belongs to one list.
fn convolution(layers: &[SphereMap], lists: &[Taps]) -> Result<(Kernel, Vec<Blocks>), RenderError> {
    let longest = lists.iter().map(Taps::count).max().unwrap_or(0);
    let per_evaluation = longest.clamp(1, MOST_TAPS);
    let mut taps = Taps::default();
    let mut blocks = Vec::with_capacity(lists.len());
    for (at, list) in lists.iter().enumerate() {
        let begin = taps.count();
        taps.extend(list);
        while taps.count() % per_evaluation != 0 {
            taps.push([0.0, 0.0, 1.0], [0.0; 3]);
        }
        let layer = at.min(layers.len().saturating_sub(1)) as f32;
        let firsts = (begin..taps.count()).step_by(per_evaluation);
        blocks.push(firsts.map(|first| [first as f32, layer]).collect());
    }
    let text = (TEXT, FILE, "convolved");
    Ok((kernel(text, layers, &taps, per_evaluation, STILL, Vec::new())?, blocks))
}

/// R, G, B at `points`, given as columns, added up over blocks of taps; what stands for a block follows
/// the columns.
pub(in crate::render) fn summed<const N: usize>(
    painter: &Painter<'_>,
    points: &[Vec<f32>],
    blocks: &[[f32; N]],
) -> Result<Columns, RenderError> {
    let mut sums = vec![vec![0.0; points.first().map_or(0, Vec::len)]; 3];
    for block in blocks {
        add(&mut sums, painter.colours(&with_block(points, *block))?);
    }
    Ok(sums)
}

fn with_block<const N: usize>(points: &[Vec<f32>], block: [f32; N]) -> Columns {
    let rows = points.first().map_or(0, Vec::len);
    points.iter().cloned().chain(block.map(|value| vec![value; rows])).collect()
}

impl TimedPass {
    /// The pass that [`convolved`] makes; `layers` are not empty.
    ///
    /// # Errors
    /// As [`turned`].
    pub fn convolved(layers: &[SphereMap], lists: &[Taps]) -> Result<Self, RenderError> {
        let (kernel, blocks) = convolution(layers, lists)?;
        Ok(Self::summed(kernel, &layers[0].places(), [0.0; 2], blocks.iter().map(Vec::len).sum()))
    }

    /// The sum over `blocks` blocks of taps at `points`, as [`summed`] makes it.
    pub(in crate::render) fn summed<const N: usize>(
        kernel: Kernel,
        points: &[Vec<f32>],
        block: [f32; N],
        blocks: usize,
    ) -> Self {
        let inputs = with_block(points, block);
        let evaluations = blocks * points.first().map_or(0, Vec::len);
        Self { kernel, inputs, evaluations }
    }
}
