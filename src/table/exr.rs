//! Grids as OpenEXR: f32 channels, one part, scan lines, with the axes in a sidecar.
//!
//! The sidecar `<file>.axes.toml` holds `[x]`, `[y]` and one `[[axis]]` per further axis ([`Axis`]),
//! and one `[[channel]]` with `name` and `unit` per channel. The pixels run as a [`Grid`]'s values do:
//! a grid of one axis is a row, one of more than two is its planes of x and y one below the other,
//! the last axis slowest. A half-float file reads too, since every half is an f32.

use std::ffi::OsString;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use ::exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
use ::exr::meta::attribute::{LevelMode, SampleType, Text};
use ::exr::meta::{BlockDescription, MetaData, header::Header};
use ::exr::prelude::{LayerAttributes, ReadChannels, ReadLayers, WritableImage, f16, read};
use serde::{Deserialize, Serialize};

use super::{Axis, Grid, GridChannel, TableError, store, units};

/// Largest size of the pixels of a grid, in bytes: what a file declares beyond this is refused
/// before memory is asked for.
pub const MAX_PIXEL_BYTES: u64 = 1 << 30;

/// No lossless method of EXR packs more than this many bytes into one (deflate's limit).
const MAX_COMPRESSION: u128 = 1032;

/// What stands in `<file>.axes.toml`.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sidecar {
    x: Axis,
    #[serde(skip_serializing_if = "Option::is_none")]
    y: Option<Axis>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    axis: Vec<Axis>,
    channel: Vec<ChannelEntry>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ChannelEntry {
    name: String,
    unit: String,
}

/// Where the axes of the grid in `path` stand: `<path>.axes.toml`.
pub fn sidecar_path(path: &Path) -> PathBuf {
    let mut name = OsString::from(path.as_os_str());
    name.push(".axes.toml");
    PathBuf::from(name)
}

impl Grid {
    /// Reads an EXR file and its sidecar. The origin is the file with its SHA-256.
    ///
    /// # Errors
    /// [`TableError`] naming the file, for: a file that is missing, malformed, truncated or larger
    /// than [`MAX_PIXEL_BYTES`]; several parts, tiles with levels, subsampled or integer channels;
    /// a sidecar that does not describe the same size and channels; values that are not finite.
    pub fn read_exr(path: impl AsRef<Path>) -> Result<Self, TableError> {
        let path = path.as_ref();
        let sidecar = sidecar_path(path);
        let sidecar_origin = sidecar.display().to_string();
        let axes = store::read_text(&sidecar)?;
        let pixels = store::read(path)?;
        let mut grid =
            Self::read_exr_bytes(&path.display().to_string(), &pixels, &sidecar_origin, &axes)?;
        grid.origin = store::origin(path, &pixels);
        Ok(grid)
    }

    /// As [`Grid::read_exr`], from memory; the origins name the two inputs in messages.
    ///
    /// # Errors
    /// As [`Grid::read_exr`].
    pub fn read_exr_bytes(
        origin: &str,
        pixels: &[u8],
        sidecar_origin: &str,
        sidecar: &str,
    ) -> Result<Self, TableError> {
        let fault = |reason: &str| TableError::malformed(sidecar_origin, reason);
        let sidecar: Sidecar =
            toml::from_str(sidecar).map_err(|e| fault(e.to_string().trim_end()))?;
        if sidecar.y.is_none() && !sidecar.axis.is_empty() {
            return Err(fault("no [y] before [[axis]]"));
        }
        let axes: Vec<Axis> =
            [sidecar.x].into_iter().chain(sidecar.y).chain(sidecar.axis).collect();
        axes.iter().try_for_each(|axis| axis.check(sidecar_origin))?;
        let decoded = decode(origin, pixels)?;
        let mut grid = Self { axes, channels: Vec::new(), origin: origin.into() };
        let (across, down) = grid.pixels();
        if (decoded.width, decoded.height) != (across, down) {
            let (w, h) = (decoded.width, decoded.height);
            return Err(fault(&format!(
                "the axes have {across} × {down} texels, {origin} has {w} × {h}"
            )));
        }
        grid.channels = match_channels(origin, sidecar_origin, decoded.channels, sidecar.channel)?;
        grid.check()?;
        Ok(grid)
    }

    /// Pixels across and down of the grid's file.
    fn pixels(&self) -> (usize, usize) {
        let down = self.axes.iter().skip(1);
        (self.x().count, down.fold(1, |product, axis| product.saturating_mul(axis.count)))
    }

    /// Writes the sidecar and then the EXR file, each whole or not at all. The same grid always
    /// gives the same bytes.
    ///
    /// # Errors
    /// As [`Grid::check`] and [`store::atomic_write`].
    pub fn write_exr(&self, path: impl AsRef<Path>) -> Result<(), TableError> {
        let path = path.as_ref();
        let (pixels, sidecar) = self.to_exr()?;
        store::atomic_write(&sidecar_path(path), sidecar.as_bytes())?;
        store::atomic_write(path, &pixels)
    }

    /// The EXR file and the text of its sidecar.
    ///
    /// # Errors
    /// As [`Grid::check`]; [`TableError::Content`] if the encoder refuses a channel name.
    pub fn to_exr(&self) -> Result<(Vec<u8>, String), TableError> {
        self.check()?;
        let channels: Vec<(&str, &[f32])> =
            self.channels.iter().map(|c| (c.name.as_str(), c.values.as_slice())).collect();
        let pixels = encode(&self.origin, self.pixels(), &channels, singles)?;

        let entry = |c: &GridChannel| ChannelEntry { name: c.name.clone(), unit: c.unit.clone() };
        let sidecar = Sidecar {
            x: self.x().clone(),
            y: self.axes.get(1).cloned(),
            axis: self.axes.iter().skip(2).cloned().collect(),
            channel: self.channels.iter().map(entry).collect(),
        };
        let text = toml::to_string(&sidecar).map_err(|e| TableError::malformed(&self.origin, e))?;
        Ok((pixels, text))
    }
}

/// The pixels of an EXR file.
pub(crate) struct Decoded {
    /// Pixels across.
    pub(crate) width: usize,
    /// Pixels down.
    pub(crate) height: usize,
    /// Name and values of every channel, in the order of the file.
    pub(crate) channels: Vec<(String, Vec<f32>)>,
}

/// Samples of 32 bits, as they are.
pub(crate) fn singles(values: &[f32]) -> FlatSamples {
    FlatSamples::F32(values.to_vec())
}

/// Each value rounded to the nearest half: relative error up to 2⁻¹¹, absolute up to 2⁻²⁵ below 2⁻¹⁴,
/// infinite from 65520 on.
pub(crate) fn halves(values: &[f32]) -> FlatSamples {
    FlatSamples::F16(values.iter().map(|value| f16::from_f32(*value)).collect())
}

/// An EXR file of channels, losslessly packed; `origin` names it in messages. The same pixels always
/// give the same bytes.
///
/// # Errors
/// [`TableError::Content`] if the encoder refuses a name or the numbers of values.
pub(crate) fn encode(
    origin: &str,
    (width, height): (usize, usize),
    channels: &[(&str, &[f32])],
    samples: fn(&[f32]) -> FlatSamples,
) -> Result<Vec<u8>, TableError> {
    let mut list = Vec::with_capacity(channels.len());
    for (name, values) in channels {
        let name = Text::new_or_none(name)
            .ok_or_else(|| format!("EXR cannot name a channel {name:?}"))
            .map_err(|reason| TableError::malformed(origin, reason))?;
        list.push(AnyChannel::new(name, samples(values)));
    }
    let layer = Layer::new(
        (width, height),
        LayerAttributes::default(),
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(list.into()),
    );
    let mut bytes = Cursor::new(Vec::new());
    let image = Image::from_layer(layer);
    let written = image.write().non_parallel().to_buffered(&mut bytes);
    written.map_err(|e| TableError::malformed(origin, e))?;
    Ok(bytes.into_inner())
}

/// Decodes after checking that the header asks for something that this crate reads and that the
/// file can hold.
pub(crate) fn decode(origin: &str, bytes: &[u8]) -> Result<Decoded, TableError> {
    let fault = |e| TableError::malformed(origin, e);
    let attempt = || {
        let meta = MetaData::read_from_buffered(Cursor::new(bytes), true).map_err(fault)?;
        let [header] = meta.headers.as_slice() else {
            let reason = format!("{} parts, expected one", meta.headers.len());
            return Err(TableError::malformed(origin, reason));
        };
        check_header(origin, header, bytes.len())?;
        read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .pedantic()
            .non_parallel()
            .from_buffered(Cursor::new(bytes))
            .map_err(fault)
    };
    // The decoder is not ours, and its panics on a malformed file must not become ours.
    let image = std::panic::catch_unwind(attempt)
        .unwrap_or_else(|_| Err(TableError::malformed(origin, "the decoder gave up on it")))?;

    let size = image.layer_data.size;
    let channels = image.layer_data.channel_data.list.into_iter();
    Ok(Decoded {
        width: size.0,
        height: size.1,
        channels: channels
            .map(|c| (c.name.to_string(), c.sample_data.values_as_f32().collect()))
            .collect(),
    })
}

fn check_header(origin: &str, header: &Header, file_bytes: usize) -> Result<(), TableError> {
    let fault = |reason: &str| Err(TableError::malformed(origin, reason));
    if header.deep {
        return fault("deep data is not read");
    }
    if let BlockDescription::Tiles(tiles) = header.blocks
        && tiles.level_mode != LevelMode::Singular
    {
        return fault("resolution levels are not read");
    }
    let mut texel_bytes = 0u128;
    for channel in &header.channels.list {
        if channel.sample_type == SampleType::U32 {
            return fault(&format!("channel {:?}: integers, expected f32", channel.name));
        }
        if channel.sampling.0 != 1 || channel.sampling.1 != 1 {
            return fault(&format!("channel {:?} is subsampled", channel.name));
        }
        texel_bytes += channel.sample_type.bytes_per_sample() as u128;
    }
    let texels = header.layer_size.0 as u128 * header.layer_size.1 as u128;
    let declared = texels.saturating_mul(texel_bytes);
    let packed = file_bytes as u128 * MAX_COMPRESSION;
    for (limit, why) in [
        (u128::from(MAX_PIXEL_BYTES), "the largest grid that is read"),
        (packed, "as much as a file of this size can hold"),
    ] {
        if declared > limit {
            return Err(TableError::too_large(origin, declared, limit, why));
        }
    }
    Ok(())
}

/// Brings the channels into the order of the sidecar, which must name exactly those that are there.
fn match_channels(
    origin: &str,
    sidecar_origin: &str,
    mut decoded: Vec<(String, Vec<f32>)>,
    entries: Vec<ChannelEntry>,
) -> Result<Vec<GridChannel>, TableError> {
    let mut channels = Vec::with_capacity(entries.len());
    for entry in entries {
        units::require(&entry.unit, sidecar_origin, &entry.name)?;
        let Some(index) = decoded.iter().position(|(name, _)| *name == entry.name) else {
            let place = format!("{origin} (named by {sidecar_origin})");
            let known = decoded.iter().map(|(name, _)| name.as_str());
            return Err(TableError::unknown_column(&place, &entry.name, known));
        };
        let (name, values) = decoded.swap_remove(index);
        channels.push(GridChannel { name, unit: entry.unit, values });
    }
    match decoded.first() {
        Some((name, _)) => {
            let reason = format!("no entry for channel {name:?} of {origin}");
            Err(TableError::malformed(sidecar_origin, reason))
        }
        None => Ok(channels),
    }
}
