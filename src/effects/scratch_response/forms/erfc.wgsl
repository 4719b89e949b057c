// erfc x for x >= 0, relative error 1.2e-7: Press et al., Numerical Recipes, erfcc.
fn complementary_error(x: f32) -> f32 {
    let t = 1.0 / (1.0 + 0.5 * x);
    let series = 1.00002368 + t * (0.37409196 + t * (0.09678418 + t * (-0.18628806
        + t * (0.27886807 + t * (-1.13520398 + t * (1.48851587 + t * (-0.82215223
        + t * 0.17087277)))))));
    return t * exp(-x * x - 1.26551223 + t * series);
}

// (erf(to) - erf(from))/2 for from <= to, by the tails where both lie on one side.
fn inside(from_end: f32, to_end: f32) -> f32 {
    let near = complementary_error(abs(from_end));
    let far = complementary_error(abs(to_end));
    let apart = select(abs(near - far), 2.0 - near - far, from_end < 0.0 && to_end > 0.0);
    return 0.5 * apart;
}
