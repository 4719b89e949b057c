// Gauss-Legendre, Abramowitz & Stegun, table 25.4, over what the light covers of |ks xi_1| < REACH.
const REACH: f32 = 3.0;
const NODE_COUNT: u32 = 7u;
const NODES = array<f32, 7>(-0.9491079123, -0.7415311856, -0.4058451514, 0.0, 0.4058451514, 0.7415311856, 0.9491079123);
const WEIGHTS = array<f32, 7>(0.1294849662, 0.2797053915, 0.3818300505, 0.4179591837, 0.3818300505, 0.2797053915, 0.1294849662);
