//! Factors that are not negative, so that a kernel of them is not either.
//!
//! Hierarchical alternating least squares: one column of one side at a time, in closed form and cut
//! at 0 (Cichocki & Phan 2009, IEICE Trans. E92-A, 708), from the positive parts of the singular
//! vectors (NNDSVD: Boutsidis & Gallopoulos 2008, Pattern Recognition 41, 1350). At rank 1 a table
//! that is not negative has a singular pair that is not either (Perron & Frobenius), and nothing is
//! lost.

use faer::{Mat, MatRef};

use super::methods::{Stopping, per_channel};
use super::terms::Terms;
use super::{Alignment, LowRank, LowRankError};
use crate::table::Grid;

/// Fits factors of rank `rank` that are not negative to every channel.
///
/// # Errors
/// As [`Grid::check_plane`]; [`LowRankError::Rank`]; [`LowRankError::Unusable`] for a table with a
/// negative value, or if singular values do not converge.
pub fn nonnegative(
    table: &Grid,
    alignment: Alignment,
    rank: usize,
    stopping: Stopping,
) -> Result<LowRank, LowRankError> {
    table.check_plane()?;
    for channel in &table.channels {
        if let Some((at, value)) = channel.values.iter().enumerate().find(|(_, v)| **v < 0.0) {
            let (ix, iy) = (at % table.x().count, at / table.x().count);
            let what = format!(
                "channel {:?}, texel ({ix}, {iy}): {value} is negative, and factors that are not \
                 negative cannot give it",
                channel.name
            );
            return Err(LowRankError::unusable(&table.origin, what));
        }
    }
    let fit = |_: usize, s: &Mat<f64>, start: Terms| {
        let mut terms = positive_parts(&start);
        let cost = |t: &Terms| t.residual(s).squared_norm_l2();
        stopping.alternate(cost(&terms), || {
            column_steps(s.as_ref(), &mut terms.vertical, terms.horizontal.as_ref());
            column_steps(s.transpose(), &mut terms.horizontal, terms.vertical.as_ref());
            cost(&terms)
        });
        Ok((terms.balanced(), ()))
    };
    Ok(per_channel(table, alignment, rank, fit)?.0)
}

/// What of a factor has one sign, and its length.
type Part = (Vec<f64>, f64);

/// NNDSVD: of each singular pair, the positive or the negative parts, whichever product is larger.
fn positive_parts(start: &Terms) -> Terms {
    let mut terms = start.clone();
    for m in 0..start.rank() {
        let part = |side: &Mat<f64>, sign: f64| -> Part {
            let part: Vec<f64> = side.col(m).iter().map(|v| (sign * v).max(0.0)).collect();
            let length = part.iter().map(|v| v * v).sum::<f64>().sqrt();
            (part, length)
        };
        let choose = |sign: f64| (part(&start.vertical, sign), part(&start.horizontal, sign));
        let (positive, negative) = (choose(1.0), choose(-1.0));
        let size = |pair: &(Part, Part)| pair.0.1 * pair.1.1;
        let ((v, v_length), (h, h_length)) =
            if size(&positive) >= size(&negative) { positive } else { negative };
        // Both sides of the pair have the length of its singular value's root, so the lengths of
        // the parts already carry it; it is shared evenly.
        let target = (v_length * h_length).sqrt();
        let scaled = |list: &[f64], length: f64, i: usize| {
            if length > 0.0 { list.get(i).map_or(0.0, |x| x * target / length) } else { 0.0 }
        };
        for i in 0..terms.vertical.nrows() {
            terms.vertical[(i, m)] = scaled(&v, v_length, i);
        }
        for j in 0..terms.horizontal.nrows() {
            terms.horizontal[(j, m)] = scaled(&h, h_length, j);
        }
    }
    terms
}

/// One pass over the columns of `side`, `other` held: s ≈ side · otherᵀ.
fn column_steps(s: MatRef<'_, f64>, side: &mut Mat<f64>, other: MatRef<'_, f64>) {
    let projected = s * other;
    let gram = other.transpose() * other;
    for m in 0..side.ncols() {
        let own = gram[(m, m)];
        if own <= 0.0 {
            continue;
        }
        for i in 0..side.nrows() {
            let fitted: f64 = (0..side.ncols()).map(|k| side[(i, k)] * gram[(k, m)]).sum();
            side[(i, m)] = (side[(i, m)] + (projected[(i, m)] - fitted) / own).max(0.0);
        }
    }
}
