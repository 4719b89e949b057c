// approximates: footprint_end
// about: eq. 16 with the part of the chord past the end
// cites: velinov2018 eq. 16, corrected
// uses: chord

// A scratch that begins inside the footprint as velinov2018 has it: eq. 16 with its factor pi, and in l_contained
// the part of the chord past the end. The second term of eq. 16 knows no end.

const TWO_OVER_ROOT_PI: f32 = 1.1283791670955126;

fn footprint_end(half_extent: f32, half_length: f32, shear: f32, offset: f32, end: f32) -> f32 {
    let alpha = min(0.5 * half_extent * half_length, 1.0);
    let across = clamp(offset / max(half_extent, 1e-15), -1.0, 1.0);
    let half_chord = half_length * sqrt((1.0 - across) * (1.0 + across));
    let past_end = shear * across + half_chord - end;
    let contained = clamp(past_end / max(2.0 * half_chord, 1e-15), 0.0, 1.0);
    let inside = TWO_OVER_ROOT_PI * chord(half_extent, offset) * contained;
    return alpha * inside + (1.0 - alpha) * exp(-offset * offset);
}
