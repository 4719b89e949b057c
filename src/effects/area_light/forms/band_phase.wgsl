const TURN: f32 = 6.283185307179586;
const TURNS_PER_RADIAN: f32 = 0.15915494309189535;
// 2 pi in two parts (Cody & Waite): the first has 8 bits, so that its product with up to 65535
// turns is exact, and bounds next to the zero 2 pi n keep their distance from it.
const TURN_HIGH: f32 = 6.28125;
const TURN_LOW: f32 = 0.0019353071795864769;
// Past it, where what follows it is below 1e-12, the phase stands still; nothing overflows.
const LAST_PHASE: f32 = 1e6;

// The middle of a band, and how far it is from the nearest zero of the sine of half of it.
struct Middle {
    at: f32,
    phase: f32,
    // The nearest zero is that at 0, where sinc is 1.
    central: bool,
}

fn middle_of(x0: f32, x1: f32) -> Middle {
    let at = 0.5 * x0 + 0.5 * x1;
    let turns = round(at * TURNS_PER_RADIAN);
    let high = turns * TURN_HIGH;
    let phase = (0.5 * (x0 - high) + 0.5 * (x1 - high)) - turns * TURN_LOW;
    // Where turns are too many to be told apart the phase is anything; it stays in its range.
    return Middle(at, clamp(phase, -0.5 * TURN, 0.5 * TURN), turns == 0.0);
}
