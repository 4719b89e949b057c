//! The report of a run.

use std::path::Path;

use super::{Run, RunError, write_accuracy};
use crate::document::{Colophon, Page};
use crate::gate::{Check, Judgement, SCENES};
use crate::render::surface::render_surface;
use crate::render::{AnyScene, Backend, Resources, render_scene};
use crate::report::html::{Written, write_site};
use crate::report::pages::{
    EffectEvidence, SceneEvidence, SurfaceEvidence, effect_page, index_page, scenes_page,
    surfaces_page,
};

impl Run {
    /// Measures every effect, renders every scene and writes the report with the verdicts of `check`
    /// into `folder`, and the table
    /// of errors beside the project's own. `watch` is told what is measured.
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
        let (scenes, surfaces) = self.scenes(watch)?;
        watch("the report");
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
        let of_scenes = |names: Vec<&str>| -> Vec<&Judgement> {
            let named = |of: &&Judgement| {
                let rest = of.gate.subject.strip_prefix(SCENES).unwrap_or_default();
                names.contains(&rest.split('#').next().unwrap_or_default())
            };
            gates.iter().copied().filter(named).collect()
        };
        if !scenes.is_empty() {
            let names = scenes.iter().map(|of| of.scene.name.as_str()).collect();
            pages.push(scenes_page(&scenes, &of_scenes(names))?);
        }
        if !surfaces.is_empty() {
            let names = surfaces.iter().map(|of| of.scene.name.as_str()).collect();
            pages.push(surfaces_page(&surfaces, &of_scenes(names))?);
        }
        let colophon = Colophon {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            adapter: self.device.value().map(|device| device.description().to_string()),
            command: "striae report".to_owned(),
            facts: Vec::new(),
        };
        Ok(write_site(folder, &pages, &colophon)?)
    }

    fn scenes(
        &self,
        watch: &(dyn Fn(&str) + Sync),
    ) -> Result<(Vec<SceneEvidence>, Vec<SurfaceEvidence>), RunError> {
        let (fits, data) = (self.project.fits(), self.project.data());
        let backend = self.device.value().map_or(Backend::Lanes, Backend::Device);
        let (mut lobes, mut surfaces) = (Vec::new(), Vec::new());
        for path in self.project.scenes()? {
            let shown = path.display().to_string();
            watch(&shown);
            let resources = Resources { fits: &fits, data: &data };
            let failed = |source| RunError::Scene { scene: shown.clone(), source };
            match AnyScene::read(&path)? {
                AnyScene::Lobe(scene) => {
                    let rendered = render_scene(&scene, resources, backend, &mut |_| ());
                    lobes
                        .push(SceneEvidence { scene: *scene, rendered: rendered.map_err(failed)? });
                }
                AnyScene::Surface(scene) => {
                    let rendered =
                        render_surface(&scene, resources, backend, &mut |_| ()).map_err(failed)?;
                    surfaces.push(SurfaceEvidence { scene: *scene, rendered });
                }
            }
        }
        Ok((lobes, surfaces))
    }
}
