// uses: hermite

// Abramowitz & Stegun, table 25.10.
const NODE_COUNT: u32 = 3u;
const NODES = array<f32, 3>(-1.224744871, 0.0, 1.224744871);
const WEIGHTS = array<f32, 3>(0.2954089752, 1.181635901, 0.2954089752);
