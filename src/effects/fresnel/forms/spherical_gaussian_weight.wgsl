// approximates: schlick_weight
// function: spherical_gaussian_weight
// about: the spherical Gaussian alone, in place of (1 - mu)^5
// cites: Karis, Real Shading in Unreal Engine 4, SIGGRAPH course 2013

// Karis 2013: a stand-in for Schlick's weight (1 - mu)^5, with the printed constants
// a = -5.55473, b = 6.98316. At mu = 1 it leaves 2^(a - b) = 1.7e-4 where the weight is 0.
override a: f32 = -5.55473;
override b: f32 = 6.98316;

fn spherical_gaussian_weight(mu: f32) -> f32 {
    return exp2((a * mu - b) * mu);
}
