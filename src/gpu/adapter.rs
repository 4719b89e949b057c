//! Which adapters there are, and which one is used.

use super::error::NoDevice;
use serde::{Deserialize, Serialize};

/// What identifies a device beside every number that was measured on it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct AdapterDescription {
    /// Name, as the driver gives it.
    pub name: String,
    /// Name of the driver.
    pub driver: String,
    /// Version of the driver.
    pub driver_info: String,
    /// `vulkan`, `metal` or `dx12`.
    pub backend: String,
    /// `discrete`, `integrated`, `virtual`, `cpu` or `other`.
    pub device_type: String,
    /// PCI vendor, hexadecimal.
    pub vendor: String,
    /// PCI device, hexadecimal.
    pub device: String,
}

impl AdapterDescription {
    /// Whether it is a program on the CPU.
    pub fn is_software(&self) -> bool {
        self.device_type == "cpu"
    }
}

impl std::fmt::Display for AdapterDescription {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} ({}, {}", self.name, self.device_type, self.backend)?;
        for part in [&self.driver, &self.driver_info] {
            if !part.is_empty() {
                write!(f, ", {part}")?;
            }
        }
        write!(f, ")")
    }
}

/// An adapter with the features and limits that matter here, for `striae doctor`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct AdapterReport {
    /// Identity.
    #[serde(flatten)]
    pub description: AdapterDescription,
    /// Whether [`super::Device::open`] would use this one.
    pub preferred: bool,
    /// Timestamps on the device; without them timings use the host's clock.
    pub timestamp_query: bool,
    /// f64 in shaders.
    pub shader_f64: bool,
    /// Subgroup operations.
    pub subgroup: bool,
    /// Largest buffer, bytes.
    pub max_buffer_bytes: u64,
    /// Largest storage buffer that a kernel can bind, bytes.
    pub max_storage_binding_bytes: u64,
    /// Workgroups per dispatch and dimension.
    pub max_workgroups_per_dimension: u32,
    /// Invocations per workgroup.
    pub max_invocations_per_workgroup: u32,
}

/// Whether `STRIAE_REQUIRE_GPU=1` is set: a missing device is then a failure, not a skip.
pub fn required() -> bool {
    std::env::var("STRIAE_REQUIRE_GPU").is_ok_and(|value| value == "1")
}

/// Every adapter, in the order of preference.
pub fn list_adapters() -> Vec<AdapterReport> {
    let adapters = enumerate();
    let preferred = preferred_index(&adapters).ok();
    adapters.iter().enumerate().map(|(i, adapter)| report(adapter, preferred == Some(i))).collect()
}

/// The adapter to use: the best one whose name contains `WGPU_ADAPTER_NAME`, if that is set.
pub(super) fn preferred() -> Result<wgpu::Adapter, NoDevice> {
    let mut adapters = enumerate();
    let index = preferred_index(&adapters)?;
    Ok(adapters.swap_remove(index))
}

/// Rank and name of a kind of device.
fn kind(device_type: wgpu::DeviceType) -> (u8, &'static str) {
    match device_type {
        wgpu::DeviceType::DiscreteGpu => (0, "discrete"),
        wgpu::DeviceType::IntegratedGpu => (1, "integrated"),
        wgpu::DeviceType::VirtualGpu => (2, "virtual"),
        wgpu::DeviceType::Cpu => (3, "cpu"),
        wgpu::DeviceType::Other => (4, "other"),
    }
}

pub(super) fn describe(info: &wgpu::AdapterInfo) -> AdapterDescription {
    AdapterDescription {
        name: info.name.clone(),
        driver: info.driver.clone(),
        driver_info: info.driver_info.clone(),
        backend: info.backend.to_str().to_owned(),
        device_type: kind(info.device_type).1.to_owned(),
        vendor: format!("{:#06x}", info.vendor),
        device: format!("{:#06x}", info.device),
    }
}

/// All adapters, best first. GL is left out: it has no timestamps that can be relied on, and its
/// loader writes to stderr where there is no display.
fn enumerate() -> Vec<wgpu::Adapter> {
    let backends = wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12;
    if !wgpu::Instance::enabled_backend_features().intersects(backends) {
        return Vec::new();
    }
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    let instance = wgpu::Instance::new(descriptor);
    let mut adapters = pollster::block_on(instance.enumerate_adapters(backends));
    adapters.sort_by_cached_key(|adapter| rank(&adapter.get_info()));
    adapters
}

/// Sort key: kind of device, backend, then identity, so that the choice does not depend on the
/// order in which the loader finds the drivers.
fn rank(info: &wgpu::AdapterInfo) -> (u8, u8, String, u32, u32, String) {
    let backend = match info.backend {
        wgpu::Backend::Vulkan => 0,
        wgpu::Backend::Metal => 1,
        _ => 2,
    };
    let bus = info.device_pci_bus_id.clone();
    (kind(info.device_type).0, backend, info.name.clone(), info.vendor, info.device, bus)
}

fn preferred_index(adapters: &[wgpu::Adapter]) -> Result<usize, NoDevice> {
    let wanted = std::env::var("WGPU_ADAPTER_NAME").ok();
    let names: Vec<String> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    position(&names, wanted.as_deref().filter(|name| !name.trim().is_empty()))
}

/// Index of the first of `names` that contains `wanted`, whatever the case.
fn position(names: &[String], wanted: Option<&str>) -> Result<usize, NoDevice> {
    if names.is_empty() {
        return Err(NoDevice::NoAdapter);
    }
    let Some(wanted) = wanted else { return Ok(0) };
    let part = wanted.trim().to_lowercase();
    names
        .iter()
        .position(|name| name.to_lowercase().contains(&part))
        .ok_or_else(|| NoDevice::NotNamed { wanted: wanted.to_owned(), found: names.to_vec() })
}

fn report(adapter: &wgpu::Adapter, preferred: bool) -> AdapterReport {
    let features = adapter.features();
    let limits = adapter.limits();
    AdapterReport {
        description: describe(&adapter.get_info()),
        preferred,
        timestamp_query: features.contains(wgpu::Features::TIMESTAMP_QUERY),
        shader_f64: features.contains(wgpu::Features::SHADER_F64),
        subgroup: features.contains(wgpu::Features::SUBGROUP),
        max_buffer_bytes: limits.max_buffer_size,
        max_storage_binding_bytes: limits.max_storage_buffer_binding_size,
        max_workgroups_per_dimension: limits.max_compute_workgroups_per_dimension,
        max_invocations_per_workgroup: limits.max_compute_invocations_per_workgroup,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names() -> Vec<String> {
        vec!["Radeon RX".to_owned(), "llvmpipe (LLVM 15)".to_owned()]
    }

    #[test]
    fn a_name_is_matched_in_any_case() {
        assert_eq!(position(&names(), Some("LLVMpipe")), Ok(1));
        assert_eq!(position(&names(), None), Ok(0));
    }

    #[test]
    fn an_unknown_name_lists_what_there_is() {
        let error = position(&names(), Some("geforce")).map_err(|e| e.to_string());
        let text = error.err().unwrap_or_default();
        assert!(text.contains("geforce") && text.contains("\"Radeon RX\""), "{text}");
    }

    #[test]
    fn without_adapters_the_error_names_the_package() {
        let error = position(&[], Some("x")).map_err(|e| e.to_string());
        assert!(error.err().unwrap_or_default().contains("mesa-vulkan-drivers"));
    }
}
