// approximates: fresnel_conductor
// function: schlick_exponent
// about: Schlick with the power fitted
// cites: after Schlick 1994

// Schlick's form with the power left open. It has no dip, whatever the power.
override exponent: f32 = 5.0;

fn schlick_exponent(mu: f32, f_normal: f32) -> f32 {
    return f_normal + (1.0 - f_normal) * pow(1.0 - mu, exponent);
}
