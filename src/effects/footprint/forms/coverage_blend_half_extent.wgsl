// approximates: footprint_coverage
// about: eq. 18 corrected by the half-extent across the scratch, 1 constant
// cites: striae
// uses: chord

// As coverage_blend_area.wgsl, blended by the half-extent of the footprint across the scratch.

const ROOT_EIGHT_OVER_PI: f32 = 1.5957691216057308;

override half_way: f32 = 1.8871517;

fn footprint_coverage(h: f32, s: f32) -> f32 {
    let growth = h * h;
    let alpha = growth / (growth + half_way);
    return alpha * ROOT_EIGHT_OVER_PI * chord(h, s) + (1.0 - alpha) * exp(-0.5 * s * s);
}
