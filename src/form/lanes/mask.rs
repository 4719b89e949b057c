//! Execution masks: which lanes of a chunk are active.

use super::LANES;

/// One truth value per lane. Lanes beyond the chunk's length are never active.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mask {
    lanes: [bool; LANES],
}

impl Mask {
    /// No lane.
    pub(crate) const NONE: Self = Self { lanes: [false; LANES] };

    /// The first `count` lanes.
    pub(crate) fn first(count: usize) -> Self {
        let mut mask = Self::NONE;
        mask.lanes.iter_mut().take(count).for_each(|lane| *lane = true);
        mask
    }

    /// The first `count` lanes as a slice.
    pub(crate) fn lanes(&self, count: usize) -> &[bool] {
        &self.lanes[..count.min(LANES)]
    }

    /// True if any lane is active.
    pub(crate) fn any(&self) -> bool {
        self.lanes.iter().fold(false, |any, &lane| any | lane)
    }

    /// True if each of the first `count` lanes is active.
    pub(crate) fn all(&self, count: usize) -> bool {
        self.lanes(count).iter().fold(true, |all, &lane| all & lane)
    }

    /// Lanes active here where `when` is true, and those where it is false.
    pub(crate) fn split(&self, when: &[bool]) -> (Self, Self) {
        let (mut yes, mut no) = (Self::NONE, Self::NONE);
        let parts = yes.lanes.iter_mut().zip(&mut no.lanes);
        for ((yes, no), (&lane, &when)) in parts.zip(self.lanes.iter().zip(when)) {
            *yes = lane & when;
            *no = lane & !when;
        }
        (yes, no)
    }

    /// Adds the lanes of `other`.
    pub(crate) fn join(&mut self, other: &Self) {
        self.lanes.iter_mut().zip(&other.lanes).for_each(|(lane, &other)| *lane |= other);
    }
}
