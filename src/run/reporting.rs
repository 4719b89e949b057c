//! The report of a run.

use std::path::Path;

use rayon::prelude::*;

use super::{Run, RunError, Studied, write_accuracy};
use crate::document::{Colophon, Page};
use crate::gate::{Check, Judgement, SCENES};
use crate::render::{Backend, RenderOptions, draw, render};
use crate::report::html::{Written, write_site};
use crate::report::pages::{EffectEvidence, SceneEvidence, effect_page, index_page, scenes_page};

impl Run {
    /// Measures every effect and writes the report on them as by [`Run::report_on`]; where `folder` is
    /// the project's own, the table of errors too.
    ///
    /// # Errors
    /// If anything of the project cannot be measured, rendered or written.
    pub fn report(
        &self,
        folder: &Path,
        check: &Check,
        watch: &(dyn Fn(&str) + Sync),
    ) -> Result<Written, RunError> {
        let studied = self.studies(self.project.registry().effects(), watch)?;
        if folder == self.project.report() {
            write_accuracy(&self.project.accuracy(), &studied)?;
        }
        self.report_on(&studied, folder, check, watch)
    }

    /// The index of a report on `studied`, then the page of each effect.
    ///
    /// # Errors
    /// If a form or a reference cannot be evaluated for a curve.
    pub fn effect_pages(&self, studied: &[Studied], check: &Check) -> Result<Vec<Page>, RunError> {
        let gates: Vec<&Judgement> = check.gates.iter().collect();
        let of: Vec<Vec<&Judgement>> = studied
            .iter()
            .map(|studied| {
                let prefix = format!("{}/", studied.effect.name);
                let own = |of: &&Judgement| of.gate.subject.starts_with(&prefix);
                gates.iter().copied().filter(own).collect()
            })
            .collect();
        let registry = self.project.registry();
        let forms = studied.iter().map(|studied| registry.forms_of(studied.effect).collect());
        let forms: Vec<Vec<_>> = forms.collect();
        let evidence: Vec<EffectEvidence<'_>> = studied
            .iter()
            .zip(of.iter().zip(&forms))
            .map(|(studied, (gates, forms))| EffectEvidence {
                effect: studied.effect,
                forms,
                study: &studied.study,
                costs: &studied.costs,
                subjects: &studied.subjects,
                members: &studied.members,
                gates,
            })
            .collect();
        let mut pages = vec![index_page(&evidence, &gates)];
        pages.extend(evidence.iter().map(effect_page).collect::<Result<Vec<Page>, _>>()?);
        Ok(pages)
    }

    /// Renders every scene of the project and writes the report on `studied`, what was measured of some
    /// effects or all, with the verdicts of `check` into `folder`. `watch` is told what is rendered.
    ///
    /// # Errors
    /// If anything of the project cannot be rendered or written.
    pub fn report_on(
        &self,
        studied: &[Studied],
        folder: &Path,
        check: &Check,
        watch: &(dyn Fn(&str) + Sync),
    ) -> Result<Written, RunError> {
        let scenes = self.rendered(watch)?;
        watch("the report");
        let gates: Vec<&Judgement> = check.gates.iter().collect();
        let mut pages = self.effect_pages(studied, check)?;
        if !scenes.is_empty() {
            let on_scenes = |of: &&Judgement| of.gate.subject.starts_with(SCENES);
            let gates: Vec<&Judgement> = gates.iter().copied().filter(on_scenes).collect();
            pages.push(scenes_page(&scenes, &gates)?);
        }
        let colophon = Colophon {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            adapter: self.device.value().map(|device| device.description().to_string()),
            command: "striae report".to_owned(),
        };
        Ok(write_site(folder, &pages, &colophon)?)
    }

    /// Scenes drawn on the device; where that is the same CPU in software, pictures that gates have judged
    /// on lanes are not drawn again.
    fn rendered(&self, watch: &(dyn Fn(&str) + Sync)) -> Result<Vec<SceneEvidence>, RunError> {
        let device = self.device.value();
        let options = RenderOptions {
            backend: device.map_or(Backend::Lanes, Backend::Device),
            reuse: device.is_some_and(|device| device.description().is_software()),
            budget_s: self.timing.budget_s,
        };
        let paths = self.project.scenes()?;
        let failed = |path: &Path, source| RunError::Scene {
            scene: path.display().to_string(),
            source: Box::new(source),
        };
        let prepared = paths.par_iter().map(|path| {
            watch(&path.display().to_string());
            let scene = self.scenes.prepared(path, &self.project)?;
            draw(&scene, options).map(|()| scene)
        });
        // Nothing else runs beside what is timed.
        let drawn = prepared.collect::<Vec<_>>().into_iter().zip(&paths).map(|(scene, path)| {
            let scene = scene.map_err(|source| failed(path, source))?;
            let rendered =
                render(&scene, options, &mut |_| ()).map_err(|source| failed(path, source))?;
            Ok(SceneEvidence { scene, rendered })
        });
        drawn.collect()
    }
}
