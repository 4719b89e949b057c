//! The process that counts, and its parent.
//!
//! The parent writes one [`Request`] as JSON; the child answers line by line, as it gets on, so that a
//! crash costs the kernel at which it happens and no other.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde::{Deserialize, Serialize};

use super::foreign::nvrtc::Nvrtc;
use super::foreign::vulkan;
use super::kernel::KernelCode;
use super::statistics::{Compiled, Statistics};
use super::target::{Compiler, GpuTarget};
use crate::numeric::measured::Measured;

/// The hidden verb of the command line that runs [`count_kernels`].
pub const COUNT_VERB: &str = "count-kernels";

#[derive(Serialize, Deserialize)]
struct Request {
    target: GpuTarget,
    kernels: Vec<KernelCode>,
}

/// A line of the child's answer: the driver first, then one per kernel in the order asked.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Answer {
    Driver(String),
    /// Nothing can be counted, and why.
    Unavailable(String),
    Kernel(Measured<Statistics>),
}

/// What a batch of kernels came to.
pub(super) struct Counted {
    pub(super) driver: Measured<String>,
    pub(super) kernels: Vec<Measured<Statistics>>,
}

impl Counted {
    /// That none of `kernels` was counted.
    pub(super) fn nothing(reason: &str, kernels: usize) -> Self {
        let kernels = (0..kernels).map(|_| Measured::NotMeasured(reason.to_owned())).collect();
        Self { driver: Measured::NotMeasured(reason.to_owned()), kernels }
    }
}

/// Counts `kernels` on `target` by the program of striae.
pub(super) fn counted(program: &Path, target: GpuTarget, kernels: &[&KernelCode]) -> Counted {
    let all = kernels.len();
    let places = match target.compiler() {
        Compiler::Radv(_) => radv().map(|manifest| vec![manifest]).ok_or(NO_RADV),
        Compiler::Nvrtc => nvidia().map(|(library, tool)| vec![library, tool]).ok_or(NO_NVRTC),
    };
    let places = match places {
        Ok(places) => places,
        Err(reason) => return Counted::nothing(reason, all),
    };
    let mut counted = Counted { driver: Measured::NotMeasured(String::new()), kernels: Vec::new() };
    while counted.kernels.len() < all {
        let left = kernels[counted.kernels.len()..].iter().map(|code| (*code).clone()).collect();
        let request = Request { target, kernels: left };
        let before = counted.kernels.len();
        match answers(program, &places, &request) {
            Err(reason) => return Counted::nothing(&reason, all),
            Ok((answers, ending)) => {
                for answer in answers {
                    match answer {
                        Answer::Driver(driver) => counted.driver = Measured::Value(driver),
                        Answer::Unavailable(reason) => return Counted::nothing(&reason, all),
                        Answer::Kernel(kernel) => counted.kernels.push(kernel),
                    }
                }
                if counted.driver.value().is_none() {
                    let reason = format!("{} counted nothing: {ending}", program.display());
                    return Counted::nothing(&reason, all);
                }
                counted.kernels.truncate(all);
                // The kernel at which the compiler ended the process costs itself alone.
                if counted.kernels.len() < all {
                    let reason = format!("the compiler failed on it: {ending}");
                    counted.kernels.push(Measured::NotMeasured(reason));
                }
                debug_assert!(counted.kernels.len() > before);
            }
        }
    }
    counted
}

/// What the child answered before it ended, and how it ended.
fn answers(
    program: &Path,
    places: &[PathBuf],
    request: &Request,
) -> Result<(Vec<Answer>, String), String> {
    let failed = |error: io::Error| format!("{}: {error}", program.display());
    let json = serde_json::to_vec(request).map_err(|error| error.to_string())?;
    let mut command = Command::new(program);
    command.arg(COUNT_VERB).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
    match (request.target.compiler(), places) {
        (Compiler::Radv(family), [manifest, ..]) => {
            // No layer and no cache: the same compiler on every machine and every run.
            command.env("NODEVICE_SELECT", "1").env("MESA_SHADER_CACHE_DISABLE", "true");
            command.env("VK_DRIVER_FILES", manifest).env("VK_ICD_FILENAMES", manifest);
            command.env("RADV_FORCE_FAMILY", family);
        }
        (Compiler::Nvrtc, [library, tool, ..]) => {
            command.env(LIBRARY, library).env(TOOL, tool);
        }
        _ => return Err("no compiler was found".to_owned()),
    }
    let mut child = command.spawn().map_err(failed)?;
    let mut stdin = child.stdin.take();
    let stdout = child.stdout.take();
    let answers = std::thread::scope(|scope| {
        // A child that ends early does not read to the end: that is seen in its answers.
        scope.spawn(move || stdin.take().map(|mut stdin| stdin.write_all(&json)));
        let lines = stdout.into_iter().flat_map(|stdout| BufReader::new(stdout).lines());
        let read = |line: io::Result<String>| serde_json::from_str::<Answer>(&line.ok()?).ok();
        lines.map_while(read).collect()
    });
    // What is not an answer is not read on: the child must not wait for that.
    let ending = child.wait().map_err(failed)?;
    Ok((answers, ending.to_string()))
}

/// Why there is no compiler of AMD's.
const NO_RADV: &str =
    "no Vulkan driver `radeon_icd*.json` is installed: mesa-vulkan-drivers has it";

/// The manifest of RADV, in the folders where the loader looks for drivers.
fn radv() -> Option<PathBuf> {
    let mut folders: Vec<PathBuf> = vec!["/etc/vulkan/icd.d".into()];
    let shared = std::env::var_os("XDG_DATA_DIRS").unwrap_or_else(|| SHARED.into());
    folders.extend(std::env::split_paths(&shared).map(|folder| folder.join("vulkan/icd.d")));
    folders.iter().flat_map(|folder| files(folder)).find(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("radeon_icd") && name.ends_with(".json") && !name.contains("i686")
    })
}

/// Folders of shared data where the environment names none.
const SHARED: &str = "/usr/local/share:/usr/share";

/// Environment: the library of NVRTC, and the program nvdisasm.
const LIBRARY: &str = "STRIAE_NVRTC";
const TOOL: &str = "STRIAE_NVDISASM";

/// Why there is no compiler of NVIDIA's.
const NO_NVRTC: &str = "NVRTC or nvdisasm is not installed: \
    pip install nvidia-cuda-nvrtc-cu12 nvidia-cuda-nvdisasm, or set STRIAE_NVRTC and STRIAE_NVDISASM";

/// The library of NVRTC and the program nvdisasm: as the environment names them, else among the packages of
/// `python3`.
fn nvidia() -> Option<(PathBuf, PathBuf)> {
    let named = |variable: &str| std::env::var_os(variable).map(PathBuf::from);
    let (library, tool) = (named(LIBRARY), named(TOOL));
    if let (Some(library), Some(tool)) = (&library, &tool) {
        return Some((library.clone(), tool.clone()));
    }
    let list = ["-c", "import sys; print('\\n'.join(sys.path))"];
    let paths = Command::new("python3").args(list).stderr(Stdio::null()).output().ok()?.stdout;
    let paths = String::from_utf8_lossy(&paths).into_owned();
    let packaged = |folder: &str, wanted: fn(&str) -> bool| {
        let packages = paths.lines().map(|path| Path::new(path).join("nvidia"));
        let inside = packages.flat_map(|nvidia| files(&nvidia)).map(|package| package.join(folder));
        inside
            .flat_map(|folder| files(&folder))
            .find(|path| wanted(&path.file_name().unwrap_or_default().to_string_lossy()))
    };
    let is_library = |name: &str| {
        name.starts_with("libnvrtc.so")
            || (name.starts_with("nvrtc64_") && name.ends_with("_0.dll"))
    };
    let library = library.or_else(|| packaged("lib", is_library));
    let is_tool = |name: &str| name == "nvdisasm" || name == "nvdisasm.exe";
    Some((library?, tool.or_else(|| packaged("bin", is_tool))?))
}

/// What is in a folder, by name; nothing if it is none.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut found: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    found.sort();
    found
}

/// That a kernel is written for the compiler of another target.
const STRANGE: &str = "the kernel is not written for this compiler";

/// `nvdisasm 13.5`, as the program says it.
fn version(tool: &Path) -> String {
    let output = Command::new(tool).arg("--version").output();
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    let text = text.unwrap_or_default();
    let release = text.split("release ").nth(1).and_then(|rest| rest.split(',').next());
    format!("nvdisasm {}", release.unwrap_or("of unknown version"))
}

/// The text of machine code, by the program `tool`.
fn disassembled(tool: &Path, code: &[u8]) -> Result<String, String> {
    let failed = |error: io::Error| format!("{}: {error}", tool.display());
    let mut file = tempfile::NamedTempFile::new().map_err(failed)?;
    file.write_all(code).map_err(failed)?;
    let output = Command::new(tool).arg("-c").arg(file.path()).output().map_err(failed)?;
    if !output.status.success() {
        return Err(format!("nvdisasm: {}", String::from_utf8_lossy(&output.stderr).trim()));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// The child: reads a request, answers on `out`.
///
/// # Errors
/// If the request is none, or an answer cannot be written; what cannot be counted is an answer.
pub fn count_kernels(mut request: impl Read, mut out: impl Write) -> io::Result<()> {
    let mut json = Vec::new();
    request.read_to_end(&mut json)?;
    let request: Request = serde_json::from_slice(&json)?;
    let mut answer = |answer: &Answer| -> io::Result<()> {
        writeln!(out, "{}", serde_json::to_string(answer)?)?;
        out.flush()
    };
    let result = |counts: Result<Statistics, String>| match counts {
        Ok(statistics) => Answer::Kernel(Measured::Value(statistics)),
        Err(reason) => Answer::Kernel(Measured::NotMeasured(reason)),
    };
    match request.target.compiler() {
        Compiler::Nvrtc => {
            let place =
                |variable| std::env::var_os(variable).map(PathBuf::from).unwrap_or_default();
            let (library, tool) = (place(LIBRARY), place(TOOL));
            let nvrtc = match Nvrtc::open(&library) {
                Ok(nvrtc) => nvrtc,
                Err(reason) => return answer(&Answer::Unavailable(reason)),
            };
            answer(&Answer::Driver(format!("{}, {}", nvrtc.version(), version(&tool))))?;
            for kernel in &request.kernels {
                let counts = match kernel {
                    KernelCode::Cuda(text) => nvrtc
                        .compile(text, request.target.name())
                        .and_then(|code| disassembled(&tool, &code))
                        .and_then(|assembly| Compiled::new(assembly).of_nvdisasm()),
                    KernelCode::Spirv { .. } => Err(STRANGE.to_owned()),
                };
                answer(&result(counts))?;
            }
        }
        Compiler::Radv(_) => {
            let compiler = match vulkan::Compiler::open() {
                Ok(compiler) => compiler,
                Err(reason) => return answer(&Answer::Unavailable(reason)),
            };
            answer(&Answer::Driver(compiler.driver().to_owned()))?;
            for kernel in &request.kernels {
                let counts = match kernel {
                    KernelCode::Spirv { words, tables } => {
                        compiler.compile(words, *tables).and_then(|compiled| compiled.of_radv())
                    }
                    KernelCode::Cuda(_) => Err(STRANGE.to_owned()),
                };
                answer(&result(counts))?;
            }
        }
    }
    Ok(())
}
