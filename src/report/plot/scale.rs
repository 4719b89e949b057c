//! Scales: how values are spaced along an axis, and where its ticks stand.

use crate::document::plot::{PlotAxis, Scale};

/// Values beyond this magnitude are treated as not finite: their differences would overflow.
const LARGEST: f64 = 1e150;

impl Scale {
    /// Position along the axis, up to shift and scale; none if the axis cannot show the value.
    pub(super) fn position(self, value: f64) -> Option<f64> {
        if value.is_nan() || value.abs() > LARGEST {
            return None;
        }
        match self {
            Self::Linear => Some(value),
            Self::Log => (value > 0.0).then(|| value.log10()),
            Self::SymLog { linear_below } => {
                let usable = linear_below > 0.0 && linear_below.is_finite();
                usable.then(|| value.signum() * (1.0 + value.abs() / linear_below).log10())
            }
        }
        .filter(|position| position.is_finite())
    }
}

/// The part of an axis that is shown, with its ticks.
#[derive(Debug, Clone)]
pub(super) struct Span {
    scale: Scale,
    first: f64,
    last: f64,
    /// Labelled ticks.
    pub(super) ticks: Vec<Tick>,
    /// Values of the ticks between them, on logarithmic axes.
    pub(super) minor: Vec<f64>,
    /// Whether the range asked for had to be ignored.
    pub(super) range_ignored: bool,
}

/// A labelled tick.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    /// Its value.
    pub(super) value: f64,
    /// Its label.
    pub(super) label: String,
}

impl Span {
    /// The span of `axis` that shows `values`, with about `wanted` labelled ticks. `margin` is
    /// left free at both ends, as a fraction of the whole.
    pub(super) fn new(
        axis: &PlotAxis,
        values: impl Iterator<Item = f64>,
        margin: f64,
        wanted: usize,
    ) -> Self {
        let scale = axis.scale;
        let asked = axis.range.map(|[first, last]| (scale.position(first), scale.position(last)));
        let (first, last, range_ignored) = match asked {
            Some((Some(first), Some(last))) if first < last => (first, last, false),
            other => {
                let (first, last) = fitting(values.filter_map(|v| scale.position(v)), margin);
                (first, last, other.is_some())
            }
        };
        let (ticks, minor) = match scale {
            Scale::Linear => (linear_ticks(first, last, wanted), Vec::new()),
            Scale::Log => log_ticks(first, last, wanted),
            Scale::SymLog { linear_below } => {
                (symlog_ticks(scale, linear_below, first, last, wanted), Vec::new())
            }
        };
        Self { scale, first, last, ticks, minor, range_ignored }
    }

    /// Where `value` stands, 0 at the first end and 1 at the last; none if it cannot be shown.
    pub(super) fn fraction(&self, value: f64) -> Option<f64> {
        Some((self.scale.position(value)? - self.first) / (self.last - self.first))
    }
}

/// The extent of `positions` with a margin, never empty.
fn fitting(positions: impl Iterator<Item = f64>, margin: f64) -> (f64, f64) {
    let (low, high) = positions
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    if low > high {
        return (0.0, 1.0);
    }
    let extent = high - low;
    // Values equal to within rounding would put the same label on every tick.
    if extent <= 1e-12 * low.abs().max(high.abs()) {
        let room = if low == 0.0 { 1.0 } else { 0.1 * low.abs() };
        return (low - room, high + room);
    }
    (low - margin * extent, high + margin * extent)
}

/// Multiples of 1, 2 or 5 times a power of ten.
fn linear_ticks(first: f64, last: f64, wanted: usize) -> Vec<Tick> {
    let rough = (last - first) / count_as_f64(wanted.max(2));
    let exponent = rough.log10().floor();
    let power = 10f64.powf(exponent);
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * power >= rough * 0.8).unwrap_or(10.0);
    let exponent = if factor == 10.0 { exponent + 1.0 } else { exponent };
    let step = factor * power;
    let from = (first / step - 1e-9).ceil();
    let to = (last / step + 1e-9).floor();
    let largest = first.abs().max(last.abs());
    let scientific = !(1e-3..1e5).contains(&largest);
    let mut ticks = Vec::new();
    let mut index = from;
    while index <= to && ticks.len() <= 4 * wanted {
        let value = index * step;
        ticks.push(Tick { value, label: linear_label(value, exponent, scientific) });
        index += 1.0;
    }
    ticks
}

/// A multiple of a step whose leading digit stands at `exponent`, with no digit too many.
fn linear_label(value: f64, exponent: f64, scientific: bool) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !scientific {
        let places = digits(-exponent);
        return format!("{value:.places$}");
    }
    let places = digits(value.abs().log10().floor() - exponent);
    let text = format!("{value:.places$e}");
    match text.split_once('e') {
        Some((mantissa, power)) if mantissa.contains('.') => {
            format!("{}e{power}", mantissa.trim_end_matches('0').trim_end_matches('.'))
        }
        _ => text,
    }
}

/// Powers of ten, thinned to about `wanted`; 1, 2 and 5 times them when few are in range.
fn log_ticks(first: f64, last: f64, wanted: usize) -> (Vec<Tick>, Vec<f64>) {
    let (from, to) = ((first - 1e-9).ceil(), (last + 1e-9).floor());
    let decades = to - from + 1.0;
    if last - first < 0.5 {
        // Less than half a decade: evenly spaced values read best.
        let ticks = linear_ticks(10f64.powf(first), 10f64.powf(last), wanted);
        return (ticks.into_iter().filter(|t| t.value > 0.0).collect(), Vec::new());
    }
    let multiples = |factors: &'static [f64]| {
        let mut values = Vec::new();
        let mut power = from - 1.0;
        while power <= to {
            for factor in factors {
                let position = power + factor.log10();
                if position >= first - 1e-9 && position <= last + 1e-9 {
                    values.push(factor * 10f64.powf(power));
                }
            }
            power += 1.0;
        }
        values
    };
    if decades < 3.0 {
        let mut ticks = multiples(&[1.0, 2.0, 5.0]);
        let mut between = multiples(&[3.0, 4.0, 6.0, 7.0, 8.0, 9.0]);
        if ticks.len() < 3 {
            ticks.append(&mut between);
            ticks.sort_by(f64::total_cmp);
        }
        let ticks = ticks.into_iter().map(|value| Tick { value, label: log_label(value) });
        return (ticks.collect(), between);
    }
    let stride = (decades / count_as_f64(wanted.max(2))).ceil().max(1.0);
    let mut ticks = Vec::new();
    let mut power = (from / stride).ceil() * stride;
    while power <= to {
        let value = 10f64.powf(power);
        ticks.push(Tick { value, label: log_label(value) });
        power += stride;
    }
    let minor = if stride > 1.0 {
        multiples(&[1.0])
    } else if decades <= 8.0 {
        multiples(&[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0])
    } else {
        Vec::new()
    };
    (ticks, minor)
}

/// 0, and powers of ten times ±`linear_below` and beyond.
fn symlog_ticks(scale: Scale, below: f64, first: f64, last: f64, wanted: usize) -> Vec<Tick> {
    let Some(lowest) = Some(below.log10().ceil()).filter(|p| p.is_finite()) else {
        return Vec::new();
    };
    let largest = first.abs().max(last.abs()) + below.log10();
    let both = if first < 0.0 && last > 0.0 { 2.0 } else { 1.0 };
    let stride = (both * (largest - lowest + 1.0) / count_as_f64(wanted.max(3))).ceil().max(1.0);
    let mut values = vec![0.0];
    // ±`linear_below` stands so close to 0 that their labels would touch.
    let mut power = if largest >= lowest + 1.0 { lowest + 1.0 } else { lowest };
    while power <= largest {
        values.push(10f64.powf(power));
        values.insert(0, -(10f64.powf(power)));
        power += stride;
    }
    let shown = |value: &f64| scale.position(*value).is_some_and(|p| p >= first && p <= last);
    let ticks = values.into_iter().filter(shown);
    ticks.map(|value| Tick { value, label: log_label(value) }).collect()
}

/// 0.001 to 1000 plain, 1e-6 and the like beyond.
fn log_label(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let text = format!("{value:.0e}");
    let plain = (1e-3 * 0.999..1e4).contains(&value.abs());
    text.parse::<f64>().map_or(text.clone(), |v| if plain { v.to_string() } else { text })
}

fn count_as_f64(count: usize) -> f64 {
    u32::try_from(count).map_or(f64::from(u32::MAX), f64::from)
}

/// A number of decimal places, from 0 to 17.
fn digits(places: f64) -> usize {
    (0..=17).find(|n| count_as_f64(*n) >= places).unwrap_or(17)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().map(|t| t.label.as_str()).collect()
    }

    #[test]
    fn linear_labels_carry_no_rounding() {
        let hundredths = ["-0.06", "-0.04", "-0.02", "0", "0.02", "0.04", "0.06"];
        assert_eq!(labels(&linear_ticks(-0.06, 0.06, 6)), hundredths);
        let tiny = ["-4e-8", "-2e-8", "0", "2e-8", "4e-8"];
        assert_eq!(labels(&linear_ticks(-5e-8, 5e-8, 5)), tiny);
        assert_eq!(labels(&linear_ticks(0.0, 1e6, 2)), ["0", "5e5", "1e6"]);
    }

    #[test]
    fn log_labels_are_powers_of_ten() {
        let (ticks, minor) = log_ticks(-7.2, -0.9, 8);
        assert_eq!(labels(&ticks), ["1e-7", "1e-6", "1e-5", "1e-4", "0.001", "0.01", "0.1"]);
        assert!(!minor.is_empty());
        let (ticks, _) = log_ticks(-300.0, 0.0, 6);
        assert!((4..=7).contains(&ticks.len()), "{ticks:?}");
        let (ticks, _) = log_ticks(0.3, 1.2, 6);
        assert_eq!(labels(&ticks), ["2", "5", "10"]);
        let (ticks, _) = log_ticks(-0.1, 0.65, 6);
        assert_eq!(labels(&ticks), ["0.8", "0.9", "1", "2", "3", "4"]);
    }

    #[test]
    fn values_that_an_axis_cannot_show_have_no_place() {
        assert_eq!(Scale::Log.position(0.0), None);
        assert_eq!(Scale::Log.position(-1.0), None);
        assert_eq!(Scale::Linear.position(f64::INFINITY), None);
        assert_eq!(Scale::SymLog { linear_below: 0.0 }.position(1.0), None);
        assert_eq!(Scale::SymLog { linear_below: 1.0 }.position(-9.0), Some(-1.0));
    }

    #[test]
    fn a_single_value_still_spans() {
        let span = Span::new(&PlotAxis::linear("v", "1"), [3.0].into_iter(), 0.05, 5);
        assert_eq!(span.fraction(3.0), Some(0.5));
        assert!(span.ticks.len() >= 2);
    }
}
