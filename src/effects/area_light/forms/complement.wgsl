// uses: band_phase

// The band integral, of either sign: up to one period the rule, beyond it the complement H, of which
// `excess` gives H(u) - 1 / (u + shift).
fn sinc_squared_band(x0: f32, x1: f32) -> f32 {
    let width = x1 - x0;
    if abs(width) <= TURN {
        return width * mean_sinc_squared(middle_of(x0, x1), 0.5 * width);
    }
    let near = min(abs(x0), abs(x1));
    let far = max(abs(x0), abs(x1));
    let near_part = 1.0 / (near + shift);
    let far_part = 1.0 / (far + shift);
    let near_excess = excess(min(near, LAST_PHASE));
    let far_excess = excess(min(far, LAST_PHASE));
    // 1/a - 1/b as (b - a) / b / a, so that far lobes keep their digits; in this order nothing overflows.
    let one_sided = abs(width) * far_part * near_part + (near_excess - far_excess);
    let across = HALF_TURN - (near_part + far_part) - (near_excess + far_excess);
    return 2.0 * sign(width) * select(across, one_sided, sign(x0) * sign(x1) > 0.0);
}
