//! NVRTC, NVIDIA's compiler as a library: CUDA's C++ to machine code, without a GPU.

use std::ffi::{CString, c_char, c_int, c_void};
use std::path::Path;

use libloading::Library;

/// The library, with the functions of its C interface that are used.
pub(in crate::counted) struct Nvrtc {
    version: String,
    create: CreateProgram,
    compile: CompileProgram,
    log_size: SizeOf,
    log: Copy,
    code_size: SizeOf,
    code: Copy,
    destroy: DestroyProgram,
    _library: Library,
}

type Program = *mut c_void;
type Version = unsafe extern "C" fn(*mut c_int, *mut c_int) -> c_int;
type CreateProgram = unsafe extern "C" fn(
    *mut Program,
    *const c_char,
    *const c_char,
    c_int,
    *const *const c_char,
    *const *const c_char,
) -> c_int;
type CompileProgram = unsafe extern "C" fn(Program, c_int, *const *const c_char) -> c_int;
type SizeOf = unsafe extern "C" fn(Program, *mut usize) -> c_int;
type Copy = unsafe extern "C" fn(Program, *mut c_char) -> c_int;
type DestroyProgram = unsafe extern "C" fn(*mut Program) -> c_int;

impl Nvrtc {
    /// Loads the library at `path`.
    pub(in crate::counted) fn open(path: &Path) -> Result<Self, String> {
        let failed = |error: libloading::Error| format!("{}: {error}", path.display());
        // SAFETY: the caller names NVIDIA's library, whose initialisers are what its user trusts.
        let library = unsafe { Library::new(path) }.map_err(failed)?;
        let (mut major, mut minor) = (0, 0);
        // SAFETY: the types are those of nvrtc.h, the same since CUDA 11.1; the library is kept as long as
        // what is taken from it.
        let opened = unsafe {
            let version = *library.get::<Version>(b"nvrtcVersion\0").map_err(failed)?;
            version(&mut major, &mut minor);
            Self {
                version: format!("NVRTC {major}.{minor}"),
                create: *library.get(b"nvrtcCreateProgram\0").map_err(failed)?,
                compile: *library.get(b"nvrtcCompileProgram\0").map_err(failed)?,
                log_size: *library.get(b"nvrtcGetProgramLogSize\0").map_err(failed)?,
                log: *library.get(b"nvrtcGetProgramLog\0").map_err(failed)?,
                code_size: *library.get(b"nvrtcGetCUBINSize\0").map_err(failed)?,
                code: *library.get(b"nvrtcGetCUBIN\0").map_err(failed)?,
                destroy: *library.get(b"nvrtcDestroyProgram\0").map_err(failed)?,
                _library: library,
            }
        };
        Ok(opened)
    }

    /// `NVRTC 12.9`.
    pub(in crate::counted) fn version(&self) -> &str {
        &self.version
    }

    /// The machine code of `text` for `architecture`, or the first error of the compiler.
    pub(in crate::counted) fn compile(
        &self,
        text: &str,
        architecture: &str,
    ) -> Result<Vec<u8>, String> {
        let text = CString::new(text).map_err(|error| error.to_string())?;
        let architecture = format!("--gpu-architecture={architecture}");
        let options = [architecture.as_str(), "--use_fast_math", "--std=c++14", "-default-device"];
        let options: Vec<CString> =
            options.iter().filter_map(|option| CString::new(*option).ok()).collect();
        let pointers: Vec<*const c_char> = options.iter().map(|option| option.as_ptr()).collect();
        let mut program: Program = std::ptr::null_mut();
        let none = std::ptr::null();
        // SAFETY: every string ends in a zero and lives through the calls; no headers are given; buffers have
        // the size that the library asked for; the program is destroyed once, at the end.
        unsafe {
            if (self.create)(&mut program, text.as_ptr(), c"form.cu".as_ptr(), 0, none, none) != 0 {
                return Err("NVRTC made no program".to_owned());
            }
            let count = pointers.len() as c_int;
            let compiled = (self.compile)(program, count, pointers.as_ptr()) == 0;
            let (size, copy) = match compiled {
                true => (self.code_size, self.code),
                false => (self.log_size, self.log),
            };
            let mut length = 0;
            let mut bytes = Vec::new();
            if size(program, &mut length) == 0 {
                bytes.resize(length, 0_u8);
                copy(program, bytes.as_mut_ptr().cast());
            }
            (self.destroy)(&mut program);
            match compiled {
                true => Ok(bytes),
                false => {
                    let log = String::from_utf8_lossy(&bytes);
                    let first = log.lines().find(|line| line.contains("error"));
                    Err(first.unwrap_or("NVRTC failed without a word").to_owned())
                }
            }
        }
    }
}
