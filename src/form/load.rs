//! From text to a validated module, for any text: naga's parser and validator recurse, so what
//! could exhaust the stack is refused by its size before they see it.

use naga::Module;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use super::FormError;

/// Texts longer than this many bytes are refused.
pub const MAX_SOURCE_BYTES: usize = 1 << 20;

/// Brackets nested deeper than this are refused.
pub const MAX_BRACKET_NESTING: usize = 100;

/// More operators than this between two separators are refused: each is a level of recursion.
pub const MAX_OPERATORS: usize = 1000;

/// More `else` than this in one function are refused: a chain of them is nested blocks.
pub const MAX_ELSE: usize = 300;

/// Stack of the thread that parses: what the limits above can ask for, several times over.
const PARSER_STACK_BYTES: usize = 64 << 20;

/// Runs `work` on a thread with a stack that suits naga's recursion. A panic inside becomes an
/// error: naga is not written for hostile text, and a form may come from anywhere.
pub(crate) fn guarded<T: Send>(
    origin: &str,
    work: impl FnOnce() -> Result<T, FormError> + Send,
) -> Result<T, FormError> {
    let failed = || FormError::Invalid {
        report: format!("error: {origin}: the WGSL front end failed on this text"),
    };
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new()
            .stack_size(PARSER_STACK_BYTES)
            .spawn_scoped(scope, work)
            .map_err(|error| FormError::Invalid {
                report: format!("error: {origin}: no thread to parse on: {error}"),
            })?;
        thread.join().unwrap_or_else(|_| Err(failed()))
    })
}

/// Parses and validates.
pub(crate) fn module(origin: &str, source: &str) -> Result<(Module, ModuleInfo), FormError> {
    check_size(origin, source)?;
    let invalid = |location, report: String| FormError::Invalid {
        report: located(origin, source, location, report.trim_end()),
    };
    let module = naga::front::wgsl::parse_str(source).map_err(|error| {
        invalid(error.location(source), error.emit_to_string_with_path(source, origin))
    })?;
    let info =
        Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module).map_err(
            |error| invalid(error.location(source), error.emit_to_string_with_path(source, origin)),
        )?;
    Ok((module, info))
}

/// A rendered diagnostic; where naga gives no place, the file is named in its place.
fn located(
    origin: &str,
    source: &str,
    location: Option<naga::SourceLocation>,
    report: &str,
) -> String {
    if location.is_some() && report.contains(origin) {
        return report.to_owned();
    }
    let lines = source.lines().count().max(1);
    format!("{report}\n  in {origin}, lines 1 to {lines}")
}

/// Refuses what could exhaust the stack or the time of the parser.
fn check_size(origin: &str, source: &str) -> Result<(), FormError> {
    let too_large = |at: usize, what: String| FormError::TooLarge {
        origin: origin.to_owned(),
        line: source.as_bytes()[..at].iter().filter(|&&byte| byte == b'\n').count() + 1,
        what,
    };
    if source.len() > MAX_SOURCE_BYTES {
        let what = format!("the text has {} bytes (at most {MAX_SOURCE_BYTES})", source.len());
        return Err(too_large(0, what));
    }
    let mut nesting = 0_usize;
    let mut operators = 0_usize;
    let mut branches = 0_usize;
    for (at, byte) in code(source) {
        match byte {
            b'(' | b'[' | b'{' => {
                nesting += 1;
            }
            b')' | b']' | b'}' => {
                nesting = nesting.saturating_sub(1);
                branches = if nesting == 0 { 0 } else { branches };
            }
            b'e' if source.as_bytes()[at..].starts_with(b"else") => {
                branches += 1;
            }
            b'+' | b'-' | b'*' | b'/' | b'%' | b'&' | b'|' | b'^' | b'<' | b'>' | b'=' | b'!'
            | b'~' | b'.' => {
                operators += 1;
            }
            _ => {}
        }
        let excess = if nesting > MAX_BRACKET_NESTING {
            Some(format!("brackets are nested more than {MAX_BRACKET_NESTING} deep"))
        } else if branches > MAX_ELSE {
            Some(format!("more than {MAX_ELSE} `else` in one function"))
        } else if operators > MAX_OPERATORS {
            Some(format!("more than {MAX_OPERATORS} operators in one expression"))
        } else {
            None
        };
        if let Some(what) = excess {
            return Err(too_large(at, what));
        }
        if matches!(byte, b';' | b',' | b'{' | b'}') {
            operators = 0;
        }
    }
    Ok(())
}

/// Where the declaration begins whose keyword is at `keyword`: before its attributes.
pub(super) fn start_of_declaration(source: &str, keyword: usize) -> usize {
    let before = code(source).take_while(|&(at, _)| at < keyword);
    let start = before.fold(None, |start, (at, byte)| match byte {
        b';' | b'}' => None,
        _ if byte.is_ascii_whitespace() => start,
        _ => start.or(Some(at)),
    });
    start.unwrap_or(keyword)
}

/// The bytes outside comments, with their places.
fn code(source: &str) -> impl Iterator<Item = (usize, u8)> {
    let bytes = source.as_bytes();
    let mut at = 0;
    let mut block_depth = 0_usize;
    let mut in_line = false;
    std::iter::from_fn(move || {
        while let Some(&byte) = bytes.get(at) {
            let here = at;
            let pair = (byte, bytes.get(at + 1).copied().unwrap_or(b' '));
            at += 1;
            if in_line {
                in_line = byte != b'\n';
            } else if pair == (b'/', b'*') {
                block_depth += 1;
                at += 1;
            } else if block_depth > 0 {
                if pair == (b'*', b'/') {
                    block_depth -= 1;
                    at += 1;
                }
            } else if pair == (b'/', b'/') {
                in_line = true;
            } else {
                return Some((here, byte));
            }
        }
        None
    })
}
