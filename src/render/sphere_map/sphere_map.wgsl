// Maps over the sphere in latitude-longitude format: looked up, turned, and convolved with taps.
//
// environment: R, G, B per texel, row by row from the zenith; layers one after the other.
// taps: per tap the direction in the frame (east, north, outwards) of a texel, then R, G, B weights.
// Constants of the pipeline: the size of the map, the number of taps, how many of them one
// evaluation takes, and the rows of a rotation.

@group(1) @binding(0) var<storage, read> environment: array<f32>;
@group(1) @binding(1) var<storage, read> taps: array<f32>;

override width: f32;
override height: f32;
override tap_count: f32;
override tap_block: f32;
override turn_xx: f32 = 1.0;
override turn_xy: f32 = 0.0;
override turn_xz: f32 = 0.0;
override turn_yx: f32 = 0.0;
override turn_yy: f32 = 1.0;
override turn_yz: f32 = 0.0;
override turn_zx: f32 = 0.0;
override turn_zy: f32 = 0.0;
override turn_zz: f32 = 1.0;

const PI = 3.14159265358979;

// A row beyond a pole goes on down the other side.
fn texel(column: i32, row: i32, layer: i32) -> vec3<f32> {
    let columns = i32(width);
    let rows = i32(height);
    var x = column;
    var y = row;
    if (y < 0) {
        y = -1 - y;
        x += columns / 2;
    }
    if (y >= rows) {
        y = 2 * rows - 1 - y;
        x += columns / 2;
    }
    // Lookups lie within one turn to either side.
    if (x < 0) {
        x += columns;
    }
    if (x >= columns) {
        x -= columns;
    }
    let at = u32(3 * ((layer * rows + y) * columns + x));
    return vec3<f32>(environment[at], environment[at + 1u], environment[at + 2u]);
}

fn radiance(direction: vec3<f32>, layer: i32) -> vec3<f32> {
    let across = sqrt(direction.x * direction.x + direction.y * direction.y);
    let x = atan2(direction.y, direction.x) * width / (2.0 * PI) - 0.5;
    let y = atan2(across, direction.z) * height / PI - 0.5;
    let left = floor(x);
    let top = floor(y);
    let u = x - left;
    let v = y - top;
    let column = i32(left);
    let row = i32(top);
    let upper = texel(column, row, layer) * (1.0 - u) + texel(column + 1, row, layer) * u;
    let lower = texel(column, row + 1, layer) * (1.0 - u) + texel(column + 1, row + 1, layer) * u;
    return upper * (1.0 - v) + lower * v;
}

// Azimuth and polar angle of the centre of a texel.
fn angles(column: f32, row: f32) -> vec2<f32> {
    return vec2<f32>(
        (column + 0.5) * 2.0 * PI / width,
        (row + 0.5) * PI / height,
    );
}

// The map turned: its value at d is the value of the map at R d.
fn turned(column: f32, row: f32) -> vec3<f32> {
    let a = angles(column, row);
    let d = vec3<f32>(sin(a.y) * cos(a.x), sin(a.y) * sin(a.x), cos(a.y));
    return radiance(vec3<f32>(
        turn_xx * d.x + turn_xy * d.y + turn_xz * d.z,
        turn_yx * d.x + turn_yy * d.y + turn_yz * d.z,
        turn_zx * d.x + turn_zy * d.y + turn_zz * d.z,
    ), 0);
}

// What arrives from a direction.
fn seen(direction: vec3<f32>) -> vec3<f32> {
    return radiance(direction, 0);
}

// The taps from `first` on, as many as one evaluation takes.
fn convolved(column: f32, row: f32, first: f32, layer: f32) -> vec3<f32> {
    let a = angles(column, row);
    let east = vec3<f32>(-sin(a.x), cos(a.x), 0.0);
    let north = vec3<f32>(-cos(a.y) * cos(a.x), -cos(a.y) * sin(a.x), sin(a.y));
    let outwards = vec3<f32>(sin(a.y) * cos(a.x), sin(a.y) * sin(a.x), cos(a.y));
    let begin = u32(first);
    let end = min(begin + u32(tap_block), u32(tap_count));
    var sum = vec3<f32>(0.0, 0.0, 0.0);
    for (var tap = begin; tap < end; tap += 1u) {
        let at = 6u * tap;
        let direction = east * taps[at] + north * taps[at + 1u] + outwards * taps[at + 2u];
        let weight = vec3<f32>(taps[at + 3u], taps[at + 4u], taps[at + 5u]);
        sum += weight * radiance(direction, i32(layer));
    }
    return sum;
}
