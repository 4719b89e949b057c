//! How long dispatches take, by the device's clock where it has one.

use super::item::{Item, SUMS_BYTES};
use super::{Device, GpuError, TimingOptions};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Whose clock a duration was read from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// Timestamps that the device writes before and after a dispatch.
    Device,
    /// The host's clock from submission to completion: includes the driver's overhead.
    Host,
}

/// Most dispatches of a round that share one query set; wgpu allows 4096 queries.
const SLOTS: usize = 2048;

/// Measures dispatches.
pub(super) struct Stopwatch {
    /// Takes the sums of every item: a write after a write, so that no two dispatches overlap.
    pub(super) sums: wgpu::Buffer,
    timestamps: Option<Timestamps>,
}

struct Timestamps {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    staging: wgpu::Buffer,
    period_ns: f64,
}

impl Stopwatch {
    pub(super) fn new(device: &Device) -> Result<Self, GpuError> {
        use wgpu::BufferUsages as Usage;
        let buffer = |label, size, usage| {
            device.raw.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let sums = device.guarded(|| buffer("sums", SUMS_BYTES, Usage::STORAGE))?;
        if !device.raw.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return Ok(Self { sums, timestamps: None });
        }
        let timestamps = device.guarded(|| {
            let bytes = (2 * SLOTS * 8) as u64;
            Timestamps {
                queries: device.raw.create_query_set(&wgpu::QuerySetDescriptor {
                    label: Some("timestamps"),
                    ty: wgpu::QueryType::Timestamp,
                    count: 2 * SLOTS as u32,
                }),
                resolved: buffer("timestamps", bytes, Usage::QUERY_RESOLVE | Usage::COPY_SRC),
                staging: buffer("timestamps staging", bytes, Usage::MAP_READ | Usage::COPY_DST),
                period_ns: f64::from(device.queue.get_timestamp_period()),
            }
        })?;
        Ok(Self { sums, timestamps: Some(timestamps) })
    }

    pub(super) fn clock(&self) -> Clock {
        if self.timestamps.is_some() { Clock::Device } else { Clock::Host }
    }

    /// Runs all of `items` once per round; ns per evaluation, `[round][item]`. One more round
    /// comes first and is thrown away. Ends early when the budget of `options` is spent.
    pub(super) fn rounds(
        &self,
        device: &Device,
        items: &[Item],
        options: &TimingOptions,
    ) -> Result<Vec<Vec<f64>>, GpuError> {
        let start = Instant::now();
        let mut rounds = Vec::with_capacity(options.rounds);
        for round in 0..=options.rounds.max(1) {
            let late = start.elapsed().as_secs_f64() > options.budget_s;
            if late && rounds.len() >= TimingOptions::LEAST_ROUNDS {
                break;
            }
            // Every round begins with another item, so that none is always the first after a pause.
            let order: Vec<usize> =
                (0..items.len()).map(|place| (place + round) % items.len()).collect();
            let mut costs = vec![f64::NAN; items.len()];
            for part in order.chunks(SLOTS) {
                let run: Vec<&Item> = part.iter().map(|place| &items[*place]).collect();
                for (place, ns) in part.iter().zip(self.durations(device, &run)?) {
                    costs[*place] = ns / items[*place].evaluations() as f64;
                }
            }
            if round > 0 {
                rounds.push(costs);
            }
        }
        Ok(rounds)
    }

    /// Runs each of `items` once, at most [`SLOTS`] of them; durations in ns, NaN where the
    /// timestamps did not advance.
    pub(super) fn durations(&self, device: &Device, items: &[&Item]) -> Result<Vec<f64>, GpuError> {
        match &self.timestamps {
            Some(timestamps) => timestamps.durations(device, items),
            None => items.iter().map(|item| on_the_host(device, item)).collect(),
        }
    }
}

impl Timestamps {
    fn durations(&self, device: &Device, items: &[&Item]) -> Result<Vec<f64>, GpuError> {
        let count = 2 * items.len() as u32;
        let bytes = u64::from(count) * 8;
        device.guarded(|| {
            let mut encoder = device.raw.create_command_encoder(&Default::default());
            for (begin, item) in (0..).step_by(2).zip(items) {
                let writes = wgpu::ComputePassTimestampWrites {
                    query_set: &self.queries,
                    beginning_of_pass_write_index: Some(begin),
                    end_of_pass_write_index: Some(begin + 1),
                };
                encode(&mut encoder, item, Some(writes));
            }
            encoder.resolve_query_set(&self.queries, 0..count, &self.resolved, 0);
            encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.staging, 0, bytes);
            device.queue.submit([encoder.finish()]);
        })?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&device.read(&self.staging, bytes)?);
        let duration = |pair: &[u64]| match pair {
            [begin, end] if end > begin => (end - begin) as f64 * self.period_ns,
            _ => f64::NAN,
        };
        Ok(ticks.chunks_exact(2).map(duration).collect())
    }
}

fn on_the_host(device: &Device, item: &Item) -> Result<f64, GpuError> {
    let start = Instant::now();
    device.guarded(|| {
        let mut encoder = device.raw.create_command_encoder(&Default::default());
        encode(&mut encoder, item, None);
        device.queue.submit([encoder.finish()]);
    })?;
    device.wait()?;
    Ok(start.elapsed().as_secs_f64() * 1e9)
}

fn encode(
    encoder: &mut wgpu::CommandEncoder,
    item: &Item,
    timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>,
) {
    let descriptor = wgpu::ComputePassDescriptor { label: None, timestamp_writes };
    let mut pass = encoder.begin_compute_pass(&descriptor);
    item.pipeline.set(&mut pass, &item.group);
    pass.dispatch_workgroups(item.groups, 1, 1);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form::ScalarType;
    use crate::gpu::program::Program;

    /// Both clocks give a duration; the host's, which includes more, is used without timestamps.
    #[test]
    fn the_host_stands_in_for_missing_timestamps() -> Result<(), GpuError> {
        let Ok(device) = Device::open() else {
            println!("skipped: no adapter");
            return Ok(());
        };
        let with = Stopwatch::new(&device)?;
        let without = Stopwatch { sums: with.sums.clone(), timestamps: None };
        assert_eq!(without.clock(), Clock::Host);
        let program = Program::empty_loop(&[ScalarType::F32])?;
        let inputs = [[1.0_f32, 2.0, 3.0].map(f32::to_bits).to_vec()];
        let options = TimingOptions { rounds: 3, ..Default::default() };
        let items = [Item::new(&device, &with.sums, &program, &inputs, &options)?];
        for stopwatch in [with, without] {
            let rounds = stopwatch.rounds(&device, &items, &options)?;
            assert_eq!(rounds.len(), 3);
            assert!(rounds.iter().flatten().all(|ns| *ns > 0.0), "{rounds:?}");
        }
        Ok(())
    }
}
