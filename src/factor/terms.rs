//! The terms of one channel while they are worked on, and the form in which they are given out.

use faer::{Mat, MatRef};

use faer::linalg::matmul::matmul;
use faer::{Accum, Par};

use super::matrix::{ThinSvd, thin_svd};
use super::{ChannelFactors, LowRankError};

/// Σ_m vertical column m · horizontal column m: ny × r and nx × r.
#[derive(Debug, Clone)]
pub(super) struct Terms {
    pub(super) vertical: Mat<f64>,
    pub(super) horizontal: Mat<f64>,
}

/// A vertical factor whose sum is below this part of Σ|v| has no sign of its own.
const NO_SUM: f64 = 1e-9;
/// Entries within this part of the largest count as equally large.
const AS_LARGE: f64 = 1e-9;
/// Cosine between vertical factors of two channels above which they are the same term.
const SAME_TERM: f64 = 0.5;
/// Singular values closer than this part of the largest are one: their vectors are rounding.
const REPEATED: f64 = 1e-12;

impl Terms {
    /// The first `rank` terms of U Σ Vᵀ, shared evenly: U Σ^½ and Σ^½ Vᵀ (toisoul2017 §4.1).
    pub(super) fn of_svd(svd: &ThinSvd, rank: usize) -> Self {
        let root = |m: usize| svd.values.get(m).map_or(0.0, |s| s.sqrt());
        Self {
            vertical: Mat::from_fn(svd.left.nrows(), rank, |i, m| svd.left[(i, m)] * root(m)),
            horizontal: Mat::from_fn(svd.right.nrows(), rank, |j, m| svd.right[(j, m)] * root(m)),
        }
    }

    /// Number of terms.
    pub(super) fn rank(&self) -> usize {
        self.vertical.ncols()
    }

    /// Their sum.
    pub(super) fn product(&self) -> Mat<f64> {
        self.vertical.as_ref() * self.horizontal.transpose()
    }

    /// What they leave of `s`.
    pub(super) fn residual(&self, s: &Mat<f64>) -> Mat<f64> {
        let mut rest = s.clone();
        let (v, h) = (self.vertical.as_ref(), self.horizontal.transpose());
        matmul(rest.as_mut(), Accum::Add, v, h, -1.0, Par::Seq);
        rest
    }

    /// All entries in one list: those of the vertical side, then of the horizontal one, column by
    /// column.
    pub(super) fn entries(&self) -> Vec<f64> {
        let columns = self.vertical.col_iter().chain(self.horizontal.col_iter());
        columns.flat_map(|column| column.iter().copied().collect::<Vec<_>>()).collect()
    }

    /// From [`Terms::entries`]; what is missing is 0.
    pub(super) fn of_entries(entries: &[f64], [ny, nx, rank]: [usize; 3]) -> Self {
        let at = |index: usize| entries.get(index).copied().unwrap_or(0.0);
        Self {
            vertical: Mat::from_fn(ny, rank, |i, m| at(m * ny + i)),
            horizontal: Mat::from_fn(nx, rank, |j, m| at(rank * ny + m * nx + j)),
        }
    }

    /// This kernel with orthogonal terms, largest first, shared evenly and signed by
    /// [`orient`]: what the singular value decomposition of the product would give.
    ///
    /// # Errors
    /// As [`thin_svd`].
    pub(super) fn orthogonal(&self, what: &str) -> Result<Self, LowRankError> {
        let v = thin_svd(self.vertical.as_ref(), what)?;
        let h = thin_svd(self.horizontal.as_ref(), what)?;
        let scaled = |svd: &ThinSvd| {
            let (rows, columns) = svd.right.shape();
            // diag(values) · rightᵀ
            Mat::from_fn(columns, rows, |i, j| {
                svd.values.get(i).map_or(0.0, |s| s * svd.right[(j, i)])
            })
        };
        let core = scaled(&v).as_ref() * scaled(&h).transpose();
        let core = thin_svd(core.as_ref(), what)?;
        let mut svd = ThinSvd {
            left: &v.left * &core.left,
            values: core.values,
            right: &h.left * &core.right,
        };
        canonical(&mut svd);
        let mut terms = Self::of_svd(&svd, svd.values.len().min(self.rank()));
        orient(&mut terms, None);
        Ok(terms)
    }

    /// Each term with both sides of one length, largest first; the terms themselves are kept.
    pub(super) fn balanced(&self) -> Self {
        let length =
            |side: &Mat<f64>, m: usize| side.as_ref().subcols(m, 1).squared_norm_l2().sqrt();
        let sizes: Vec<(f64, f64)> = (0..self.rank())
            .map(|m| (length(&self.vertical, m), length(&self.horizontal, m)))
            .collect();
        let mut order: Vec<usize> = (0..self.rank()).collect();
        let size = |m: &usize| sizes.get(*m).map_or(0.0, |(v, h)| v * h);
        order.sort_by(|a, b| size(b).total_cmp(&size(a)));
        let scaled = |side: &Mat<f64>, own: fn(&(f64, f64)) -> f64| {
            Mat::from_fn(side.nrows(), self.rank(), |i, k| {
                let Some(m) = order.get(k) else { return 0.0 };
                let own = sizes.get(*m).map_or(0.0, own);
                if own > 0.0 { side[(i, *m)] * (size(m).sqrt() / own) } else { 0.0 }
            })
        };
        Self {
            vertical: scaled(&self.vertical, |s| s.0),
            horizontal: scaled(&self.horizontal, |s| s.1),
        }
    }

    /// As they are given out.
    pub(super) fn named(&self, name: &str) -> ChannelFactors {
        ChannelFactors {
            name: name.into(),
            vertical: columns(self.vertical.as_ref()),
            horizontal: columns(self.horizontal.as_ref()),
        }
    }

    /// From what was given out; lists of other lengths than `ny` and `nx` are cut or filled with 0.
    pub(super) fn of(factors: &ChannelFactors, ny: usize, nx: usize) -> Self {
        let side = |lists: &[Vec<f64>], n: usize, rank: usize| {
            Mat::from_fn(n, rank, |i, m| {
                lists.get(m).and_then(|list| list.get(i)).copied().unwrap_or(0.0)
            })
        };
        let rank = factors.vertical.len().min(factors.horizontal.len());
        Self {
            vertical: side(&factors.vertical, ny, rank),
            horizontal: side(&factors.horizontal, nx, rank),
        }
    }
}

fn columns(matrix: MatRef<'_, f64>) -> Vec<Vec<f64>> {
    (0..matrix.ncols()).map(|m| matrix.col(m).iter().copied().collect()).collect()
}

/// Gives every term its sign.
///
/// The entries of a vertical factor sum to 0 or more; where they cancel (|Σv| ≤ 1e-9 Σ|v|) the
/// largest entry is positive, the first of several. With terms of another channel to compare with,
/// a term whose vertical factor lies within 60° of a line with that channel's same term points its
/// way instead, so that one feature has one sign in all channels.
pub(super) fn orient(terms: &mut Terms, like: Option<&Terms>) {
    for m in 0..terms.rank() {
        let vertical: Vec<f64> = terms.vertical.col(m).iter().copied().collect();
        let against = like.filter(|other| m < other.rank()).and_then(|other| {
            let other = other.vertical.col(m);
            let dot: f64 = vertical.iter().zip(other.iter()).map(|(a, b)| a * b).sum();
            let [own, theirs] = [&vertical, &other.iter().copied().collect::<Vec<_>>()]
                .map(|list| list.iter().map(|x| x * x).sum::<f64>());
            (dot.abs() > SAME_TERM * (own * theirs).sqrt()).then_some(dot < 0.0)
        });
        if against.unwrap_or_else(|| points_down(&vertical)) {
            for side in [&mut terms.vertical, &mut terms.horizontal] {
                side.col_mut(m).iter_mut().for_each(|entry| *entry = -*entry);
            }
        }
    }
}

fn points_down(vertical: &[f64]) -> bool {
    let sum: f64 = vertical.iter().sum();
    let total: f64 = vertical.iter().map(|v| v.abs()).sum();
    if sum.abs() > NO_SUM * total {
        return sum < 0.0;
    }
    let largest = vertical.iter().fold(0.0f64, |most, v| most.max(v.abs()));
    vertical.iter().find(|v| v.abs() >= (1.0 - AS_LARGE) * largest).is_some_and(|v| *v < 0.0)
}

/// Chooses the vectors that singular values leave open.
///
/// Values within 1e-12 of the largest of each other are taken as one repeated value, of which only
/// the space of the vectors is defined. Its basis is chosen from the space itself: the row in which
/// a unit left vector of the space can be largest (the first of several) gets that vector, and so
/// on in what is left. A value within rounding of 0 is set to 0, and its vectors with it.
pub(super) fn canonical(svd: &mut ThinSvd) {
    let largest = svd.values.first().copied().unwrap_or(0.0);
    let rounding = f64::EPSILON * svd.left.nrows().max(svd.right.nrows()) as f64 * largest;
    let count = svd.values.len();
    let kept = svd.values.iter().take_while(|s| **s > rounding).count();
    for m in kept..count {
        if let Some(value) = svd.values.get_mut(m) {
            *value = 0.0;
        }
        svd.left.col_mut(m).fill(0.0);
        svd.right.col_mut(m).fill(0.0);
    }
    let mut begin = 0;
    while begin < kept {
        let value = svd.values.get(begin).copied().unwrap_or(0.0);
        let same = |s: &&f64| value - **s <= REPEATED * largest;
        let size = svd.values.iter().take(kept).skip(begin).take_while(same).count().max(1);
        if size > 1 {
            choose_basis(svd, begin, size);
        }
        begin += size;
    }
}

fn choose_basis(svd: &mut ThinSvd, begin: usize, size: usize) {
    let left = svd.left.as_ref().subcols(begin, size).to_owned();
    let right = svd.right.as_ref().subcols(begin, size).to_owned();
    let mut rows = left.clone();
    for k in 0..size {
        let lengths: Vec<f64> =
            (0..rows.nrows()).map(|i| rows.as_ref().subrows(i, 1).squared_norm_l2()).collect();
        let most = lengths.iter().copied().fold(0.0, f64::max);
        let Some(pivot) = lengths.iter().position(|l| *l >= (1.0 - 1e-6) * most) else { return };
        let root = lengths.get(pivot).map_or(0.0, |l| l.sqrt());
        if root == 0.0 {
            return;
        }
        let weights = Mat::from_fn(size, 1, |c, _| rows[(pivot, c)] / root);
        let (new_left, new_right) = (&left * &weights, &right * &weights);
        svd.left.col_mut(begin + k).copy_from(new_left.col(0));
        svd.right.col_mut(begin + k).copy_from(new_right.col(0));
        let along = &rows * &weights;
        rows =
            Mat::from_fn(rows.nrows(), size, |i, c| rows[(i, c)] - along[(i, 0)] * weights[(c, 0)]);
    }
}
