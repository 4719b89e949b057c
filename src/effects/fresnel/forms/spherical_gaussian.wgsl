// approximates: fresnel_conductor
// function: spherical_gaussian
// about: Schlick with a spherical Gaussian for the power
// cites: Karis, Real Shading in Unreal Engine 4, SIGGRAPH course 2013

// Karis 2013: Schlick's form with a spherical Gaussian for its weight. Fitted to a metal, the two
// constants move the knee and its steepness.
override a: f32 = -5.55473;
override b: f32 = 6.98316;

fn spherical_gaussian(mu: f32, f_normal: f32) -> f32 {
    return f_normal + (1.0 - f_normal) * exp2((a * mu - b) * mu);
}
