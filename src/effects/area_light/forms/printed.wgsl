// The band integral by velinov2018 eq. 27 as printed, without the factors outside its brackets: the
// difference of 2 Si(x) - 4 sin^2(x/2) / x, x = k W q, at the two bounds, with a form of Si that is
// appended to this text. Far from 0 both are close to +-pi, and what they differ by is lost.

// The smallest normal number: below it sin^2 is 0, and 0/0 would be the value at q = 0.
const SMALLEST: f32 = 1.17549435e-38;

fn printed_primitive(x: f32) -> f32 {
    let sine = sin(0.5 * x);
    return 2.0 * sine_integral(x) - 4.0 * (sine * sine) / select(x, 1.0, abs(x) < SMALLEST);
}

fn sinc_squared_band(x0: f32, x1: f32) -> f32 {
    return printed_primitive(x1) - printed_primitive(x0);
}
