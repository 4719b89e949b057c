// approximates: fresnel_conductor
// function: rational_tied
// about: the same with c tied to a and b
// cites: striae, from the high-index limit of the conductor formulas

// As `rational`, with its third constant tied to the other two: over every measured material
// c stays close to 11/4 b - 2a - 3. c is not negative, and b > -1: no pole. A compiler folds c.
override a: f32 = -2.0;
override b: f32 = 4.0;

fn rational_tied(mu: f32, f_normal: f32) -> f32 {
    let c = max(2.75 * b - 2.0 * a - 3.0, 0.0);
    let grazing = 1.0 - mu;
    let shape = (1.0 + a * mu) / (1.0 + mu * (b + c * mu));
    return f_normal + (1.0 - f_normal) * (grazing * grazing * shape);
}
