// approximates: footprint_response
// about: velinov2018 eq. 16 with the factor pi that its second term lacks: chord and centre value blended by
//     A_P/A_C
// cites: velinov2018 eq. 16, corrected
// uses: chord

// velinov2018 eq. 16 over 2 A_C, with the factor pi that its second term lacks in print: for an empty footprint
// alpha is 0 and eq. 10 must come back. alpha = A_P / (2 A_C), 1 at most.

const TWO_OVER_ROOT_PI: f32 = 1.1283791670955126;

fn footprint_response(h: f32, s: f32, area_ratio: f32) -> f32 {
    let alpha = min(0.5 * area_ratio, 1.0);
    return alpha * TWO_OVER_ROOT_PI * chord(h, s) + (1.0 - alpha) * exp(-s * s);
}
