// approximates: footprint_coverage
// about: eq. 18 with the correction of eq. 16 for small footprints
// cites: velinov2018 eq. 18, corrected as eq. 16
// uses: chord

// velinov2018 eq. 18 with the correction for small footprints that eq. 16 has: blended by alpha = A_P / (2 A_C) with
// the value of eq. 17 at the centre of the footprint.

const ROOT_EIGHT_OVER_PI: f32 = 1.5957691216057308;

fn footprint_coverage(h: f32, s: f32, area_ratio: f32) -> f32 {
    let alpha = min(0.5 * area_ratio, 1.0);
    return alpha * ROOT_EIGHT_OVER_PI * chord(h, s) + (1.0 - alpha) * exp(-0.5 * s * s);
}
