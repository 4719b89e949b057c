const ROOT_PI: f32 = 1.7724538509055160;

// The single line of Velinov, Werner & Hullin 2018, eq. 27: the slice xi_1 = 0 stands for all.
fn lobe_integral(kw: f32, ks: f32, view: vec2<f32>, light: Light) -> f32 {
    return ROOT_PI / ks * slice_band(kw, view.y, light, -view.x);
}
