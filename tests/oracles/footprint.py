"""Oracle of the footprint references: writes footprint.csv and footprint_end.csv beside this file.

Independent of the crate: the defining integrals in 30 digits by mpmath's tanh-sinh quadrature, over
the position u across the footprint, cut into panels where the exponent is within 85 of its largest value; for a scratch that
ends, the mean along the chord is a second quadrature of the product of two error functions. Inputs
are f64 numbers printed so that they read back exactly (repr), values have 22 digits.

Run: python3 tests/oracles/footprint.py   (needs mpmath; about three minutes)
"""

import random
from pathlib import Path

from mpmath import erfc, exp, mp, mpf, nstr, pi, quad, sqrt

mp.dps = 30


def mean_across(h, s, width, f=lambda u: 1):
    """(2/pi) int sqrt(1 - u^2) exp(-((s - h u)/width)^2) f(u) du over [-1, 1], in mp."""
    h, s = mpf(h), abs(mpf(s))
    if h == 0:
        gauss = exp(-((s / width) ** 2))
        return gauss * 2 / pi * quad(lambda u: sqrt(1 - u * u) * f(u), [-1, 0, 1])
    nearest = max(s - h, mpf(0)) / width
    reach = width * sqrt(nearest * nearest + 85)
    low, high = max(mpf(-1), (s - reach) / h), min(mpf(1), (s + reach) / h)
    panels = [low + (high - low) * i / 8 for i in range(9)]
    # 1 - u^2 as a product, so that the ends keep their digits.
    weight = lambda u: sqrt((1 - u) * (1 + u)) if -1 < u < 1 else mpf(0)
    # quad stops at an absolute error: the largest value of the exponential is taken out.
    scaled = lambda u: weight(u) * exp(nearest**2 - ((s - h * u) / width) ** 2) * f(u)
    return exp(-(nearest**2)) * 2 / pi * quad(scaled, panels)


def end(h, l, m, s, e):
    """Mean of exp(-(s - y)^2) Phi(x - e)^2 over y = h u, x = m u + l v, u^2 + v^2 <= 1."""
    l, m, e = mpf(l), mpf(m) * (-1 if s < 0 else 1), mpf(e)
    square = lambda x: (erfc((e - x) / sqrt(mpf(2))) / 2) ** 2

    def along(u):
        half = l * sqrt(max(mpf(0), 1 - u * u))
        if half < mpf(10) ** -20:
            return square(m * u)
        centre = m * u
        low, high = centre - half, centre + half
        inner = [p for p in (e - 9, e - 3, e, e + 3, e + 9) if low < p < high]
        return quad(lambda x: square(x), [low, *inner, high]) / (2 * half)

    return mean_across(h, s, mpf(1), along)


def points():
    extents = [0.0, 1e-300, 1e-8, 1e-3, 0.05, 0.1, 0.3, 0.7, 1.0, 1.4, 2.0, 2.65, 3.0, 5.0]
    extents += [7.0, 10.0, 26.0, 30.0, 80.0, 100.0, 301.5, 1000.0]
    for h in extents:
        outside = (1e-9, 0.01, 0.5, 1.0, 2.0, 4.0, 8.0, 13.0, 20.0, 26.0)
        for s in [0.0, 1e-8, 0.1 * h, 0.5 * h, 0.9 * h, 0.999 * h, h] + [h + d for d in outside]:
            yield h, s
    rng = random.Random(16)
    for _ in range(150):
        h = 10 ** rng.uniform(-2, 3)
        yield h, rng.uniform(-1, 1) * (h + 5)
    for _ in range(50):
        h = 10 ** rng.uniform(-2, 3)
        yield h, h + rng.uniform(0, 26)


def end_points():
    rng = random.Random(5)
    yield 0.0, 0.0, 0.0, 0.0, 0.0
    yield 0.0, 2.0, 0.5, 0.3, 0.4
    yield 1.0, 0.0, 0.0, 0.5, -0.5
    yield 1.0, 1e-6, 0.0, 0.5, 3.0
    yield 30.0, 40.0, 20.0, 31.0, 25.0
    yield 1.0, 100.0, 0.0, 0.2, 99.0
    yield 100.0, 1.0, 60.0, -50.0, 30.0
    yield 2.0, 5.0, -3.0, 1.0, -9.0
    yield 2.0, 5.0, -3.0, -1.0, 14.0
    for _ in range(36):
        h, l = 10 ** rng.uniform(-1, 1.3), 10 ** rng.uniform(-1, 1.3)
        m = rng.uniform(-1, 1) * l
        yield h, l, m, rng.uniform(-1, 1) * (h + 2), rng.uniform(-1, 1) * (l + abs(m) + 3)


def text(value):
    return nstr(value, 22, min_fixed=0, max_fixed=0)


def main():
    folder = Path(__file__).parent
    with open(folder / "footprint.csv", "w") as out:
        out.write("h [1],s [1],response [1],coverage [1]\n")
        for h, s in points():
            response, coverage = (mean_across(h, s, width) for width in (mpf(1), sqrt(mpf(2))))
            out.write(f"{h!r},{s!r},{text(response)},{text(coverage)}\n")
    with open(folder / "footprint_end.csv", "w") as out:
        out.write("half_extent [1],half_length [1],shear [1],offset [1],end [1],value [1]\n")
        for h, l, m, s, e in end_points():
            mp.dps = 18
            out.write(f"{h!r},{l!r},{m!r},{s!r},{e!r},{text(end(h, l, m, s, e))}\n")


if __name__ == "__main__":
    main()
