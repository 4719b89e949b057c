//! Compiled kernels, each made once as long as its device is open.

use super::error::GpuError;
use super::program::PipelineKey;
use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// One kernel, once it is made.
type Slot = Arc<Mutex<Option<wgpu::ComputePipeline>>>;

/// The kernels that a device has compiled.
#[derive(Debug, Default)]
pub(super) struct Pipelines {
    slots: Mutex<HashMap<PipelineKey, Slot>>,
    made: AtomicUsize,
    reused: AtomicUsize,
}

/// How many kernels a device has compiled, and how often one of them was asked for again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PipelineCount {
    /// Kernels compiled.
    pub made: usize,
    /// Requests that found their kernel compiled.
    pub reused: usize,
}

impl Pipelines {
    /// The kernel of `key`, which `make` compiles if it is not there yet. Who asks for the same
    /// kernel meanwhile waits for it; a failure is not kept.
    pub(super) fn get(
        &self,
        key: PipelineKey,
        make: impl FnOnce() -> Result<wgpu::ComputePipeline, GpuError>,
    ) -> Result<wgpu::ComputePipeline, GpuError> {
        let slot = self
            .slots
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .entry(key)
            .or_default()
            .clone();
        let mut slot = slot.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(made) = &*slot {
            self.reused.fetch_add(1, Ordering::Relaxed);
            return Ok(made.clone());
        }
        let made = make()?;
        self.made.fetch_add(1, Ordering::Relaxed);
        Ok(slot.insert(made).clone())
    }

    /// Whether the kernel of `key` is there.
    pub(super) fn has(&self, key: &PipelineKey) -> bool {
        let slots = self.slots.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(slot) = slots.get(key) else { return false };
        slot.try_lock().is_ok_and(|slot| slot.is_some())
    }

    pub(super) fn count(&self) -> PipelineCount {
        PipelineCount {
            made: self.made.load(Ordering::Relaxed),
            reused: self.reused.load(Ordering::Relaxed),
        }
    }
}
