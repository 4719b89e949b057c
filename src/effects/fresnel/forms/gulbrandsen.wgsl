// approximates: fresnel_conductor
// function: gulbrandsen
// about: reflectivity and edge tint to n and k, high-index conductor formulas, as listed
// cites: Gulbrandsen, Artist friendly metallic Fresnel, JCGT 3(4), 2014

// Gulbrandsen 2014, as in the paper's listing: reflectivity r and edge tint g give n and k^2, and
// the conductor formulas follow with |w| = |m|, Re w = n (the limit of a high index).
override g: f32 = 0.5;

fn gulbrandsen(mu: f32, f_normal: f32) -> f32 {
    let r = clamp(f_normal, 0.0, 0.99);
    let root = sqrt(r);
    let n_least = (1.0 - r) / (1.0 + r);
    let n_most = (1.0 + root) / (1.0 - root);
    let n = n_least * g + (1.0 - g) * n_most;
    let k_square = ((n + 1.0) * (n + 1.0) * r - (n - 1.0) * (n - 1.0)) / (1.0 - r);

    let modulus = n * n + k_square;
    let mu_square = mu * mu;
    let cross = 2.0 * n * mu;
    let r_s = (modulus - cross + mu_square) / (modulus + cross + mu_square);
    let r_p = (modulus * mu_square - cross + 1.0) / (modulus * mu_square + cross + 1.0);
    return 0.5 * (r_s + r_p);
}
