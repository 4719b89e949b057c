// approximates: footprint_response
// about: eq. 16 with another blending factor of A_P/A_C, 1 constant
// cites: striae
// uses: chord

// The two terms of eq. 16 with another blending factor of the same argument: r^2 / (r^2 + half_way), r = A_P / A_C.

const TWO_OVER_ROOT_PI: f32 = 1.1283791670955126;

override half_way: f32 = 2.227652;

fn footprint_response(h: f32, s: f32, area_ratio: f32) -> f32 {
    let growth = area_ratio * area_ratio;
    let alpha = growth / (growth + half_way);
    return alpha * TWO_OVER_ROOT_PI * chord(h, s) + (1.0 - alpha) * exp(-s * s);
}
