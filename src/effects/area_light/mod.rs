//! Area lights on a scratch with rectangular profile, in direction-cosine space (velinov2018 §3.4):
//! [`band`] along the lobe of the scratch, [`lights`] in both directions.

pub mod band;
pub mod lights;

pub use lights::{polygon_light, sphere_light};

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

use crate::effect::{Effect, FormText, Functions};

static FORMS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/src/effects/area_light/forms");

/// What is said of the exhibits.
const TEXTS: &str = include_str!("exhibits.toml");

/// The effect, as registered.
pub static EFFECT: LazyLock<Effect> = LazyLock::new(|| {
    let functions = Functions {
        forms: || FormText::embedded("src/effects/area_light/forms", &FORMS),
        references: &[band::REFERENCES, lights::REFERENCES].concat(),
        regions: &[band::REGIONS, lights::REGIONS].concat(),
        hard_cases: &[band::HARD_CASES, lights::HARD_CASES].concat(),
        laws: &[band::LAWS, lights::LAWS].concat(),
        claims: &[band::CLAIMS, lights::CLAIMS].concat(),
        exhibits: |candidates| {
            Ok([band::exhibits(candidates)?, lights::exhibits(candidates)?].concat())
        },
        ..Functions::NONE
    };
    Effect::of_text(include_str!("effect.toml"), functions)
});
