//! Compilers of GPUs, called through their C interfaces: the one module of striae with `unsafe`.
//!
//! It runs in the child process of [`super::child`] alone: a driver that crashes takes no measurement with
//! it but its own. What each call relies on is said beside it; nothing unsafe leaves the module.

pub(super) mod nvrtc;
pub(super) mod vulkan;
