const TURN: f32 = 6.283185307179586;
const TURNS_PER_RADIAN: f32 = 0.15915494309189535;
// 2 pi in two parts (Cody & Waite): the first has 8 bits, so that its product with up to 65535
// turns is exact and the reduction holds to 4e-7 for every phase up to 1e5.
const TURN_HIGH: f32 = 6.28125;
const TURN_LOW: f32 = 0.0019353071795864769;

// Cosine and sine of u >= 0, error below 4e-7 up to u = 1e5: WGSL promises nothing outside
// [-pi, pi] for its own.
fn cosine_and_sine(u: f32) -> vec2<f32> {
    let turns = round(u * TURNS_PER_RADIAN);
    let r = (u - turns * TURN_HIGH) - turns * TURN_LOW;
    let magnitude = abs(r);
    // p = pi/2 - |r|: cos u = sin p, and |sin u| = cos p, whose zeros |r| (pi - |r|) carries.
    let p = 0.25 * TURN - magnitude;
    let z = p * p;
    // sin p on [-pi/2, pi/2], maximal error 3.3e-9 at its ends.
    let cosine = p * (0.99999997659 + z * (-0.16666647635
        + z * (0.0083328998221 + z * (-0.00019800897683 + z * 2.5904883e-6))));
    // cos p on [-pi/2, pi/2], maximal error 5.3e-8 near p = 1.3.
    let sine = r * (0.5 * TURN - magnitude) * (0.40528471324
        + z * (-0.038386236678 + z * (0.0013281640 - z * 2.3113763e-5)));
    return vec2<f32>(cosine, sine);
}
