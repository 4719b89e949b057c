// approximates: fresnel_conductor
// function: rational
// about: (1 - mu)^2 (1 + a mu)/(1 + b mu + c mu^2): one division, no power
// cites: striae, from the high-index limit of the conductor formulas

// The reflectance leaves its value at normal incidence with the square of 1 - mu, because the
// first-order changes of the two polarisations cancel, and reaches 1 at grazing. In the limit of
// a high index what multiplies the square is a ratio of polynomials in mu; these are the lowest
// degrees that follow every measured metal and glass. While b^2 < 4 c there is no pole.
override a: f32 = -3.0;
override b: f32 = 3.0;
override c: f32 = 10.0;

fn rational(mu: f32, f_normal: f32) -> f32 {
    let grazing = 1.0 - mu;
    let shape = (1.0 + a * mu) / (1.0 + mu * (b + c * mu));
    return f_normal + (1.0 - f_normal) * (grazing * grazing * shape);
}
