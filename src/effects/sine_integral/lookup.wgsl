// approximates: sine_integral
// about: table from the reference, linear between entries, asymptotic tail beyond
// cites: striae
// uses: phase

// Si(x) from a table of {{COUNT}} entries, linear between them, at u = 0 to u = {{LAST}} in equal
// steps; beyond, the first two terms of the asymptotic series, pi/2 - cos(u)/u - sin(u)/u^2.
//
// Error: h^2/8 max|Si''| = {{STEP_ERROR}} inside, h the step and max|Si''| = {{CURVATURE}} at u = 2.08,
// where the chord is furthest from the curve; 2/u^3 = {{TAIL_ERROR}} at most outside. {{LAST}} is where the
// two are about equal: finer steps over a shorter table would lose in the tail what they gain.

const HALF_PI: f32 = 1.5707963267948966;
const LAST: f32 = {{LAST}};
const STEPS: f32 = {{STEPS}}.0;
// Past it, where the tail is below 1e-6, the phase stands still; no overflow, no NaN at infinity.
const LAST_PHASE: f32 = 1e6;

const ENTRIES = array<f32, {{COUNT}}>(
{{ENTRIES}}
);

fn sine_integral(x: f32) -> f32 {
    let u = min(abs(x), LAST_PHASE);
    if u < LAST {
        let place = u * (STEPS / LAST);
        let index = min(u32(place), {{LAST_SEGMENT}}u);
        return sign(x) * mix(ENTRIES[index], ENTRIES[index + 1u], place - f32(index));
    }
    let wave = cosine_and_sine(u);
    return sign(x) * (HALF_PI - (wave.x + wave.y / u) / u);
}
