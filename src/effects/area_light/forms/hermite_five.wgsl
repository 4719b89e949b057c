// uses: hermite

// Abramowitz & Stegun, table 25.10.
const NODE_COUNT: u32 = 5u;
const NODES = array<f32, 5>(-2.02018287, -0.9585724646, 0.0, 0.9585724646, 2.02018287);
const WEIGHTS = array<f32, 5>(0.01995324206, 0.3936193232, 0.9453087205, 0.3936193232, 0.01995324206);
