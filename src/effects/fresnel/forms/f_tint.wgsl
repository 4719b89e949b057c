// approximates: fresnel_conductor
// function: f_tint
// about: Lazanyi with alpha = 6 and a tint of the value at 82 degrees
// cites: Hoffman, Fresnel equations considered harmful, 2019; Kutz, Hasan & Edmondson, Novel aspects of the
//     Adobe Standard Material, 2021

// Hoffman's F82 in the tint form of Kutz, Hasan & Edmondson 2021: the error term of Lazanyi with
// alpha = 6, whose dip is deepest at mu = 1/7 (82 degrees). There the form is `tint` times
// Schlick's value.
override tint: f32 = 1.0;

// Schlick's weight at mu = 1/7: (6/7)^5.
const WEIGHT_EDGE: f32 = 0.4626643660;
// 1 over mu (1 - mu)^6 at mu = 1/7: 7^7 / 6^6.
const SCALE_EDGE: f32 = 17.651384;

fn f_tint(mu: f32, f_normal: f32) -> f32 {
    let grazing = 1.0 - mu;
    let square = grazing * grazing;
    let fourth = square * square;
    let edge = f_normal + (1.0 - f_normal) * WEIGHT_EDGE;
    let depth = (1.0 - tint) * SCALE_EDGE * edge;
    return f_normal + (1.0 - f_normal) * (fourth * grazing) - depth * mu * (fourth * square);
}
