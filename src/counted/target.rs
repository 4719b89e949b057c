//! GPUs whose machine code is counted.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A GPU for which code is compiled and counted, and which need not be there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GpuTarget {
    /// AMD RDNA2 (Navi 21: desktops of 2020, PlayStation 5 and Xbox Series are near).
    Rdna2,
    /// AMD RDNA3 (Navi 31).
    Rdna3,
    /// AMD GCN4 (Polaris 10; PlayStation 4 and Xbox One are near).
    Gcn4,
    /// NVIDIA Turing.
    #[serde(rename = "sm_75")]
    Sm75,
    /// NVIDIA Hopper.
    #[serde(rename = "sm_90")]
    Sm90,
}

impl GpuTarget {
    /// All of them, the one that is quoted first before the others.
    pub const ALL: [Self; 5] = [Self::Rdna2, Self::Rdna3, Self::Gcn4, Self::Sm75, Self::Sm90];

    /// Name on the command line, in gates and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rdna2 => "rdna2",
            Self::Rdna3 => "rdna3",
            Self::Gcn4 => "gcn4",
            Self::Sm75 => "sm_75",
            Self::Sm90 => "sm_90",
        }
    }

    /// The target called `name`.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|target| target.name() == name)
    }

    /// What its compiler is.
    pub(super) fn compiler(self) -> Compiler {
        match self {
            Self::Rdna2 => Compiler::Radv("navi21"),
            Self::Rdna3 => Compiler::Radv("gfx1100"),
            Self::Gcn4 => Compiler::Radv("polaris10"),
            Self::Sm75 | Self::Sm90 => Compiler::Nvrtc,
        }
    }
}

/// The compiler of a target.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Compiler {
    /// Mesa's RADV on a null device of this family.
    Radv(&'static str),
    /// NVIDIA's NVRTC, for the architecture of the target's name.
    Nvrtc,
}

impl fmt::Display for GpuTarget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
