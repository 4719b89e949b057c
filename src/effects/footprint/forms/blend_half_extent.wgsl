// approximates: footprint_response
// about: eq. 16 blended by the half-extent across the scratch, 1 constant
// cites: striae
// uses: chord

// The two terms of eq. 16, blended by the half-extent of the footprint across the scratch, on which alone the
// exact mean depends; the area is not needed.

const TWO_OVER_ROOT_PI: f32 = 1.1283791670955126;

override half_way: f32 = 0.9096324;

fn footprint_response(h: f32, s: f32) -> f32 {
    let growth = h * h;
    let alpha = growth / (growth + half_way);
    return alpha * TWO_OVER_ROOT_PI * chord(h, s) + (1.0 - alpha) * exp(-s * s);
}
