//! An opened device, with every error of wgpu turned into a value.

use super::adapter::{self, AdapterDescription};
use super::error::{GpuError, NoDevice};
use super::pipelines::{PipelineCount, Pipelines};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::time::{Duration, Instant};

/// Longest wait for one submission, seconds. Chunks of [`super::DeviceKernel::evaluate`] take
/// milliseconds; a kernel that needs longer than this hangs.
const WAIT_SECONDS: u64 = 120;

/// An opened device. Opening takes tens of milliseconds: open once and pass it on.
#[derive(Debug)]
pub struct Device {
    pub(super) raw: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    /// Of every kernel: inputs, outputs, and four sizes.
    pub(super) bindings: wgpu::BindGroupLayout,
    pub(super) layout: wgpu::PipelineLayout,
    pub(super) pipelines: Pipelines,
    description: AdapterDescription,
    faults: Arc<Mutex<Faults>>,
}

/// What the driver reported outside any error scope.
#[derive(Debug, Default)]
struct Faults {
    lost: Option<String>,
    uncaptured: Option<String>,
}

impl Device {
    /// Opens the preferred adapter.
    ///
    /// Discrete before integrated before virtual before software; `WGPU_ADAPTER_NAME` (part of a
    /// name, any case) picks another.
    ///
    /// # Errors
    /// [`NoDevice`] if there is no adapter, none of that name, or it does not open.
    pub fn open() -> Result<Self, NoDevice> {
        let adapter = adapter::preferred()?;
        let description = adapter::describe(&adapter.get_info());
        let wanted = wgpu::Features::TIMESTAMP_QUERY;
        let (raw, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("striae"),
            required_features: adapter.features() & wanted,
            required_limits: adapter.limits(),
            ..Default::default()
        }))
        .map_err(|error| NoDevice::Refused {
            adapter: description.name.clone(),
            reason: error.to_string(),
        })?;
        let faults = watch(&raw);
        let bindings = group_layout(
            &raw,
            "striae",
            &[
                wgpu::BufferBindingType::Storage { read_only: true },
                wgpu::BufferBindingType::Storage { read_only: false },
                wgpu::BufferBindingType::Uniform,
            ],
        );
        let layout = pipeline_layout(&raw, "striae", &[Some(&bindings)]);
        let pipelines = Pipelines::default();
        Ok(Self { raw, queue, bindings, layout, pipelines, description, faults })
    }

    /// Which device this is; goes into every output that holds a number measured on it.
    pub fn description(&self) -> &AdapterDescription {
        &self.description
    }

    /// How many kernels were compiled so far, and how often one was found compiled.
    pub fn pipelines(&self) -> PipelineCount {
        self.pipelines.count()
    }

    /// Runs `operation` and returns what it returns, or the first error that wgpu reports during it.
    pub(super) fn guarded<T>(&self, operation: impl FnOnce() -> T) -> Result<T, GpuError> {
        let scopes = [
            wgpu::ErrorFilter::Validation,
            wgpu::ErrorFilter::OutOfMemory,
            wgpu::ErrorFilter::Internal,
        ]
        .map(|filter| self.raw.push_error_scope(filter));
        let value = operation();
        let mut first = None;
        for scope in scopes.into_iter().rev() {
            first = pollster::block_on(scope.pop()).or(first);
        }
        if first.is_some() {
            // A lost device fails in many ways: its loss, which only a poll reports, is the cause.
            self.poll(wgpu::PollType::Poll)?;
        }
        self.check_faults()?;
        match first {
            None => Ok(value),
            Some(wgpu::Error::OutOfMemory { source }) => {
                Err(GpuError::OutOfMemory(source.to_string()))
            }
            Some(
                wgpu::Error::Validation { description, .. }
                | wgpu::Error::Internal { description, .. },
            ) => Err(GpuError::Device(description)),
        }
    }

    /// Waits for everything submitted so far.
    pub(super) fn wait(&self) -> Result<(), GpuError> {
        let poll = wgpu::PollType::Wait {
            submission_index: None,
            timeout: Some(Duration::from_secs(WAIT_SECONDS)),
        };
        self.poll(poll)
    }

    fn poll(&self, poll: wgpu::PollType) -> Result<(), GpuError> {
        // wgpu panics, instead of returning an error, when it finds the device lost here.
        match catch_unwind(AssertUnwindSafe(|| self.raw.poll(poll))) {
            Ok(Ok(_)) => self.check_faults(),
            Ok(Err(wgpu::PollError::Timeout)) => Err(GpuError::TimedOut(WAIT_SECONDS)),
            Ok(Err(error)) => Err(GpuError::Device(error.to_string())),
            Err(_) => {
                self.check_faults()?;
                Err(GpuError::Lost("while waiting for a kernel".to_owned()))
            }
        }
    }

    /// Reads `bytes` bytes from the start of `buffer`, which was created for reading.
    pub(super) fn read(&self, buffer: &wgpu::Buffer, bytes: u64) -> Result<Vec<u8>, GpuError> {
        let (sender, outcome) = mpsc::channel();
        self.guarded(|| {
            // Whoever waits is below, and has no use for a late answer.
            let send = move |result| drop(sender.send(result));
            buffer.map_async(wgpu::MapMode::Read, 0..bytes, send);
        })?;
        let start = Instant::now();
        let mapped = loop {
            self.wait()?;
            // A device that has finished may hand the buffer over in a later poll, or in that of another
            // thread.
            match outcome.recv_timeout(Duration::from_millis(1)) {
                Ok(mapped) => break mapped,
                Err(_) if start.elapsed().as_secs() < WAIT_SECONDS => {}
                Err(_) => return Err(GpuError::TimedOut(WAIT_SECONDS)),
            }
        };
        let failed = |error: &dyn std::fmt::Display| GpuError::Device(error.to_string());
        mapped.map_err(|error| failed(&error))?;
        let copy = buffer.get_mapped_range(0..bytes).map_err(|error| failed(&error))?.to_vec();
        buffer.unmap();
        Ok(copy)
    }

    /// What the driver has reported since, if anything.
    pub(super) fn check_faults(&self) -> Result<(), GpuError> {
        let mut faults = self.faults.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(reason) = &faults.lost {
            return Err(GpuError::Lost(reason.clone()));
        }
        match faults.uncaptured.take() {
            Some(report) => Err(GpuError::Device(report)),
            None => Ok(()),
        }
    }
}

/// Records what would otherwise panic or be lost.
fn watch(device: &wgpu::Device) -> Arc<Mutex<Faults>> {
    let faults = Arc::new(Mutex::new(Faults::default()));
    let lost = Arc::clone(&faults);
    device.set_device_lost_callback(move |_, message| {
        lost.lock().unwrap_or_else(PoisonError::into_inner).lost = Some(message);
    });
    let uncaptured = Arc::clone(&faults);
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        uncaptured.lock().unwrap_or_else(PoisonError::into_inner).uncaptured =
            Some(error.to_string());
    }));
    faults
}

/// The layout of a group of buffers, one binding each.
pub(super) fn group_layout(
    device: &wgpu::Device,
    label: &str,
    types: &[wgpu::BufferBindingType],
) -> wgpu::BindGroupLayout {
    let entry = |(binding, &ty)| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
        count: None,
    };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &(0..).zip(types).map(entry).collect::<Vec<_>>(),
    })
}

/// Buffers as a group of that layout, in the order of their bindings.
pub(super) fn group<'b>(
    device: &wgpu::Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    buffers: impl IntoIterator<Item = &'b wgpu::Buffer>,
) -> wgpu::BindGroup {
    let entry = |(binding, buffer): (u32, &'b wgpu::Buffer)| wgpu::BindGroupEntry {
        binding,
        resource: buffer.as_entire_binding(),
    };
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(label),
        layout,
        entries: &(0..).zip(buffers).map(entry).collect::<Vec<_>>(),
    })
}

pub(super) fn pipeline_layout(
    device: &wgpu::Device,
    label: &str,
    groups: &[Option<&wgpu::BindGroupLayout>],
) -> wgpu::PipelineLayout {
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: groups,
        immediate_size: 0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form::Form;
    use crate::gpu::program::{Program, Purpose};

    /// A destroyed device stands in for one that the driver took away.
    #[test]
    fn a_lost_device_is_an_error() -> Result<(), GpuError> {
        let Ok(device) = Device::open() else {
            println!("skipped: no adapter");
            return Ok(());
        };
        let source = "fn f(x: f32) -> f32 { return x; }";
        let program = Program::new(&Form::parse("f.wgsl", source, "f")?, &[], Purpose::Evaluate)?;
        let kernel = device.kernel(program.clone())?;
        assert_eq!(kernel.evaluate(&[vec![1.0]])?, [[1.0]]);
        device.raw.destroy();
        let after = kernel.evaluate(&[vec![1.0]]);
        assert!(matches!(after, Err(GpuError::Lost(_))), "{after:?}");
        let after = device.kernel(program).map(|_| ());
        assert!(matches!(after, Err(GpuError::Lost(_))), "{after:?}");
        Ok(())
    }
}
