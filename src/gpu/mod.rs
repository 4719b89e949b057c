//! Forms on the device, through wgpu (Vulkan, Metal, Direct3D 12).
//!
//! [`Device::open`] finds an adapter, [`Device::compile`] wraps the form's own text in a compute
//! kernel with the fitted values as pipeline constants and its tables in buffers, once per device,
//! [`DeviceKernel::evaluate`] runs it over any number of points, and [`time`] measures what forms cost. Every result that comes from a device
//! is to be shown beside its [`AdapterDescription`]. Nothing here panics for want of a device:
//! [`NoDevice`] and [`GpuError`] say what is missing.

mod adapter;
mod device;
mod dispatch;
mod error;
mod pipelines;
mod program;
mod tables;
mod timing;

pub use adapter::{AdapterDescription, AdapterReport, list_adapters, required};
pub use device::Device;
pub use dispatch::DeviceKernel;
pub use error::{GpuError, NoDevice};
pub use pipelines::PipelineCount;
pub(crate) use program::{constant_key, unused_prefix};
pub use timing::{Clock, Spread, TimedForm, Timing, TimingFigures, TimingOptions, time};
