//! The tables of a form in buffers of the device.

use super::device::Device;
use super::error::GpuError;
use crate::form::{DataTable, TABLE_GROUP};
use wgpu::util::DeviceExt;

/// Tables on the device.
#[derive(Debug)]
pub(super) struct BoundTables {
    pub(super) layout: wgpu::PipelineLayout,
    group: wgpu::BindGroup,
}

impl BoundTables {
    /// Uploads `tables`, one buffer each.
    pub(super) fn new(device: &Device, tables: &[DataTable]) -> Result<Self, GpuError> {
        device.guarded(|| {
            let entries: Vec<wgpu::BindGroupLayoutEntry> = (0..)
                .zip(tables)
                .map(|(binding, _)| wgpu::BindGroupLayoutEntry {
                    binding,
                    visibility: wgpu::ShaderStages::COMPUTE,
                    ty: wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Storage { read_only: true },
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    },
                    count: None,
                })
                .collect();
            let bindings = device.raw.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("tables"),
                entries: &entries,
            });
            let buffers: Vec<wgpu::Buffer> = tables
                .iter()
                .map(|table| {
                    device.raw.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                        label: Some(table.name()),
                        contents: bytemuck::cast_slice(&table.buffer_words()),
                        usage: wgpu::BufferUsages::STORAGE,
                    })
                })
                .collect();
            let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
                .zip(&buffers)
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            let group = device.raw.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("tables"),
                layout: &bindings,
                entries: &entries,
            });
            let layout = device.raw.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("striae with tables"),
                bind_group_layouts: &[Some(&device.bindings), Some(&bindings)],
                immediate_size: 0,
            });
            Self { layout, group }
        })
    }

    /// Makes the tables visible to the dispatches of `pass`.
    pub(super) fn set(&self, pass: &mut wgpu::ComputePass<'_>) {
        pass.set_bind_group(TABLE_GROUP, &self.group, &[]);
    }
}
