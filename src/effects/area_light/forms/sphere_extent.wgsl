// Range of w_x over the part of the cone above the horizon: latitudes beta_0 -+ alpha if the axis points
// up, else where the boundary meets the horizon; up to a pole that is inside.
fn extent(light: Light) -> vec2<f32> {
    let rho = length(light.axis.yz);
    var middle = light.axis.x * light.cosine;
    var half = rho * light.sine;
    if light.axis.z < 0.0 {
        let level = dot(light.axis.xy, light.axis.xy);
        // level - cos^2 alpha = sin^2 alpha - p_z^2.
        let square = (light.sine - light.axis.z) * (light.sine + light.axis.z);
        if !(square > 0.0) {
            return vec2<f32>(0.0, 0.0);
        }
        middle /= level;
        half = abs(light.axis.y) * sqrt(square) / level;
    }
    return vec2<f32>(
        select(max(middle - half, -1.0), -1.0, -light.axis.x >= light.cosine),
        select(min(middle + half, 1.0), 1.0, light.axis.x >= light.cosine));
}
