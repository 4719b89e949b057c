// approximates: scratch_density
// function: infinite_density
// about: infinite scratch
// cites: velinov2018 eq. 17, second line
// uses: lobe

// rho_c of eq. 17, second line: an infinite scratch.
fn infinite_density(width_um: f32, sigma_um: f32, offset_um: f32) -> f32 {
    return 0.7978845608 * width_um / sigma_um * gaussian(0.7071067812 * offset_um / sigma_um);
}
