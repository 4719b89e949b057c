use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;

use super::{GREEN_NM, TEXTS, level};
use crate::document::Section;
use crate::effect::{ClaimError, Exhibit};
use crate::effects::diffraction::preparation::{Detrend, Missing, Preparation, USUAL, Window};
use crate::effects::diffraction::simulation::{Step, changes};
use crate::effects::diffraction::surfaces::{Grating, Patch, Profile, grating};
use crate::effects::diffraction::table::NORMAL;
use crate::measured::height_map::HeightMap;

const PATCH: Patch = Patch { samples: 192, side_um: 48.0, line: false };

/// A sinusoid of 2.9 µm, which does not divide the patch, turned by 30°.
fn base() -> HeightMap {
    let profile = Profile::Sinusoid { amplitude_nm: 40.0 };
    let turned = Grating { period_um: 2.9, angle: std::f64::consts::FRAC_PI_6, profile };
    grating(turned, PATCH)
}

/// The same surface with `share` of its samples missing in round spots of 2 µm, seeded.
fn spotted(map: &HeightMap, share: f64) -> HeightMap {
    let mut spotted = map.clone();
    let mut random = ChaCha12Rng::seed_from_u64(3);
    let total = map.height_nm.len() as f64;
    let mut gone = 0.0;
    while gone < share * total {
        let (x, y) = (random.random_range(0.0..1.0), random.random_range(0.0..1.0));
        let (x, y) = (x * map.nx as f64, y * map.ny as f64);
        for (i, height) in spotted.height_nm.iter_mut().enumerate() {
            let (dx, dy) = ((i % map.nx) as f64 - x, (i / map.nx) as f64 - y);
            if (dx * map.dx_um).hypot(dy * map.dy_um) < 1.0 && height.is_finite() {
                *height = f64::NAN;
                gone += 1.0;
            }
        }
    }
    spotted
}

/// Every second row.
fn halved(map: &HeightMap) -> HeightMap {
    let rows = map.height_nm.chunks(map.nx).step_by(2);
    let height_nm: Vec<f64> = rows.flatten().copied().collect();
    HeightMap { ny: map.ny / 2, dy_um: 2.0 * map.dy_um, height_nm, ..map.clone() }
}

pub(super) fn exhibit() -> Result<Section, ClaimError> {
    let plain = base();
    let tilt = |map: &HeightMap, nm_per_um: f64| {
        let mut tilted = map.clone();
        for (i, height) in tilted.height_nm.iter_mut().enumerate() {
            *height += nm_per_um * map.dx_um * (i % map.nx) as f64;
        }
        tilted
    };
    let (tilted, few, many) = (tilt(&plain, 10.0), spotted(&plain, 0.02), spotted(&plain, 0.1));
    let unequal = halved(&plain);
    let mistaken = HeightMap { dy_um: unequal.dx_um, ..unequal.clone() };
    let step = |name, heights, preparation| Step { name, heights, preparation, padding: 2 };
    let (usual, left) = (level(), Preparation { detrend: Detrend::Nothing, ..USUAL });
    let masked = Preparation { missing: Missing::Mask, ..usual };
    let window = |window| Preparation { window, ..usual };
    let steps = [
        step("level, Hann window, padding 2", &plain, usual),
        step("mean plane off", &plain, USUAL),
        step("tilt of 10 nm/µm taken off", &tilted, USUAL),
        step("tilt of 10 nm/µm left in", &tilted, left),
        step("no window", &plain, window(Window::Rectangle)),
        step("Tukey window", &plain, window(Window::Tukey)),
        step("2 % in spots missing, filled", &few, usual),
        step("2 % missing, masked", &few, masked),
        step("10 % missing, filled", &many, usual),
        step("10 % missing, masked", &many, masked),
        step("every second row", &unequal, usual),
        step("every second row, read as square", &mistaken, usual),
        Step { name: "padding 1", heights: &plain, preparation: usual, padding: 1 },
        Step { name: "padding 4", heights: &plain, preparation: usual, padding: 4 },
    ];
    let table = changes(&steps, GREEN_NM, NORMAL, 257, 1.0)?;
    Ok(Exhibit::of(TEXTS, "preparation", &[]).section().block(table))
}
