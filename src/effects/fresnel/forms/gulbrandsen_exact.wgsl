// approximates: fresnel_conductor
// function: gulbrandsen_exact
// about: reflectivity and edge tint to n and k, conductor formulas in full
// cites: Gulbrandsen, Artist friendly metallic Fresnel, JCGT 3(4), 2014; Born & Wolf 14.2

// Gulbrandsen 2014's map from r and g to n and k^2, followed by the conductor formulas without
// approximation: on a single wavelength nothing is left to fit but g.
override g: f32 = 0.5;

fn gulbrandsen_exact(mu: f32, f_normal: f32) -> f32 {
    let r = clamp(f_normal, 0.0, 0.99);
    let root = sqrt(r);
    let n_least = (1.0 - r) / (1.0 + r);
    let n_most = (1.0 + root) / (1.0 - root);
    let n = n_least * g + (1.0 - g) * n_most;
    let k_square = max(((n + 1.0) * (n + 1.0) * r - (n - 1.0) * (n - 1.0)) / (1.0 - r), 0.0);

    let mu_square = mu * mu;
    let s_square = 1.0 - mu_square;
    let real = n * n - k_square - s_square;
    let modulus = sqrt(real * real + 4.0 * n * n * k_square);
    let w = sqrt(max(0.5 * (modulus + real), 0.0));
    let cross = 2.0 * w * mu;
    let r_s = (modulus - cross + mu_square) / (modulus + cross + mu_square);
    let even = mu_square * modulus + s_square * s_square;
    let odd = cross * s_square;
    return 0.5 * r_s * (1.0 + (even - odd) / (even + odd));
}
