// Fresnel by a spherical Gaussian: B. Karis, "Real Shading in Unreal Engine 4" (SIGGRAPH 2013
// course notes), eq. 5. One exp2 in place of Schlick's fifth power.
override a: f32 = -5.55473;
override b: f32 = 6.98316;
override f_normal: f32 = 0.0;

// Stands for (1 − mu)⁵.
fn fresnel_weight(mu: f32) -> f32 {
    return exp2((a * mu - b) * mu);
}

// Reflectance of a surface that reflects f_normal at normal incidence.
fn reflectance(mu: f32) -> f32 {
    return f_normal + (1.0 - f_normal) * fresnel_weight(mu);
}
