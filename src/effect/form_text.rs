//! The text of a form, and the header in which it says what it is.
//!
//! A form registers by its text. The comments that it begins with say what it is:
//!
//! ```wgsl
//! // form: eq16
//! // approximates: footprint_response
//! // about: eq. 16 with the factor pi that its second term lacks: chord and centre value blended
//! //     by A_P/A_C
//! // cites: velinov2018 eq. 16, corrected
//! // uses: chord
//!
//! // Comments of any other kind follow after an empty line.
//! fn footprint_response(h: f32, s: f32, area_ratio: f32) -> f32 { … }
//! ```
//!
//! | key | | meaning |
//! |---|---|---|
//! | `about` | of every form | one line: what it is |
//! | `cites` | of every form | paper and equation, or whose it is |
//! | `approximates` | may be left out | the reference that it approximates; without one only tables can judge it |
//! | `over` | may be left out | the family of measured tables over which it is judged, in place of the reference |
//! | `function` | may be left out | the WGSL function; else the one with the name of the reference, or of the form |
//! | `form` | may be left out | name of the form; else the stem of the file |
//! | `uses` | may be left out | texts that it calls, separated by commas |
//! | `constants` | may be left out | forms or fits whose constants it ships with, separated by commas |
//!
//! A line that is indented by three spaces or more continues the one before it. A text that says
//! nothing, or only what it `uses`, is a piece that others share. A text is called by the stem of
//! its file from within its folder, and `effect/stem` from outside. It is put together with what it
//! uses when it is registered: the form first, without its header but with its empty lines, so that
//! lines keep their numbers in diagnostics, then each piece once, in order of first use.
//!
//! Forms that are put together from pieces alone are listed in `combinations.toml` beside the
//! texts, with the same keys:
//!
//! ```toml
//! [[form]]
//! name = "sphere_line_lean"
//! uses = ["sphere_light", "line", "band_lean"]
//! approximates = "sphere_light"
//! about = "the slice through the origin line; bands without cancellation, lean"
//! cites = "velinov2018 eq. 27"
//! constants = ["area_light/band_lean"]
//! ```

use std::borrow::Cow;
use std::fmt;
use std::path::Path;

use serde::Deserialize;

/// Name of the file that lists forms made from pieces alone.
const COMBINATIONS: &str = "combinations.toml";

/// Keys of a header.
const KEYS: [&str; 8] =
    ["form", "approximates", "over", "about", "cites", "uses", "constants", "function"];

/// A WGSL text that registers a form or is shared by forms, or a list of combinations of such texts.
#[derive(Debug, Clone)]
pub struct FormText {
    /// What others call it in `uses`: the stem of its file.
    pub name: String,
    /// Path of its file, for diagnostics.
    pub path: String,
    /// The text, its header included.
    pub text: Cow<'static, str>,
}

/// What is wrong with the text of a form, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {fault}")]
pub struct FormTextError {
    /// Where.
    pub place: TextPlace,
    /// What is wrong there.
    pub fault: FormTextFault,
}

/// A line of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextPlace {
    /// Path of the file.
    pub path: String,
    /// Line, from 1; 0 for the file as a whole.
    pub line: usize,
}

/// What is wrong with the text of a form.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FormTextFault {
    /// No key is called so.
    #[error("a header has no key `{0}`, but {keys}; other comments follow after an empty line", keys = KEYS.join(", "))]
    UnknownKey(String),
    /// A key of every form is not there.
    #[error("a form says what it is: `{0}` is missing in its header")]
    MissingKey(&'static str),
    /// A key is there twice.
    #[error("`{0}` is there a second time")]
    RepeatedKey(String),
    /// A key says nothing, or a list has an empty entry.
    #[error("`{0}` has an empty value")]
    EmptyValue(String),
    /// A comment in the header is neither a key with its value nor the rest of one.
    #[error(
        "this is neither `key: value` nor, indented by three spaces, the rest of a value; \
             an empty line ends a header"
    )]
    NoStatement,
    /// A list of combinations does not read.
    #[error("{0}")]
    Combinations(String),
    /// No text has this name.
    #[error("there is no text `{0}`")]
    UnknownText(String),
    /// Texts use each other in a circle.
    #[error("{}: texts in a circle", .0.join(" uses "))]
    Cycle(Vec<String>),
    /// A name is taken.
    #[error("`{name}` is registered already, by {by}")]
    Taken {
        /// The name.
        name: String,
        /// What has it.
        by: String,
    },
    /// No reference has this name.
    #[error("there is no reference `{0}`")]
    UnknownReference(String),
    /// No family has this name.
    #[error("there is no family `{0}`")]
    UnknownFamily(String),
    /// The file or folder cannot be read.
    #[error("{0}")]
    Unreadable(String),
}

/// A text that forms are put together from.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// Path of its file.
    pub(super) path: String,
    /// The text without its header.
    pub(super) body: String,
    /// Lines of its header.
    pub(super) header_lines: usize,
    /// Texts that it calls, each with the line that says so.
    pub(super) uses: Vec<(usize, String)>,
}

/// What is said of a form, in its header or in a list of combinations.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Definition {
    pub(super) name: String,
    /// The texts that it is made of.
    pub(super) uses: Vec<String>,
    pub(super) approximates: Option<String>,
    #[serde(default)]
    pub(super) over: Option<String>,
    pub(super) about: String,
    pub(super) cites: String,
    pub(super) function: Option<String>,
    #[serde(default)]
    pub(super) constants: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Combinations {
    form: Vec<toml::Spanned<Definition>>,
}

impl fmt::Display for TextPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(f, "{}", self.path),
            line => write!(f, "{}:{line}", self.path),
        }
    }
}

impl FormText {
    /// The text of the file at `path`, which is called by its stem.
    pub fn new(path: &str, text: impl Into<Cow<'static, str>>) -> Self {
        let stem = Path::new(path).file_stem().unwrap_or_default().to_string_lossy();
        Self { name: stem.into_owned(), path: path.to_owned(), text: text.into() }
    }

    /// The texts of a folder that is part of the program; `path` names it in diagnostics.
    pub fn embedded(path: &str, folder: &include_dir::Dir<'static>) -> Vec<Self> {
        let mut texts: Vec<Self> = folder
            .files()
            .filter(|file| is_text(file.path()))
            .map(|file| {
                let path = format!("{path}/{}", file.path().display());
                Self::new(&path, String::from_utf8_lossy(file.contents()))
            })
            .collect();
        texts.sort_by(|a, b| a.path.cmp(&b.path));
        combinations_last(texts)
    }

    /// The texts of a folder on disk, those in folders inside it left out.
    ///
    /// # Errors
    /// [`FormTextFault::Unreadable`].
    pub fn read_folder(folder: &Path) -> Result<Vec<Self>, FormTextError> {
        let mut texts = Vec::new();
        for path in entries(folder)?.into_iter().filter(|path| is_text(path) && path.is_file()) {
            let text = std::fs::read_to_string(&path).map_err(|error| unreadable(&path, &error))?;
            texts.push(Self::new(&path.display().to_string(), text));
        }
        Ok(combinations_last(texts))
    }

    /// Whether it lists combinations.
    pub(super) fn is_combinations(&self) -> bool {
        Path::new(&self.path).ends_with(COMBINATIONS)
    }

    /// The piece that it is, and what it says of the form that it registers.
    pub(super) fn read(&self) -> Result<(Piece, Option<Definition>), FormTextError> {
        let mut header = Header::of(self)?;
        let piece = Piece {
            path: self.path.clone(),
            body: self.text.lines().skip(header.lines).collect::<Vec<_>>().join("\n"),
            header_lines: header.lines,
            uses: header.list("uses")?,
        };
        if header.values.is_empty() {
            return Ok((piece, None));
        }
        let definition = Definition {
            name: header.take("form").unwrap_or_else(|| self.name.clone()),
            uses: vec![self.name.clone()],
            about: header.require("about")?,
            cites: header.require("cites")?,
            approximates: header.take("approximates"),
            over: header.take("over"),
            function: header.take("function"),
            constants: header.list("constants")?.into_iter().map(|(_, name)| name).collect(),
        };
        Ok((piece, Some(definition)))
    }

    /// The forms of a list of combinations, each with its line.
    pub(super) fn combinations(&self) -> Result<Vec<(usize, Definition)>, FormTextError> {
        let line = |at: usize| self.text[..at].matches('\n').count() + 1;
        let listed: Combinations = toml::from_str(&self.text).map_err(|error| {
            let line = error.span().map_or(0, |span| line(span.start));
            self.error(line, FormTextFault::Combinations(error.message().to_owned()))
        })?;
        let defined = |form: toml::Spanned<Definition>| match line(form.span().start) {
            line if form.get_ref().uses.is_empty() => {
                Err(self.error(line, FormTextFault::EmptyValue("uses".into())))
            }
            line => Ok((line, form.into_inner())),
        };
        listed.form.into_iter().map(defined).collect()
    }

    fn error(&self, line: usize, fault: FormTextFault) -> FormTextError {
        FormTextError { place: TextPlace { path: self.path.clone(), line }, fault }
    }
}

/// The paths in a folder, in order.
pub(super) fn entries(folder: &Path) -> Result<Vec<std::path::PathBuf>, FormTextError> {
    let listed = || -> std::io::Result<Vec<_>> {
        std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect()
    };
    let mut paths = listed().map_err(|error| unreadable(folder, &error))?;
    paths.sort();
    Ok(paths)
}

fn unreadable(path: &Path, error: &std::io::Error) -> FormTextError {
    let place = TextPlace { path: path.display().to_string(), line: 0 };
    FormTextError { place, fault: FormTextFault::Unreadable(error.to_string()) }
}

/// What is put together from texts comes after them.
fn combinations_last(mut texts: Vec<FormText>) -> Vec<FormText> {
    texts.sort_by_key(FormText::is_combinations);
    texts
}

fn is_text(path: &Path) -> bool {
    path.ends_with(COMBINATIONS) || path.extension().is_some_and(|extension| extension == "wgsl")
}

/// What a text says of itself, by key.
struct Header<'a> {
    text: &'a FormText,
    values: Vec<(&'a str, (usize, String))>,
    lines: usize,
}

impl<'a> Header<'a> {
    fn of(text: &'a FormText) -> Result<Self, FormTextError> {
        let mut header = Self { text, values: Vec::new(), lines: 0 };
        for (line, comment) in (1..).zip(text.text.lines().map_while(|l| l.strip_prefix("// "))) {
            let key = comment.split_once(':').filter(|(key, _)| is_word(key));
            match (key, header.values.last_mut()) {
                (Some((key, value)), _) => header.add(line, key, value.trim())?,
                (None, Some((_, (_, value)))) if comment.starts_with("  ") => {
                    if !value.is_empty() {
                        value.push(' ');
                    }
                    value.push_str(comment.trim());
                }
                (None, None) => break,
                (None, Some(_)) => return Err(text.error(line, FormTextFault::NoStatement)),
            }
            header.lines = line;
        }
        match header.values.iter().find(|(_, (_, value))| value.is_empty()) {
            Some((key, (line, _))) => {
                Err(text.error(*line, FormTextFault::EmptyValue((*key).to_owned())))
            }
            None => Ok(header),
        }
    }

    fn add(&mut self, line: usize, key: &'a str, value: &str) -> Result<(), FormTextError> {
        if !KEYS.contains(&key) {
            return Err(self.text.error(line, FormTextFault::UnknownKey(key.to_owned())));
        }
        if self.values.iter().any(|(known, _)| *known == key) {
            return Err(self.text.error(line, FormTextFault::RepeatedKey(key.to_owned())));
        }
        self.values.push((key, (line, value.to_owned())));
        Ok(())
    }

    fn take_at(&mut self, key: &str) -> Option<(usize, String)> {
        let at = self.values.iter().position(|(known, _)| *known == key)?;
        Some(self.values.remove(at).1)
    }

    fn take(&mut self, key: &str) -> Option<String> {
        self.take_at(key).map(|(_, value)| value)
    }

    fn require(&mut self, key: &'static str) -> Result<String, FormTextError> {
        let text = self.text;
        let missing = || text.error(1, FormTextFault::MissingKey(key));
        self.take(key).ok_or_else(missing)
    }

    fn list(&mut self, key: &str) -> Result<Vec<(usize, String)>, FormTextError> {
        let Some((line, value)) = self.take_at(key) else { return Ok(Vec::new()) };
        let part = |part: &str| match part.trim() {
            "" => Err(self.text.error(line, FormTextFault::EmptyValue(key.to_owned()))),
            name => Ok((line, name.to_owned())),
        };
        value.split(',').map(part).collect()
    }
}

fn is_word(key: &str) -> bool {
    !key.is_empty() && key.chars().all(|c| c.is_ascii_lowercase() || c == '_')
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATH: &str = "forms/soft.wgsl";

    fn read(text: &'static str) -> Result<(Piece, Option<Definition>), FormTextError> {
        FormText::new(PATH, text).read()
    }

    #[test]
    fn a_header_says_what_a_form_is() {
        let text = "// form: softer\n// approximates: reflectance\n// about: a: b,\n//     c\n\
                    // cites: nobody\n// uses: chord, other/lobe\n// constants: other/fit\n\
                    // function: soft\n\n// note: no key.\nfn soft() {}\n";
        let (piece, form) = read(text).expect("a header");
        let form = form.expect("a form");
        assert_eq!((form.name.as_str(), form.about.as_str()), ("softer", "a: b, c"));
        assert_eq!((form.cites.as_str(), form.function.as_deref()), ("nobody", Some("soft")));
        assert_eq!(form.approximates.as_deref(), Some("reflectance"));
        assert_eq!(
            (form.constants, form.uses),
            (vec!["other/fit".to_owned()], vec!["soft".into()])
        );
        assert_eq!(piece.uses, [(6, "chord".to_owned()), (6, "other/lobe".to_owned())]);
        assert_eq!(
            (piece.header_lines, piece.body.as_str()),
            (8, "\n// note: no key.\nfn soft() {}")
        );
    }

    #[test]
    fn a_text_that_says_nothing_of_itself_is_a_piece() {
        for text in
            ["", "// Chord, as printed: exact.\nfn f() {}", "\n// about: late\n", "// uses: chord"]
        {
            assert!(read(text).expect("no fault").1.is_none(), "{text}");
        }
    }

    #[test]
    fn faults_of_a_header_are_told_with_their_line() {
        use FormTextFault::{EmptyValue, MissingKey, NoStatement, RepeatedKey, UnknownKey};
        let faults = [
            ("// aproximates: x\n", 1, UnknownKey("aproximates".into())),
            ("// about: x\n// from: y\n", 2, UnknownKey("from".into())),
            ("// cites: x\n", 1, MissingKey("about")),
            ("// about: x\n", 1, MissingKey("cites")),
            ("// about: x\n// about: y\n", 2, RepeatedKey("about".into())),
            ("// about: x\n// cites:\n", 2, EmptyValue("cites".into())),
            ("// uses: chord,\n", 1, EmptyValue("uses".into())),
            ("// about: x\n// and more\n", 2, NoStatement),
        ];
        for (text, line, fault) in faults {
            let error = read(text).expect_err(text);
            assert_eq!((error.place.line, &error.fault), (line, &fault), "{text}");
            assert!(error.to_string().starts_with(&format!("{PATH}:{line}: ")), "{error}");
        }
    }

    #[test]
    fn combinations_are_forms_with_their_lines() {
        let entry = "[[form]]\nname = 'a'\nuses = ['x', 'y/z']\nabout = 'b'\ncites = 'c'\n";
        let list = |text: String| FormText::new("forms/combinations.toml", text).combinations();
        let forms = list(format!("{entry}\n{entry}constants = ['d']\n")).expect("a list");
        assert_eq!(forms.len(), 2);
        assert_eq!((forms[1].0, forms[1].1.uses.len()), (7, 2));
        assert_eq!(
            (&forms[0].1.constants, &forms[1].1.constants),
            (&vec![], &vec!["d".to_owned()])
        );
        for (wrong, line) in
            [(format!("{entry}aproximates = 'd'\n"), 6), (entry.replace("'x', 'y/z'", ""), 1)]
        {
            assert_eq!(list(wrong).expect_err("a fault").place.line, line);
        }
    }
}
