//! One loop to be timed: its pipeline, its points, and how much of it one dispatch runs.

use super::clock::Stopwatch;
use super::{Device, GpuError, TimingOptions};
use crate::gpu::dispatch::bind;
use crate::gpu::program::{Pipeline, Program, WORKGROUP};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use wgpu::util::DeviceExt;

/// Most workgroups of a dispatch; within every adapter's limit.
const MOST_GROUPS: u32 = 65_535;
/// Most turns of the loop.
const MOST_TURNS: u32 = 1 << 16;
/// Dispatches of which the shortest counts when the amount of work is chosen.
const READINGS: usize = 3;

/// Size of the buffer that takes the sums of any item, bytes.
pub(super) const SUMS_BYTES: u64 = MOST_GROUPS as u64 * WORKGROUP as u64 * 4;

/// A loop to be timed.
pub(super) struct Item {
    pub(super) pipeline: Pipeline,
    pub(super) group: wgpu::BindGroup,
    pub(super) groups: u32,
    size: wgpu::Buffer,
    points: u32,
    turns: u32,
    usual_turns: u32,
    /// Evaluations in one turn of the loop.
    unrolled: u32,
}

impl Item {
    pub(super) fn new(
        device: &Device,
        sums: &wgpu::Buffer,
        program: &Program,
        inputs: &[Vec<u32>],
        options: &TimingOptions,
    ) -> Result<Self, GpuError> {
        let points = options.points.clamp(1, 1 << 20).next_power_of_two();
        let columns = shuffled(inputs, points, options.seed);
        let pipeline = program.pipeline(device)?;
        let points = u32::try_from(points).unwrap_or(1 << 20);
        let usual_turns = options.repeats.div_ceil(program.unrolled).clamp(1, MOST_TURNS);
        let (size, group) = device.guarded(|| {
            let buffer = |label, contents: &[u8], usage| {
                let descriptor =
                    wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage };
                device.raw.create_buffer_init(&descriptor)
            };
            let inputs =
                buffer("inputs", bytemuck::cast_slice(&columns), wgpu::BufferUsages::STORAGE);
            let size = buffer(
                "size",
                bytemuck::cast_slice(&[points, 1, 0, 0]),
                wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            );
            let group = bind(device, &inputs, sums, &size);
            (size, group)
        })?;
        let groups = points.div_ceil(WORKGROUP);
        let unrolled = program.unrolled;
        Ok(Self { pipeline, group, groups, size, points, turns: 1, usual_turns, unrolled })
    }

    /// Evaluations in one dispatch.
    pub(super) fn evaluations(&self) -> u64 {
        u64::from(self.groups) * u64::from(self.turns) * u64::from(WORKGROUP * self.unrolled)
    }

    /// Chooses the work of a dispatch so that it takes about `target_ns`, but never less than one
    /// turn of the loop at each point.
    pub(super) fn adapt(
        &mut self,
        device: &Device,
        stopwatch: &Stopwatch,
        target_ns: f64,
    ) -> Result<(), GpuError> {
        // The first dispatch may include compilation by the driver.
        stopwatch.durations(device, &[self])?;
        // Growth by at most 16 at a time keeps one bad reading from asking for seconds of work.
        for _ in 0..8 {
            let mut shortest = f64::INFINITY;
            for _ in 0..READINGS {
                let durations = stopwatch.durations(device, &[self])?;
                // A NaN, from timestamps that did not advance, loses.
                shortest = durations.into_iter().fold(shortest, f64::min);
                let least = self.turns == 1 && self.groups == self.points.div_ceil(WORKGROUP);
                if least && shortest > 4.0 * target_ns {
                    return Ok(());
                }
            }
            let factor = (target_ns / shortest).clamp(1.0 / 16.0, 16.0);
            let (groups, turns) = self.shape(self.evaluations() as f64 * factor);
            let settled = factor < 4.0 || (groups, turns) == (self.groups, self.turns);
            (self.groups, self.turns) = (groups, turns);
            let sizes = [self.points, self.turns, 0, 0];
            let words = bytemuck::cast_slice(&sizes);
            device.guarded(|| device.queue.write_buffer(&self.size, 0, words))?;
            if settled {
                break;
            }
        }
        Ok(())
    }

    /// Workgroups and turns that make about `evaluations` evaluations: every point at least once,
    /// then the usual number of turns, then more invocations, then more turns.
    fn shape(&self, evaluations: f64) -> (u32, u32) {
        let turns_of = |groups: u32| evaluations / f64::from(groups * WORKGROUP * self.unrolled);
        let least = self.points.div_ceil(WORKGROUP);
        // The casts saturate, and NaN becomes 0.
        let groups = (turns_of(1) / f64::from(self.usual_turns)) as u32;
        let groups = groups.clamp(least.min(MOST_GROUPS), MOST_GROUPS);
        (groups, (turns_of(groups).round() as u32).clamp(1, MOST_TURNS))
    }
}

/// The columns one after the other, `points` rows each, in one random order for all of them.
fn shuffled(inputs: &[Vec<u32>], points: usize, seed: u64) -> Vec<u32> {
    let mut order: Vec<usize> = (0..inputs.first().map_or(0, Vec::len)).collect();
    order.shuffle(&mut ChaCha8Rng::seed_from_u64(seed));
    let mut columns = Vec::with_capacity(inputs.len() * points);
    for column in inputs {
        let values = order.iter().filter_map(|&row| column.get(row).copied());
        columns.extend(values.cycle().take(points));
    }
    // A form without arguments, or without points, still needs something to bind.
    columns.resize((inputs.len() * points).max(1), 0);
    columns
}
