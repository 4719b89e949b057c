//! The tables of a form in buffers of the device.

use super::device::{Device, group, group_layout, pipeline_layout};
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
            let read_only = wgpu::BufferBindingType::Storage { read_only: true };
            let bindings = group_layout(&device.raw, "tables", &vec![read_only; tables.len()]);
            let buffer = |table: &DataTable| {
                device.raw.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label: Some(table.name()),
                    contents: bytemuck::cast_slice(&table.buffer_words()),
                    usage: wgpu::BufferUsages::STORAGE,
                })
            };
            let buffers: Vec<wgpu::Buffer> = tables.iter().map(buffer).collect();
            let group = group(&device.raw, "tables", &bindings, &buffers);
            let groups = [Some(&device.bindings), Some(&bindings)];
            let layout = pipeline_layout(&device.raw, "striae with tables", &groups);
            Self { layout, group }
        })
    }

    /// Makes the tables visible to the dispatches of `pass`.
    pub(super) fn set(&self, pass: &mut wgpu::ComputePass<'_>) {
        pass.set_bind_group(TABLE_GROUP, &self.group, &[]);
    }
}
