// approximates: scratch_density
// function: finite_density
// about: finite scratch by real error functions
// cites: velinov2018 eq. 17, first line
// uses: infinite_density, erfc

// rho_c of eq. 17, first line, of a finite scratch by real error functions.
fn finite_density(width_um: f32, sigma_um: f32, offset_um: f32, begin_um: f32, end_um: f32) -> f32 {
    let share = 0.7071067812 / sigma_um;
    return infinite_density(width_um, sigma_um, offset_um) * inside(share * begin_um, share * end_um);
}
