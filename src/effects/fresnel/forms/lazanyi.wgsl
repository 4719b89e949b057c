// approximates: fresnel_conductor
// function: lazanyi
// about: Schlick less an error term a mu (1 - mu)^alpha
// cites: Lazanyi & Szirmay-Kalos, Fresnel term approximations for metals, WSCG 2005

// Lazanyi & Szirmay-Kalos 2005: Schlick's form less an error term a mu (1 - mu)^alpha, which
// carves the dip that metals have before grazing.
override a: f32 = 0.5;
override alpha: f32 = 6.0;

fn lazanyi(mu: f32, f_normal: f32) -> f32 {
    let grazing = 1.0 - mu;
    let square = grazing * grazing;
    let schlick = f_normal + (1.0 - f_normal) * (square * square * grazing);
    return schlick - a * mu * pow(grazing, alpha);
}
