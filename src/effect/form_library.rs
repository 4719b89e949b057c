//! Registered forms: made from texts, each with the pieces that it uses put together.

use std::collections::BTreeMap;
use std::path::Path;

use super::form_text::{
    Definition, FormText, FormTextError, FormTextFault, Piece, TextPlace, entries,
};
use super::{Candidate, CandidateError, ConstantsOf, Effect};
use crate::form::{Form, FormError};

/// What forms are called that stand in no folder of their own: `own/form`.
const OWN: &str = "own";

/// A registered approximation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FormEntry {
    /// `effect/form`, as in `striae eval NAME`.
    pub name: String,
    /// One line.
    pub description: String,
    /// Where it comes from: paper and equation, or `striae`.
    pub citation: String,
    /// Path of its text, for diagnostics; of the first piece where it is put together from pieces.
    pub path: String,
    /// The WGSL text with everything that it uses.
    pub source: String,
    /// The WGSL function.
    pub function: String,
    /// The reference that it approximates; without one only tables can judge it.
    pub reference: Option<String>,
    /// The family over which it is judged, in place of the reference.
    pub family: Option<String>,
    /// Forms or fits whose constants it ships with where it has no fit of its own; empty for those
    /// of its text.
    pub constants_of: Vec<String>,
}

/// Registered forms in order: effect by effect, within one by reference, the baseline first, then as
/// their texts are listed; forms of no effect last.
#[derive(Debug, Clone, Default)]
pub struct FormLibrary {
    pieces: BTreeMap<String, Piece>,
    entries: Vec<FormEntry>,
}

impl FormEntry {
    /// The form with the constants of its text.
    ///
    /// # Errors
    /// [`CandidateError`] if the text is not a form or leaves a constant without a value.
    pub fn written(&self) -> Result<Candidate, CandidateError> {
        Candidate::new(&self.name, self.load()?, &BTreeMap::new(), ConstantsOf::Text)
    }

    /// Parses and compiles the form.
    ///
    /// # Errors
    /// [`FormError`] if the text is not a form.
    pub fn load(&self) -> Result<Form, FormError> {
        Form::parse(&self.path, &self.source, &self.function)
    }

    /// The effect to which it belongs, or the folder in which it stands.
    pub fn owner(&self) -> &str {
        self.name.split_once('/').map_or("", |(owner, _)| owner)
    }
}

impl FormLibrary {
    /// The forms of `effects`, which may use each other's texts.
    ///
    /// # Errors
    /// [`FormTextError`] for the first fault in a text.
    pub fn new(effects: &[&Effect]) -> Result<Self, FormTextError> {
        Self::default().with(effects, texts_of(effects))
    }

    /// With the forms of one effect more, the last of `effects`.
    ///
    /// # Errors
    /// [`FormTextError`] for the first fault in a text.
    pub fn with_last(self, effects: &[&Effect]) -> Result<Self, FormTextError> {
        self.with(effects, texts_of(&effects[effects.len().saturating_sub(1)..]))
    }

    /// With the forms of a folder on disk: `NAME/form.wgsl` is registered as `NAME/form`, and
    /// belongs to the effect of that name if there is one; `form.wgsl` as `own/form`. They may use
    /// every text that is registered, and approximate a reference of `effects`.
    ///
    /// # Errors
    /// [`FormTextError`] for the first fault in a text, or if the folder cannot be read.
    pub fn with_folder(self, effects: &[&Effect], folder: &Path) -> Result<Self, FormTextError> {
        let mut texts = Vec::new();
        let mut add = |owner: &str, folder: &Path| -> Result<(), FormTextError> {
            let found = FormText::read_folder(folder)?;
            texts.extend(found.into_iter().map(|text| (owner.to_owned(), text)));
            Ok(())
        };
        add(OWN, folder)?;
        for inner in entries(folder)?.into_iter().filter(|path| path.is_dir()) {
            add(&inner.file_name().unwrap_or_default().to_string_lossy(), &inner)?;
        }
        self.with(effects, texts)
    }

    /// Every form, in order.
    pub fn iter(&self) -> std::slice::Iter<'_, FormEntry> {
        self.entries.iter()
    }

    /// The form called `name`.
    pub fn get(&self, name: &str) -> Option<&FormEntry> {
        self.entries.iter().find(|entry| entry.name == name)
    }

    /// The forms of the effect or folder called `owner`, in order.
    pub fn of<'a>(&'a self, owner: &'a str) -> impl Iterator<Item = &'a FormEntry> {
        self.entries.iter().filter(move |entry| entry.owner() == owner)
    }

    /// With the forms of `texts`, each beside the name of its effect or folder.
    fn with(
        mut self,
        effects: &[&Effect],
        texts: Vec<(String, FormText)>,
    ) -> Result<Self, FormTextError> {
        let mut definitions = Vec::new();
        let mut added = Vec::new();
        for (owner, text) in texts {
            let place = |line| TextPlace { path: text.path.clone(), line };
            if text.is_combinations() {
                let forms = text.combinations()?.into_iter();
                definitions.extend(forms.map(|(line, form)| (owner.clone(), place(line), form)));
                continue;
            }
            let (piece, form) = text.read()?;
            let name = format!("{owner}/{}", text.name);
            if let Some(other) = self.pieces.insert(name.clone(), piece) {
                let fault = FormTextFault::Taken { name, by: other.path };
                return Err(FormTextError { place: place(0), fault });
            }
            added.push((name, place(0)));
            definitions.extend(form.map(|form| (owner, place(1), form)));
        }
        // Pieces that no form uses are to be without fault too.
        for (name, place) in &added {
            self.follow("", name, place, &mut Vec::new(), &mut Vec::new())?;
        }
        for (owner, place, form) in definitions {
            let entry = self.entry(effects, &owner, &place, form)?;
            self.entries.push(entry);
        }
        self.entries.sort_by_key(|entry| rank(effects, entry));
        Ok(self)
    }

    fn entry(
        &self,
        effects: &[&Effect],
        owner: &str,
        place: &TextPlace,
        form: Definition,
    ) -> Result<FormEntry, FormTextError> {
        let fails = |fault| Err(FormTextError { place: place.clone(), fault });
        let name = format!("{owner}/{}", form.name);
        if let Some(other) = self.get(&name) {
            return fails(FormTextFault::Taken { name, by: other.path.clone() });
        }
        let mut references = effects.iter().flat_map(|effect| effect.references);
        let reference =
            form.approximates.iter().find(|name| !references.any(|of| of.name == *name));
        if let Some(name) = reference {
            return fails(FormTextFault::UnknownReference(name.clone()));
        }
        let mut families = effects.iter().flat_map(|effect| effect.families);
        if let Some(name) = form.over.iter().find(|name| !families.any(|of| of.name == *name)) {
            return fails(FormTextFault::UnknownFamily(name.clone()));
        }
        let mut used = Vec::new();
        for text in &form.uses {
            self.follow(owner, text, place, &mut Vec::new(), &mut used)?;
        }
        let (path, source) = self.assembled(&used);
        Ok(FormEntry {
            function: form.function.or_else(|| form.approximates.clone()).unwrap_or(form.name),
            name,
            description: form.about,
            citation: form.cites,
            path,
            source,
            reference: form.approximates,
            family: form.over,
            constants_of: form.constants,
        })
    }

    /// Adds the text that `owner` calls `used` to `found`, then what it uses, in order of first use.
    /// `from` names it, and `open` are the texts that led to it.
    fn follow(
        &self,
        owner: &str,
        used: &str,
        from: &TextPlace,
        open: &mut Vec<String>,
        found: &mut Vec<String>,
    ) -> Result<(), FormTextError> {
        let name = if used.contains('/') { used.to_owned() } else { format!("{owner}/{used}") };
        let fails = |fault| Err(FormTextError { place: from.clone(), fault });
        let Some(piece) = self.pieces.get(&name) else {
            return fails(FormTextFault::UnknownText(name));
        };
        if let Some(at) = open.iter().position(|other| *other == name) {
            return fails(FormTextFault::Cycle([&open[at..], &[name]].concat()));
        }
        if found.contains(&name) {
            return Ok(());
        }
        found.push(name.clone());
        open.push(name.clone());
        let owner = name.split_once('/').map_or("", |(owner, _)| owner);
        for (line, used) in &piece.uses {
            let from = TextPlace { path: piece.path.clone(), line: *line };
            self.follow(owner, used, &from, open, found)?;
        }
        open.pop();
        Ok(())
    }

    /// Path of the first text, and all of them: the first with empty lines for its header, so that
    /// its lines keep their numbers.
    fn assembled(&self, names: &[String]) -> (String, String) {
        let pieces = names.iter().filter_map(|name| self.pieces.get(name));
        let (mut path, mut source) = (String::new(), String::new());
        for piece in pieces {
            if path.is_empty() {
                path.clone_from(&piece.path);
                source = "\n".repeat(piece.header_lines) + &piece.body;
            } else {
                source.push('\n');
                source += piece.body.trim_start_matches('\n');
            }
            source.push('\n');
        }
        (path, source)
    }
}

/// The texts of `effects`, each beside the name of its effect.
fn texts_of(effects: &[&Effect]) -> Vec<(String, FormText)> {
    let texts = |effect: &&Effect| {
        let name = effect.name;
        (effect.forms)().into_iter().map(move |text| (name.to_owned(), text))
    };
    effects.iter().flat_map(texts).collect()
}

/// TextPlace in the order of the library.
fn rank(effects: &[&Effect], entry: &FormEntry) -> (usize, usize, bool) {
    let Some(at) = effects.iter().position(|effect| effect.name == entry.owner()) else {
        return (effects.len(), 0, false);
    };
    let references = effects[at].references;
    let reference = references.iter().position(|r| Some(r.name) == entry.reference.as_deref());
    let baseline = effects[at].baselines.contains(&entry.name.as_str());
    (at, reference.unwrap_or(references.len()), !baseline)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effect::Reference;

    const REFERENCE: Reference = Reference {
        name: "reflectance",
        description: "",
        arguments: &[],
        unit: "1",
        accuracy: "",
        source: "",
        evaluate: crate::effect::Evaluate::Scalar(|_| Ok(0.0)),
    };

    const FORM: &str = "// approximates: reflectance\n// about: a\n// cites: b\n";

    fn file(path: &str, header: &str, code: &str) -> FormText {
        FormText::new(path, format!("{header}\n{code}\n"))
    }

    const LOBES: Effect = Effect {
        name: "lobes",
        references: &[REFERENCE],
        baselines: &["lobes/wide"],
        forms: || {
            let narrow = format!("{FORM}// uses: chord, other/phase, rim\n");
            vec![
                file("l/chord.wgsl", "// uses: rim\n", "fn chord() {}"),
                file("l/narrow.wgsl", &narrow, "fn reflectance() {}"),
                file("l/rim.wgsl", "", "fn rim() {}"),
                file("l/wide.wgsl", FORM, "fn reflectance() {}"),
            ]
        },
        ..Effect::EMPTY
    };

    const OTHER: Effect = Effect {
        name: "other",
        forms: || vec![file("o/phase.wgsl", "", "fn phase() {}")],
        ..Effect::EMPTY
    };

    fn fault(forms: fn() -> Vec<FormText>) -> String {
        let effect = Effect { name: "faulty", forms, ..Effect::EMPTY };
        FormLibrary::new(&[&LOBES, &OTHER, &effect]).expect_err("a fault").to_string()
    }

    #[test]
    fn a_form_stands_before_its_pieces_each_of_them_once() {
        let forms = FormLibrary::new(&[&LOBES, &OTHER]).expect("no fault");
        let names: Vec<&str> = forms.iter().map(|form| form.name.as_str()).collect();
        assert_eq!(names, ["lobes/wide", "lobes/narrow"], "the baseline first");
        let narrow = forms.get("lobes/narrow").expect("registered");
        assert_eq!(
            narrow.source,
            "\n\n\n\n\nfn reflectance() {}\n\nfn chord() {}\n\nfn rim() {}\n\nfn phase() {}\n"
        );
        assert_eq!((narrow.path.as_str(), narrow.owner()), ("l/narrow.wgsl", "lobes"));
        assert_eq!(narrow.function, "reflectance");
    }

    #[test]
    fn faults_between_texts_are_told_with_their_place() {
        let unknown = fault(|| vec![file("f/a.wgsl", "// uses: b\n", "")]);
        assert_eq!(unknown, "f/a.wgsl:1: there is no text `faulty/b`");
        let circle = fault(|| {
            let mut texts = vec![file("f/a.wgsl", "// uses: b\n", "")];
            texts.push(file("f/b.wgsl", "// uses: a\n", ""));
            texts
        });
        assert_eq!(circle, "f/b.wgsl:1: faulty/a uses faulty/b uses faulty/a: texts in a circle");
        let twice = fault(|| vec![file("f/a.wgsl", "", ""), file("g/a.wgsl", "", "")]);
        assert_eq!(twice, "g/a.wgsl: `faulty/a` is registered already, by f/a.wgsl");
        let same_name = fault(|| {
            let named = format!("// form: a\n{FORM}");
            vec![file("f/a.wgsl", FORM, ""), file("f/b.wgsl", &named, "")]
        });
        assert_eq!(same_name, "f/b.wgsl:1: `faulty/a` is registered already, by f/a.wgsl");
        let reference =
            fault(|| vec![file("f/a.wgsl", "// about: a\n// cites: b\n// approximates: c\n", "")]);
        assert_eq!(reference, "f/a.wgsl:1: there is no reference `c`");
    }

    #[test]
    fn a_folder_registers_its_own_forms_beside_the_others() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |path: &str, text: &str| {
            let path = folder.path().join(path);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("made");
            std::fs::write(path, text).expect("written");
        };
        write("mine.wgsl", "// about: a\n// cites: b\n// uses: lobes/chord\n\nfn mine() {}\n");
        write("lobes/third.wgsl", &format!("{FORM}// uses: rim\n\nfn reflectance() {{}}\n"));
        write("README.md", "// about: nothing\n");
        let forms = FormLibrary::new(&[&LOBES, &OTHER])
            .and_then(|forms| forms.with_folder(&[&LOBES, &OTHER], folder.path()))
            .expect("no fault");
        let names: Vec<&str> = forms.iter().map(|form| form.name.as_str()).collect();
        assert_eq!(names, ["lobes/wide", "lobes/narrow", "lobes/third", "own/mine"]);
        let mine = forms.get("own/mine").expect("registered");
        assert_eq!((mine.function.as_str(), &mine.reference), ("mine", &None));
        assert!(mine.source.ends_with("fn chord() {}\n\nfn rim() {}\n"), "{}", mine.source);
        let gone = FormLibrary::default().with_folder(&[], &folder.path().join("none"));
        assert!(matches!(gone, Err(FormTextError { fault: FormTextFault::Unreadable(_), .. })));
    }
}
