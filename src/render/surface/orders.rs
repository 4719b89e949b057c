//! The orders of a diffraction table as taps, apart from the mirror.

use crate::effects::diffraction::OrderGrowth;
use crate::numeric::statistics::sum;
use crate::render::sphere_map::Taps;
use crate::table::{Axis, Grid, centres};

/// What sums at points of a surface take from a table, or from what approximates one.
#[derive(Debug, Clone, PartialEq)]
pub struct Orders {
    /// One tap per cell: displacement along the two directions of a hit, width of the cell, and the table
    /// times the area of the cell, without the zero order.
    pub taps: Taps,
    /// Share of the light that the table returns, R, G, B: what its orders leave of it is the mirror's.
    pub total: [f64; 3],
    /// How the orders grow with w.
    pub growth: OrderGrowth,
}

impl Orders {
    /// Of a table over h_x and h_y with channels R, G, B.
    pub fn of_table(grid: &Grid, growth: OrderGrowth) -> Self {
        let mut orders = Self { taps: Taps::default(), total: [0.0; 3], growth };
        orders.taps = orders.taps_of(grid);
        orders.total = channels(grid).map(|values| cell(grid) * sum(wide(values)));
        orders
    }

    /// The taps of another table with this zero order.
    pub(super) fn taps_of(&self, grid: &Grid) -> Taps {
        let (x, y, area) = (grid.x(), grid.y(), cell(grid));
        let width = x.step().abs().max(y.step().abs());
        let channels = channels(grid);
        let [beside, ahead] = [x, y].map(zero_order_shares);
        let mut taps = Taps::default();
        for (at, [h_x, h_y]) in centres(x, y).enumerate() {
            let zero_order = beside[at % x.count] * ahead[at / x.count];
            let weight = [0, 1, 2].map(|c| {
                let value = channels[c].get(at).map_or(0.0, |value| f64::from(*value));
                value * area - zero_order * self.growth.zero_order[c]
            });
            taps.push([h_x, h_y, width], weight);
        }
        taps
    }

    /// These orders by other taps.
    #[must_use]
    pub(super) fn by(&self, taps: Taps) -> Self {
        Self { taps, ..self.clone() }
    }

    /// Without the smallest taps, which hold `share` of the sum of |weights|.
    #[must_use]
    pub(super) fn thinned(&self, share: f64) -> Self {
        self.by(self.taps.thinned(share))
    }
}

/// What of the zero order lies in each cell of an axis: in the one around 0, or in two at whose edge it is.
pub(in crate::render) fn zero_order_shares(axis: &Axis) -> Vec<f64> {
    let within = 0.5 * axis.step().abs() * (1.0 + 1e-9);
    let around = |centre: &f64| centre.abs() <= within;
    let centres = axis.centres();
    let count = centres.iter().filter(|centre| around(centre)).count().max(1);
    centres.iter().map(|centre| f64::from(u8::from(around(centre))) / count as f64).collect()
}

fn cell(grid: &Grid) -> f64 {
    (grid.x().step() * grid.y().step()).abs()
}

fn channels(grid: &Grid) -> [&[f32]; 3] {
    ["R", "G", "B"].map(|name| grid.channel(name).map_or(&[][..], |channel| &channel.values))
}

fn wide(values: &[f32]) -> impl Iterator<Item = f64> + '_ {
    values.iter().map(|value| f64::from(*value))
}
