// approximates: footprint_response
// about: velinov2018 eq. 16 as printed
// cites: velinov2018 eq. 16
// uses: chord

// velinov2018 eq. 16 as printed, over 2 A_C = 2 pi sigma^2. Its first term is
//   alpha sigma sqrt(pi) l / A_P = alpha 2/sqrt(pi) sqrt(h^2 - s^2) / h^2;
// the second lacks a factor pi.

const TWO_OVER_ROOT_PI: f32 = 1.1283791670955126;
const ONE_OVER_PI: f32 = 0.3183098861837907;

fn footprint_response(h: f32, s: f32, area_ratio: f32) -> f32 {
    let alpha = min(0.5 * area_ratio, 1.0);
    return alpha * TWO_OVER_ROOT_PI * chord(h, s) + (1.0 - alpha) * ONE_OVER_PI * exp(-s * s);
}
