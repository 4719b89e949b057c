//! The approximations, as registered.

use crate::effect::{FormEntry, Source};

macro_rules! written {
    ($name:literal + [$($piece:literal),*], $reference:literal, $description:literal, $citation:literal) => {
        FormEntry {
            name: concat!("scratch_response/", $name),
            description: $description,
            citation: $citation,
            path: concat!("src/effects/scratch_response/forms/", $name, ".wgsl"),
            // The form first, so that its lines keep their numbers in diagnostics.
            source: Source::Written(concat!(
                include_str!(concat!("forms/", $name, ".wgsl")),
                $(include_str!(concat!("forms/", $piece, ".wgsl"))),*
            )),
            function: $name,
            reference: $reference,
        }
    };
}

pub(super) const FORMS: &[FormEntry] = &[
    written!(
        "published" + ["lobe"],
        "scratch_reflectance",
        "infinite scratch at small angles: both simplifications, what ships",
        "velinov2018 eq. 3, 9, 10, 11"
    ),
    written!(
        "infinite" + ["lobe"],
        "scratch_reflectance",
        "infinite scratch, the depth phase at its angles",
        "velinov2018 eq. 3, 8; fig. 3 dashed"
    ),
    written!(
        "mirror_depth" + ["lobe"],
        "scratch_reflectance",
        "infinite scratch, the depth phase in the mirror direction of the viewer",
        "striae"
    ),
    written!(
        "matched_ends" + ["matched", "lobe", "erfc"],
        "scratch_reflectance",
        "finite scratch as a Gaussian of the exact peak and energy, four real error functions",
        "striae"
    ),
    written!(
        "small_angle" + ["lobe", "faddeeva"],
        "scratch_reflectance",
        "finite scratch at small angles",
        "velinov2018 eq. 3-5"
    ),
    written!(
        "finite" + ["lobe", "faddeeva"],
        "scratch_reflectance",
        "finite scratch, the depth phase at its angles: the reference in f32",
        "velinov2018 eq. 3, 5; Weideman 1994 for the error function"
    ),
    written!(
        "published_mirror" + ["mirror", "lobe", "infinite_density"],
        "scratched_mirror_reflectance",
        "infinite scratch at small angles, the mirror dimmed by rho_c: all together, what ships",
        "velinov2018 eq. 3, 6, 9-11, 17"
    ),
    written!(
        "superposed" + ["mirror", "lobe"],
        "scratched_mirror_reflectance",
        "no cross term and no blend",
        "velinov2018 eq. 6 without rho_c"
    ),
    written!(
        "density_blend" + ["mirror", "lobe", "infinite_density"],
        "scratched_mirror_reflectance",
        "no cross term, the mirror dimmed by rho_c",
        "velinov2018 eq. 6, 17"
    ),
    written!(
        "peak_blend" + ["mirror", "lobe", "infinite_density"],
        "scratched_mirror_reflectance",
        "no cross term, the mirror dimmed by |D|^2 rho_c/2: exact at its peak",
        "striae"
    ),
    written!(
        "energy_blend" + ["mirror", "lobe"],
        "scratched_mirror_reflectance",
        "no cross term, the mirror dimmed by the energy that the scratch shows",
        "striae"
    ),
    written!(
        "interference" + ["amplitude", "lobe"],
        "scratched_mirror_reflectance",
        "infinite scratch, the cross term kept in closed form",
        "velinov2018 eq. 1, 8"
    ),
    written!(
        "matched_mirror" + ["matched", "mirror", "lobe", "erfc", "infinite_density"],
        "scratched_mirror_reflectance",
        "finite scratch as a Gaussian of the exact peak and energy, the mirror dimmed by |D|^2 rho_c/2",
        "striae"
    ),
    written!(
        "incoherent_pair" + ["lobe"],
        "scratch_pair_reflectance",
        "no mutual interference",
        "velinov2018 eq. 7"
    ),
    written!(
        "coherent_pair" + ["amplitude", "lobe"],
        "scratch_pair_reflectance",
        "mutual interference kept: the reference in f32",
        "velinov2018 eq. 2, 8"
    ),
    written!(
        "infinite_density" + ["lobe"],
        "scratch_density",
        "infinite scratch",
        "velinov2018 eq. 17, second line"
    ),
    written!(
        "finite_density" + ["lobe", "erfc", "infinite_density"],
        "scratch_density",
        "finite scratch by real error functions",
        "velinov2018 eq. 17, first line"
    ),
];
