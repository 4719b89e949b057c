use super::{GREEN_NM, TEXTS, line};
use crate::document::Section;
use crate::document::plot::Series;
use crate::effect::{ClaimError, DomainError, Exhibit};
use crate::effects::diffraction::far_field::{FarField, FarFieldTransform};
use crate::effects::diffraction::reference::{rectangular_order_power, sinusoid_order_power};
use crate::effects::diffraction::surfaces::Profile;
use crate::effects::diffraction::table::NORMAL;

const PERIOD_UM: f64 = 3.2;
const ORDERS: u32 = 4;

/// Power between the halves to the neighbouring orders.
fn power(field: &FarField, order: u32) -> f64 {
    field.share(|fx, _| (fx * PERIOD_UM - f64::from(order)).abs() < 0.5)
}

pub(super) fn exhibit() -> Result<Section, ClaimError> {
    let phase_per_nm = std::f64::consts::TAU * NORMAL / GREEN_NM;
    let transform =
        FarFieldTransform::new(&line(PERIOD_UM, Profile::Sinusoid { amplitude_nm: 1.0 })?, 1)?;
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
        let fine = (0..=312)
            .map(|i| 0.02 * f64::from(i))
            .map(|phase| Ok((phase, exact(phase)?)))
            .collect::<Result<Vec<_>, DomainError>>()?;
        let pairs = phases.iter().copied().zip(powers.iter().copied());
        curves.push(Series::line(format!("J_{order}²"), fine));
        curves.push(Series::markers(format!("far field, m = {order}"), pairs));
        let mut worst = 0.0_f64;
        for (phase, power) in phases.iter().zip(powers) {
            worst = worst.max((power - exact(*phase)?).abs());
        }
        let depth = 120.0;
        let rectangle = Profile::Rectangle { depth_nm: depth, duty: 0.5 };
        let field = transform.far_field(&line(PERIOD_UM, rectangle)?, GREEN_NM, NORMAL);
        let expected = rectangular_order_power(order, 0.5, phase_per_nm * depth)?;
        let found = power(&field, order);
        rows.push(vec![f64::from(order).into(), worst.into(), expected.into(), found.into()]);
    }
    let exhibit = Exhibit::of(TEXTS, "order_powers", &[("parseval", format!("{parseval:.1e}"))]);
    Ok(exhibit.figure(curves).table(rows).section())
}
