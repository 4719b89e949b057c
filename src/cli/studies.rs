//! What `bench`, `report` and `all` measure: every effect with its committed results.

use anyhow::{Context as _, bail};

use super::context::Context;
use super::project::Project;
use super::specs;
use crate::effect::{Effect, Member};
use crate::fit::FitResult;
use crate::fit::outcome::{FamilyOutcome, Outcome};
use crate::gpu::{self, Device};
use crate::numeric::measured::Measured;
use crate::registry::EFFECTS;
use crate::render::surface::render_surface;
use crate::render::{AnyScene, Backend, Resources, render_scene};
use crate::report::pages::{SceneEvidence, SurfaceEvidence};
use crate::validate::candidates::{candidates, timed_references};
use crate::validate::cost::{Costs, costs};
use crate::validate::study::{Study, study};

/// The committed results of a project.
#[derive(Debug, Default)]
pub(super) struct Results {
    singles: Vec<Outcome>,
    families: Vec<FamilyOutcome>,
}

impl Results {
    /// Reads the result of every spec.
    pub(super) fn read(project: &Project) -> anyhow::Result<Self> {
        let mut results = Self::default();
        for spec in specs::find(&project.fits())? {
            let path = spec.result();
            if !path.is_file() {
                bail!("{} has no result yet: run `striae fit --all`", spec.name);
            }
            match FitResult::read(&path)? {
                FitResult::Single(outcome) => results.singles.push(*outcome),
                FitResult::Family(family) => results.families.push(family),
            }
        }
        Ok(results)
    }

    fn singles_of(&self, effect: &Effect) -> Vec<Outcome> {
        self.singles.iter().filter(|outcome| is_of(&outcome.name, effect)).cloned().collect()
    }

    fn families_of(&self, effect: &Effect) -> Vec<FamilyOutcome> {
        self.families.iter().filter(|outcome| is_of(&outcome.name, effect)).cloned().collect()
    }
}

fn is_of(name: &str, effect: &Effect) -> bool {
    name.split('/').next() == Some(effect.name)
}

/// An effect, measured.
#[derive(Debug)]
pub(super) struct Studied {
    pub(super) effect: &'static Effect,
    pub(super) study: Study,
    pub(super) costs: Costs,
    pub(super) families: Vec<FamilyOutcome>,
    pub(super) members: Vec<Vec<Member>>,
}

/// The device, or why there is none; an error if one is required.
pub(super) fn device() -> anyhow::Result<Measured<Device>> {
    match Device::open() {
        Ok(device) => Ok(Measured::Value(device)),
        Err(error) if gpu::required() => Err(error.into()),
        Err(error) => Ok(Measured::NotMeasured(error.to_string())),
    }
}

/// The effects called `names`, or all of them.
pub(super) fn effects(names: &[String]) -> anyhow::Result<Vec<&'static Effect>> {
    let of = |name: &str| EFFECTS.iter().copied().find(|effect| effect.name == name);
    if names.is_empty() {
        return Ok(EFFECTS.to_vec());
    }
    names
        .iter()
        .map(|name| {
            of(name).with_context(|| {
                let known: Vec<&str> = EFFECTS.iter().map(|effect| effect.name).collect();
                format!("there is no effect `{name}`; there are: {}", known.join(", "))
            })
        })
        .collect()
}

/// Renders every scene of the project, on the device if there is one.
pub(super) fn scenes(
    device: &Measured<Device>,
    context: &Context,
) -> anyhow::Result<(Vec<SceneEvidence>, Vec<SurfaceEvidence>)> {
    let project = context.project()?;
    let (fits, data) = (project.fits(), project.data());
    let backend = device.value().map_or(Backend::Lanes, Backend::Device);
    let (mut lobes, mut surfaces) = (Vec::new(), Vec::new());
    for path in project.scenes()? {
        let resources = Resources { fits: &fits, data: &data };
        let named = || path.display().to_string();
        match AnyScene::read(&path)? {
            AnyScene::Lobe(scene) => {
                let rendered =
                    render_scene(&scene, resources, backend, &mut |_| ()).with_context(named)?;
                lobes.push(SceneEvidence { scene: *scene, rendered });
            }
            AnyScene::Surface(scene) => {
                let rendered =
                    render_surface(&scene, resources, backend, &mut |_| ()).with_context(named)?;
                surfaces.push(SurfaceEvidence { scene: *scene, rendered });
            }
        }
    }
    Ok((lobes, surfaces))
}

/// Measures `effect`: accuracy, laws, parity, findings and cost.
pub(super) fn measure(
    effect: &'static Effect,
    results: &Results,
    device: &Measured<Device>,
    context: &Context,
) -> anyhow::Result<Studied> {
    let project = context.project()?;
    let (singles, families) = (results.singles_of(effect), results.families_of(effect));
    let members = effect
        .families
        .iter()
        .map(|family| (family.members)(&project.data(), true).context(family.name))
        .collect::<Result<Vec<_>, _>>()?;
    let study = study(effect, &singles, &families, &members, project.root(), device)?;
    let timed = candidates(effect, &singles, &families, &members, project.root())?;
    let costs = costs(effect.name, &timed, &timed_references(effect)?, device)?;
    Ok(Studied { effect, study, costs, families, members })
}
