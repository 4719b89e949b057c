use super::grating::line;
use super::{GREEN_NM, number, series, table};
use crate::effect::exhibit::{Exhibit, ExhibitAxis, ExhibitError, ExhibitPlot, Stroke};
use crate::effects::diffraction::far_field::{FarField, Transform};
use crate::effects::diffraction::reference::{rectangular_order_power, sinusoid_order_power};
use crate::effects::diffraction::surfaces::Profile;
use crate::effects::diffraction::table::NORMAL;

const PERIOD_UM: f64 = 3.2;
const ORDERS: u32 = 4;

/// Power between the halves to the neighbouring orders.
fn power(field: &FarField, order: u32) -> f64 {
    field.share(|fx, _| (fx * PERIOD_UM - f64::from(order)).abs() < 0.5)
}

pub(super) fn exhibit() -> Result<Exhibit, ExhibitError> {
    let phase_per_nm = std::f64::consts::TAU * NORMAL / GREEN_NM;
    let transform = Transform::new(&line(PERIOD_UM, Profile::Sinusoid { amplitude_nm: 1.0 })?, 1)?;
    let phases: Vec<f64> = (0..=48).map(|i| 0.13 * f64::from(i)).collect();
    let mut found: Vec<Vec<f64>> = vec![Vec::new(); ORDERS as usize];
    let mut parseval = 0.0_f64;
    for phase in &phases {
        let profile = Profile::Sinusoid { amplitude_nm: phase / phase_per_nm };
        let field = transform.far_field(&line(PERIOD_UM, profile)?, GREEN_NM, NORMAL);
        parseval = parseval.max((field.total() - 1.0).abs());
        for (order, powers) in (0..).zip(&mut found) {
            powers.push(power(&field, order));
        }
    }
    let mut curves = Vec::new();
    let mut rows = Vec::new();
    for (order, powers) in (0..).zip(&found) {
        let exact = |phase: f64| sinusoid_order_power(order, phase);
        let fine: Vec<(f64, f64)> = (0..=312)
            .map(|i| 0.02 * f64::from(i))
            .map(|phase| Ok((phase, exact(phase)?)))
            .collect::<Result<_, ExhibitError>>()?;
        curves.push(series(&format!("J_{order}²"), fine, Stroke::Line));
        let pairs = phases.iter().copied().zip(powers.iter().copied()).collect();
        curves.push(series(&format!("far field, m = {order}"), pairs, Stroke::Markers));
        let mut worst = 0.0_f64;
        for (phase, power) in phases.iter().zip(powers) {
            worst = worst.max((power - exact(*phase)?).abs());
        }
        let depth = 120.0;
        let rectangle = Profile::Rectangle { depth_nm: depth, duty: 0.5 };
        let field = transform.far_field(&line(PERIOD_UM, rectangle)?, GREEN_NM, NORMAL);
        let expected = rectangular_order_power(order, 0.5, phase_per_nm * depth)?;
        rows.push(vec![
            number(f64::from(order)),
            number(worst),
            number(expected),
            number(power(&field, order)),
        ]);
    }
    Ok(Exhibit {
        title: "Orders of gratings".into(),
        text: vec![format!(
            "Powers of the orders in the far field of gratings of 32 periods, 64 samples each, beside \
             the closed forms. Over all frequencies the powers sum to 1 within {parseval:.1e}. Half a \
             sample at each edge of the rectangle is cut: its powers agree to the sampling."
        )],
        plots: vec![ExhibitPlot {
            stem: "diffraction-orders",
            title: "Sinusoidal relief".into(),
            caption: "Share of the power in order m over the amplitude of the phase a = k w b."
                .into(),
            x: ExhibitAxis { label: "amplitude of the phase a", unit: "rad", log: false },
            y: ExhibitAxis { label: "power", unit: "1", log: false },
            series: curves,
        }],
        tables: vec![table(
            "Largest |far field − J_m²| of the sinusoids, and a rectangle 120 nm deep at 550 nm",
            &[
                ("m", "1"),
                ("sinusoid, largest error", "1"),
                ("rectangle, closed form", "1"),
                ("rectangle, far field", "1"),
            ],
            rows,
        )],
    })
}
