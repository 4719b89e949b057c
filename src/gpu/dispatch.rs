//! A form compiled for the device, evaluated over any number of points.

use super::device::{Device, group};
use super::error::GpuError;
use super::program::{Pipeline, Program, Purpose, WORKGROUP};
use crate::form::{Form, Input};
use std::borrow::Cow;

/// Most points per dispatch: bounds the memory of a chunk and the time of a dispatch.
const CHUNK_POINTS: u64 = 1 << 22;

/// A form compiled for a device, with fixed parameters.
#[derive(Debug)]
pub struct DeviceKernel<'d> {
    device: &'d Device,
    program: Program,
    pipeline: Pipeline,
}

impl Device {
    /// Compiles `form` for this device.
    ///
    /// `parameters`: one value per entry of [`Form::parameters`], set as pipeline constants; the
    /// other `override` constants of the text keep their defaults. The tables of the form
    /// ([`Form::tables`]) are read from storage buffers. A kernel that this device has compiled
    /// before, from the same text and values, is not compiled again.
    ///
    /// # Errors
    /// [`GpuError`] if the number of values is wrong, or the device's compiler rejects the kernel.
    pub fn compile(&self, form: &Form, parameters: &[f32]) -> Result<DeviceKernel<'_>, GpuError> {
        self.kernel(Program::new(form, parameters, Purpose::Evaluate)?)
    }

    pub(super) fn kernel(&self, program: Program) -> Result<DeviceKernel<'_>, GpuError> {
        let pipeline = program.pipeline(self)?;
        Ok(DeviceKernel { device: self, program, pipeline })
    }
}

impl DeviceKernel<'_> {
    /// Where the text comes from.
    pub fn origin(&self) -> &str {
        self.program.form.origin()
    }

    /// Evaluates the form at every row of `inputs`.
    ///
    /// `inputs`: one column per entry of [`Form::input_columns`], all of one length. Returns one
    /// column per entry of [`Form::output_columns`], of that length. Nothing is rounded or clamped
    /// on the way; accuracy is what WGSL grants the device, and a device may flush subnormals.
    ///
    /// # Errors
    /// [`GpuError`] if the columns do not match the form, or the device fails.
    pub fn evaluate(&self, inputs: &[Vec<f32>]) -> Result<Vec<Vec<f32>>, GpuError> {
        self.evaluate_inputs(&inputs.iter().map(Input::from).collect::<Vec<_>>())
    }

    /// Evaluates the form at every row of columns of any type; otherwise as [`DeviceKernel::evaluate`].
    ///
    /// # Errors
    /// As [`DeviceKernel::evaluate`]; [`GpuError::Form`] if an integer argument does not take a number.
    pub fn evaluate_inputs(&self, inputs: &[Input<'_>]) -> Result<Vec<Vec<f32>>, GpuError> {
        let rows = self.program.check(inputs)?;
        let mut outputs = vec![Vec::with_capacity(rows); self.program.outputs()];
        if rows == 0 {
            return Ok(outputs);
        }
        let chunk = self.chunk_points().min(rows);
        let buffers = Buffers::new(self.device, &self.program, chunk)?;
        for start in (0..rows).step_by(chunk) {
            let end = (start + chunk).min(rows);
            let words = |(at, &column)| self.program.words(at, column, start..end);
            let columns = inputs.iter().enumerate().map(words).collect::<Result<Vec<_>, _>>()?;
            let values = self.run(&buffers, &columns, end - start)?;
            for (output, part) in outputs.iter_mut().zip(values.chunks_exact(end - start)) {
                output.extend_from_slice(part);
            }
        }
        Ok(outputs)
    }

    /// Points per dispatch that buffers and dispatch limits of the adapter allow.
    fn chunk_points(&self) -> usize {
        let limits = self.device.raw.limits();
        let columns = self.program.inputs().len().max(self.program.outputs()).max(1) as u64;
        let bytes = limits.max_buffer_size.min(limits.max_storage_buffer_binding_size);
        let groups = u64::from(limits.max_compute_workgroups_per_dimension);
        let points = (bytes / 4 / columns)
            .min(groups.saturating_mul(groups).saturating_mul(u64::from(WORKGROUP)))
            .clamp(1, CHUNK_POINTS);
        usize::try_from(points).unwrap_or(usize::MAX)
    }

    /// Evaluates `points` points; returns the output columns one after the other.
    fn run(
        &self,
        buffers: &Buffers,
        columns: &[Cow<'_, [u32]>],
        points: usize,
    ) -> Result<Vec<f32>, GpuError> {
        let device = self.device;
        let limit = device.raw.limits().max_compute_workgroups_per_dimension;
        let (across, down) = workgroups(points, limit);
        let bytes = (self.program.outputs() * points * 4) as u64;
        device.guarded(|| {
            let mut offset = 0;
            for column in columns {
                device.queue.write_buffer(&buffers.inputs, offset, bytemuck::cast_slice(column));
                offset += (column.len() * 4) as u64;
            }
            let size = [u32::try_from(points).unwrap_or(u32::MAX), 0, 0, 0];
            device.queue.write_buffer(&buffers.size, 0, bytemuck::cast_slice(&size));
            let mut encoder = device.raw.create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                self.pipeline.set(&mut pass, &buffers.group);
                pass.dispatch_workgroups(across, down, 1);
            }
            encoder.copy_buffer_to_buffer(&buffers.outputs, 0, &buffers.staging, 0, bytes);
            device.queue.submit([encoder.finish()]);
        })?;
        let read = device.read(&buffers.staging, bytes)?;
        Ok(bytemuck::pod_collect_to_vec(&read))
    }
}

/// Workgroups across and down that cover `points` invocations, at most `limit` each way.
fn workgroups(points: usize, limit: u32) -> (u32, u32) {
    let groups = u32::try_from(points.div_ceil(WORKGROUP as usize)).unwrap_or(u32::MAX);
    let across = groups.clamp(1, limit.max(1));
    (across, groups.div_ceil(across).max(1))
}

/// The buffers of one kernel, reused from chunk to chunk.
struct Buffers {
    inputs: wgpu::Buffer,
    outputs: wgpu::Buffer,
    size: wgpu::Buffer,
    staging: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl Buffers {
    fn new(device: &Device, program: &Program, points: usize) -> Result<Self, GpuError> {
        use wgpu::BufferUsages as Usage;
        device.guarded(|| {
            let buffer = |label, words: usize, usage| {
                device.raw.create_buffer(&wgpu::BufferDescriptor {
                    label: Some(label),
                    size: (words.max(1) * 4) as u64,
                    usage,
                    mapped_at_creation: false,
                })
            };
            let results = program.outputs() * points;
            let inputs =
                buffer("inputs", program.inputs().len() * points, Usage::STORAGE | Usage::COPY_DST);
            let outputs = buffer("outputs", results, Usage::STORAGE | Usage::COPY_SRC);
            let size = buffer("size", 4, Usage::UNIFORM | Usage::COPY_DST);
            let staging = buffer("staging", results, Usage::MAP_READ | Usage::COPY_DST);
            let group = bind(device, &inputs, &outputs, &size);
            Self { inputs, outputs, size, staging, group }
        })
    }
}

/// Binds the three buffers of a kernel.
pub(super) fn bind(
    device: &Device,
    inputs: &wgpu::Buffer,
    outputs: &wgpu::Buffer,
    size: &wgpu::Buffer,
) -> wgpu::BindGroup {
    group(&device.raw, "striae", &device.bindings, [inputs, outputs, size])
}

#[cfg(test)]
mod tests {
    use super::workgroups;

    #[test]
    fn dispatches_cover_the_points_within_the_limit() {
        assert_eq!(workgroups(1, 65535), (1, 1));
        assert_eq!(workgroups(65, 65535), (2, 1));
        assert_eq!(workgroups(65535 * 64 + 1, 65535), (65535, 2));
        let (across, down) = workgroups(1 << 22, 1000);
        assert!(across <= 1000 && across * down * 64 >= 1 << 22);
    }
}
