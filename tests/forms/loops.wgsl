// Loops, arrays, a switch and a helper: a file for mutations.
const COEFFICIENTS = array<f32, 4>(1.0, -0.5, 0.25, -0.125);
override gain: f32 = 1.5;
override terms: u32 = 4u;

struct Sum {
    value: f32,
    count: i32,
}

fn term(x: f32, i: u32) -> f32 {
    if x < -3.0 {
        return 0.0;
    }
    return COEFFICIENTS[i] * pow(abs(x), f32(i));
}

fn f(x: f32) -> f32 {
    var sum: Sum;
    for (var i = 0u; i < terms; i++) {
        if i == 2u && x > 4.0 {
            continue;
        }
        sum.value += gain * term(x, i);
        sum.count += 1;
    }
    var a = vec3<f32>(x, x * x, 1.0);
    switch sum.count {
        case 3: {
            a.z = 2.0;
        }
        case 4, 5: {
            a = a.zyx;
        }
        default: {
            return 0.0;
        }
    }
    var k = 0;
    loop {
        k += 1;
        if k > 5 {
            break;
        }
        continuing {
            sum.value = sum.value * 0.5 + a[k % 3];
            break if sum.value > 100.0;
        }
    }
    while k > 0 {
        k -= 2;
    }
    return sum.value / (1.0 + length(a)) + f32(k);
}
