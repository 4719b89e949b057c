// uses: covered

// Gauss-Legendre, Abramowitz & Stegun, table 25.4, over what the light covers of |ks xi_1| < REACH.
const REACH: f32 = 2.0;
const NODE_COUNT: u32 = 3u;
const NODES = array<f32, 3>(-0.7745966692, 0.0, 0.7745966692);
const WEIGHTS = array<f32, 3>(0.5555555556, 0.8888888889, 0.5555555556);
