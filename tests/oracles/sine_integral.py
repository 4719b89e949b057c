"""Writes sine_integral.csv: Si(x) by mpmath at points that have broken implementations.

    python3 tests/oracles/sine_integral.py

Needs mpmath (1.3). `x` is printed so that it reads back as the same f64; `value` is Si of exactly
that f64, with 25 significant digits, computed with 60 digits. mpmath uses its own hypergeometric
series, not the formulas of src/effects/sine_integral/reference.rs.
"""

import csv
import math
import pathlib
import random
import struct

import mpmath

mpmath.mp.dps = 60


def neighbours(x, steps=(-2, -1, 0, 1, 2)):
    """f64 values `steps` ulp away from x > 0."""
    bits = struct.unpack("<q", struct.pack("<d", x))[0]
    return [struct.unpack("<d", struct.pack("<q", bits + s))[0] for s in steps]


def points():
    tiny = [0.0, 5e-324, 1e-320, 2.2250738585072014e-308, 1e-300, 1e-160, 1e-100, 1e-45, 1.1754943508222875e-38]
    small = [10.0**-k * m for k in range(20, 0, -2) for m in (1.0, 3.7)]
    steps = [k / 8 for k in range(1, 161)]
    # Branch switches of the reference and of the forms, the maximum error of eq. 29.
    switches = [y for s in (1.0, 2.0, 3.0, 4.0, 3.56, 8.0, 40.0) for y in neighbours(s)]
    # Extrema and inflections: the f64 nearest to multiples of pi/2, and their neighbours.
    extrema = [y for k in (*range(1, 13), 100, 101, 1000, 1001, 3183, 6366) for y in neighbours(k * math.pi / 2, (-1, 0, 1))]
    far = [10.0 ** (k / 4) for k in range(5, 17)]
    # 6381956970095103 * 2**797 is the f64 closest to a multiple of pi/2 (Muller).
    huge = [1e5, 1e8, 1e15, 2.0**53, 1e16, 1e22, 1e100, 1e154, 1e155, 1e200, 6381956970095103 * 2.0**797, 1e300, 1.7976931348623157e308]
    rng = random.Random(29)
    drawn = [10.0 ** rng.uniform(-3, 6) for _ in range(200)]
    positive = sorted({*tiny, *small, *steps, *switches, *extrema, *far, *huge, *drawn})
    return positive + [-x for x in positive[1::11]]


def main():
    path = pathlib.Path(__file__).with_suffix(".csv")
    with path.open("w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["x [1]", "value [1]"])
        for x in points():
            out.writerow([repr(x), mpmath.nstr(mpmath.si(mpmath.mpf(x)), 25, strip_zeros=False)])


if __name__ == "__main__":
    main()
