// uses: sphere

// Velinov, Werner & Hullin 2018, eq. 31: the disc of the sphere's radius at the distance of its
// centre, of half-angle atan(r/p), in place of the silhouette asin(r/p).
fn sphere_light(kw: f32, ks: f32, view: vec2<f32>, centre: vec3<f32>, radius: f32) -> f32 {
    let largest = abs(centre);
    let unit = max(max(largest.x, largest.y), max(largest.z, radius));
    let p = centre / unit;
    let r = radius / unit;
    let square = dot(p, p);
    let hypotenuse = sqrt(square + r * r);
    var light = cone(vec3<f32>(0.0, 0.0, 1.0), 1.0, 0.0);
    if square > 0.0 {
        let distance = sqrt(square);
        light = cone(p / distance, r / hypotenuse, distance / hypotenuse);
    }
    return lobe_integral(kw, ks, view, light);
}
