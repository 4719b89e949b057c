// approximates: scratch_pair_reflectance
// function: coherent_pair
// about: mutual interference kept: the reference in f32
// cites: velinov2018 eq. 2, 8
// uses: amplitude

// Two infinite scratches with mutual interference, the depth phase at their angles: the reference
// itself, in f32.
fn coherent_pair(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, mu_sum: f32, second_width_um: f32, second_depth_um: f32,
    second_offset_um: f32, turn_rad: f32) -> f32 {
    let across = xi_across * cos(turn_rad) - xi_along * sin(turn_rad);
    let along = xi_along * cos(turn_rad) + xi_across * sin(turn_rad);
    let sum = lobe_amplitude(width_um, wavelength_um, sigma_um, xi_along, xi_across, offset_um,
            depth_um, mu_sum)
        + lobe_amplitude(second_width_um, wavelength_um, sigma_um, along, across, second_offset_um,
            second_depth_um, mu_sum);
    return dot(sum, sum);
}
