// approximates: footprint_coverage
// about: velinov2018 eq. 18 as printed: the contained length
// cites: velinov2018 eq. 18
// uses: chord

// velinov2018 eq. 18 over its own prefactor sqrt(2 pi) sigma W / A_C: sqrt(2 pi) sigma l / A_P, the limit of the
// mean of exp(-s^2/2) for large footprints, whatever their size.

const ROOT_EIGHT_OVER_PI: f32 = 1.5957691216057308;

fn footprint_coverage(h: f32, s: f32) -> f32 {
    return ROOT_EIGHT_OVER_PI * chord(h, s);
}
