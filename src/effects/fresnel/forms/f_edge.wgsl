// approximates: fresnel_conductor
// over: fresnel_materials
// function: f_edge
// about: Lazanyi with alpha = 6, exact at 82 degrees; nothing free
// cites: Hoffman, Fresnel equations considered harmful, 2019

// Hoffman 2019: the error term of Lazanyi with alpha = 6 and the depth that makes the form exact
// at mu = 1/7 (82 degrees), where the reflectance `f_edge` is given. Nothing is fitted.

// Schlick's weight at mu = 1/7: (6/7)^5.
const WEIGHT_EDGE: f32 = 0.4626643660;
// 1 over mu (1 - mu)^6 at mu = 1/7: 7^7 / 6^6.
const SCALE_EDGE: f32 = 17.651384;

fn f_edge(mu: f32, f_normal: f32, f_edge: f32) -> f32 {
    let grazing = 1.0 - mu;
    let square = grazing * grazing;
    let fourth = square * square;
    let depth = (f_normal + (1.0 - f_normal) * WEIGHT_EDGE - f_edge) * SCALE_EDGE;
    return f_normal + (1.0 - f_normal) * (fourth * grazing) - depth * mu * (fourth * square);
}
