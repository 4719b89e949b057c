//! What can go wrong between a form and the device.

use crate::form::FormError;

/// Why no device could be opened.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoDevice {
    /// The machine has no adapter with a usable driver.
    #[error(
        "no Vulkan, Metal or Direct3D 12 adapter found; install a Vulkan driver for the GPU, or \
         for a software device without a GPU the package mesa-vulkan-drivers (Debian, Ubuntu, \
         Fedora) or vulkan-swrast (Arch)"
    )]
    NoAdapter,
    /// `WGPU_ADAPTER_NAME` is set and matches no adapter.
    #[error("WGPU_ADAPTER_NAME is \"{wanted}\", which is part of no adapter's name; found: {}", list(.found))]
    NotNamed {
        /// Value of the variable.
        wanted: String,
        /// Names of the adapters that exist.
        found: Vec<String>,
    },
    /// The adapter exists but refused to open.
    #[error("adapter \"{adapter}\" could not be opened: {reason}")]
    Refused {
        /// Name of the adapter.
        adapter: String,
        /// The driver's reason.
        reason: String,
    },
}

/// Why a form could not be compiled, run or timed on the device.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GpuError {
    /// The device's compiler rejects the form.
    #[error("{origin}: function {function} does not compile for the device: {report}")]
    Compile {
        /// File of the form.
        origin: String,
        /// Function.
        function: String,
        /// The compiler's report; its line numbers are those of the file.
        report: String,
    },
    /// The form does not load, or an argument does not take a number of its column.
    #[error(transparent)]
    Form(#[from] FormError),
    /// Wrong number of parameter values.
    #[error("{origin}: function {function} has {expected} parameters, got {got} values")]
    ParameterCount {
        /// File of the form.
        origin: String,
        /// Function.
        function: String,
        /// Number of parameters of the form.
        expected: usize,
        /// Number of values given.
        got: usize,
    },
    /// Wrong number of input columns.
    #[error("{origin}: function {function} reads {expected} input columns, got {got}")]
    ColumnCount {
        /// File of the form.
        origin: String,
        /// Function.
        function: String,
        /// Number of scalar inputs of the form.
        expected: usize,
        /// Number of columns given.
        got: usize,
    },
    /// Input columns of different lengths.
    #[error(
        "{origin}: function {function}: input column {column} has {got} rows, column 0 has {expected}"
    )]
    RowCount {
        /// File of the form.
        origin: String,
        /// Function.
        function: String,
        /// Index of the offending column, from 0.
        column: usize,
        /// Rows of column 0.
        expected: usize,
        /// Rows of the offending column.
        got: usize,
    },
    /// The device ran out of memory.
    #[error("the device is out of memory: {0}")]
    OutOfMemory(String),
    /// The device was lost: driver reset, removed, or a kernel that ran too long.
    #[error("the device was lost: {0}")]
    Lost(String),
    /// The device did not finish in time.
    #[error("the device did not finish within {0} s")]
    TimedOut(u64),
    /// wgpu or the driver reports an error that is none of the above.
    #[error("the device reports an error: {0}")]
    Device(String),
}

fn list(names: &[String]) -> String {
    names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ")
}
