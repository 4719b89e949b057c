//! One trial run of every kernel before the timing begins.
//!
//! A driver may need minutes for a text that naga accepts, in the call that makes the pipeline or
//! in the first dispatch, and neither can be called off. The trial therefore runs on threads
//! with devices of their own, which are left behind if a kernel takes longer than the limit.

use super::clock::Stopwatch;
use super::item::Item;
use super::{Device, GpuError, TimingOptions};
use crate::gpu::program::Program;
use rayon::prelude::*;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// A kernel to time, with the columns of its inputs.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    pub(super) program: Program,
    pub(super) inputs: Vec<Vec<u32>>,
}

impl Candidate {
    /// The kernel with the first row of its inputs.
    pub(super) fn with_one_row(&self) -> Self {
        let first = |column: &Vec<u32>| column.iter().copied().take(1).collect();
        let inputs = self.inputs.iter().map(first).collect();
        Self { program: self.program.clone(), inputs }
    }
}

/// Whether a kernel can be timed, else the reason why not.
type Verdict = Result<(), String>;

/// Most devices on trial at a time.
const MOST_DEVICES: usize = 4;

/// Compiles and runs each of `candidates` once; one verdict each, in their order.
pub(super) fn verdicts(candidates: &[Candidate], options: &TimingOptions) -> Vec<Verdict> {
    // A driver compiles on the thread that asks, so that a share of them on each is done sooner.
    let threads = rayon::current_num_threads().clamp(1, MOST_DEVICES);
    let shares = candidates.par_chunks(candidates.len().div_ceil(threads).max(1));
    shares.flat_map_iter(|share| verdicts_in_turn(share, options)).collect()
}

fn verdicts_in_turn(candidates: &[Candidate], options: &TimingOptions) -> Vec<Verdict> {
    // NaN and negative numbers give no time at all, infinity all there is.
    let limit = Duration::try_from_secs_f64(options.compile_limit_s.max(0.0));
    collect(candidates.len(), limit.unwrap_or(Duration::MAX), |first| {
        let (sender, receiver) = channel();
        let rest = candidates.get(first..).unwrap_or_default().to_vec();
        let options = options.clone();
        // Without a thread the sender is dropped, and the receiver learns of that.
        let _ = std::thread::Builder::new().spawn(move || work(&rest, &options, &sender));
        receiver
    })
}

/// Takes `count` verdicts from workers. `start` begins one with the candidate of that index; it
/// ends after a verdict against a candidate, and is given up when it takes longer than `limit`.
fn collect(
    count: usize,
    limit: Duration,
    start: impl Fn(usize) -> Receiver<Verdict>,
) -> Vec<Verdict> {
    let mut verdicts = Vec::with_capacity(count);
    while verdicts.len() < count {
        let receiver = start(verdicts.len());
        while verdicts.len() < count {
            let verdict = receiver.recv_timeout(limit).unwrap_or_else(|error| {
                Err(match error {
                    RecvTimeoutError::Timeout => format!(
                        "the device did not compile and run it once within {:?} s",
                        limit.as_secs_f64()
                    ),
                    RecvTimeoutError::Disconnected => "its trial run broke off".to_owned(),
                })
            });
            let fresh = verdict.is_err();
            verdicts.push(verdict);
            if fresh {
                break;
            }
        }
    }
    verdicts
}

fn work(candidates: &[Candidate], options: &TimingOptions, verdicts: &Sender<Verdict>) {
    let device = match Device::open() {
        Ok(device) => device,
        Err(error) => {
            // Nobody listens any more once the limit has passed.
            let _ = verdicts.send(Err(error.to_string()));
            return;
        }
    };
    for candidate in candidates {
        let outcome = attempt(&device, candidate, options);
        if matches!(outcome, Err(GpuError::TimedOut(_))) {
            // wgpu panics when a device is dropped while a kernel still runs.
            std::mem::forget(device);
            return;
        }
        let failed = outcome.is_err();
        let gone = verdicts.send(outcome.map_err(|error| error.to_string())).is_err();
        if failed || gone {
            return;
        }
    }
}

fn attempt(
    device: &Device,
    candidate: &Candidate,
    options: &TimingOptions,
) -> Result<(), GpuError> {
    let stopwatch = Stopwatch::new(device)?;
    let item = Item::new(device, &stopwatch.sums, &candidate.program, &candidate.inputs, options)?;
    stopwatch.durations(device, &[&item]).map(|_| ())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;

    /// Of four kernels one never ends and one is refused: the others are still tried.
    #[test]
    fn a_kernel_that_does_not_end_stops_no_other() {
        let busy = RefCell::new(Vec::new());
        let starts = RefCell::new(Vec::new());
        let verdicts = collect(4, Duration::from_millis(20), |first| {
            starts.borrow_mut().push(first);
            let (sender, receiver) = channel();
            for index in first..4 {
                match index {
                    1 => {
                        busy.borrow_mut().push(sender);
                        return receiver;
                    }
                    2 => {
                        let _ = sender.send(Err("refused".to_owned()));
                        return receiver;
                    }
                    _ => {
                        let _ = sender.send(Ok(()));
                    }
                }
            }
            receiver
        });
        assert_eq!(starts.into_inner(), [0, 2, 3]);
        let late = "the device did not compile and run it once within 0.02 s".to_owned();
        assert_eq!(verdicts, [Ok(()), Err(late), Err("refused".to_owned()), Ok(())]);
    }

    #[test]
    fn a_worker_that_breaks_off_is_a_reason() {
        let verdicts = collect(2, Duration::from_secs(1), |_| channel().1);
        assert_eq!(verdicts, vec![Err("its trial run broke off".to_owned()); 2]);
    }
}
