// approximates: fresnel_conductor
// over: fresnel_materials
// function: schlick
// about: fifth power of 1 - mu; nothing free
// cites: Schlick, Computer Graphics Forum 13(3), 1994, eq. 15

// Schlick 1994, eq. 15: the reflectance rises from its value at normal incidence to 1 with the
// fifth power of 1 - mu. Nothing is fitted.
fn schlick(mu: f32, f_normal: f32) -> f32 {
    let grazing = 1.0 - mu;
    let square = grazing * grazing;
    return f_normal + (1.0 - f_normal) * (square * square * grazing);
}
