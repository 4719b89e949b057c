// uses: covered

// Gauss-Legendre, Abramowitz & Stegun, table 25.4, over what the light covers of |ks xi_1| < REACH.
const REACH: f32 = 2.5;
const NODE_COUNT: u32 = 5u;
const NODES = array<f32, 5>(-0.9061798459, -0.5384693101, 0.0, 0.5384693101, 0.9061798459);
const WEIGHTS = array<f32, 5>(0.2369268851, 0.4786286705, 0.5688888889, 0.4786286705, 0.2369268851);
