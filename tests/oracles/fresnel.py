"""Oracle of the Fresnel references: writes fresnel.csv beside this file.

Independent of the crate: the textbook amplitude ratios (Born & Wolf 1.5.2) as they stand, in 200
digits, with no rearrangement. Inputs are f64 numbers printed so that they read back exactly
(repr), values have 25 digits.

Run: python3 tests/oracles/fresnel.py   (needs mpmath)
"""

import math
import random
from pathlib import Path

from mpmath import mp, mpc, mpf, nstr, re, sqrt

mp.dps = 200


def reflectances(mu, n, k):
    """R_s and R_p for f64 inputs, in mp."""
    mu, m = mpf(mu), mpc(n, k)
    w = sqrt(m * m - (1 - mu * mu))
    if w.imag < 0 or w.real < 0:
        w = -w
    r_s = (mu - w) / (mu + w)
    r_p = (m * m * mu - w) / (m * m * mu + w)
    return abs(r_s) ** 2, abs(r_p) ** 2


def points():
    rng = random.Random(1)
    uniform = rng.uniform
    power = lambda low, high: 10 ** uniform(low, high)
    for _ in range(250):  # the stated domain, evenly in the logarithm
        yield min(1.0, power(-8, 0)), power(-3, 2), power(-6, 2)
    for _ in range(100):  # what metals and glasses are, at every angle
        yield uniform(0, 1), uniform(0.03, 4.5), uniform(0, 8)
    for _ in range(80):  # dielectrics, both sides
        yield min(1.0, power(-8, 0)), power(-3, 2), 0.0
    for _ in range(40):
        yield uniform(0, 1), uniform(0.4, 2.5), 0.0
    for e in range(-15, 0):  # next to index 1
        for mu in (1.0, 0.6, 1e-3, 1e-8):
            yield mu, 1 + 10.0**e, 0.0
            yield mu, 1 - 10.0**e, 0.0
            yield mu, 1.0, 10.0**e
            yield mu, 1 + 10.0**e, 10.0**e
    for n in (1.0001, 1.33, 1.5, 2.4, 100.0, 0.7, 1e-3):  # Brewster's angle and around it
        brewster = 1 / math.sqrt(1 + n * n)
        for mu in (brewster, math.nextafter(brewster, 1), brewster * (1 + 1e-9), brewster * 0.999):
            yield mu, n, 0.0
            yield mu, n, 1e-9
            yield mu, n, 1e-3
    for n in (1 - 2.0**-53, 0.999999, 0.9, 2 / 3, 0.6, 0.1, 1e-3):  # the critical angle
        critical = math.sqrt((1 - n) * (1 + n))
        for step in (0, 1e-15, -1e-15, 1e-9, -1e-9, 1e-3, -1e-3):
            mu = min(1.0, critical * (1 + step))
            yield mu, n, 0.0
            yield mu, n, 1e-12
            yield mu, n, 1e-4
    for n in (1e-3, 0.04, 0.6, 1.0, 4.0, 100.0):  # corners
        for k in (0.0, 1e-3, 1.0, 6.5, 100.0):
            for mu in (1.0, math.nextafter(1, 0), 0.5, 1e-4, 1e-8, 0.0):
                yield mu, n, k


def main():
    with open(Path(__file__).with_name("fresnel.csv"), "w") as out:
        out.write("mu [1],n [1],k [1],reflectance_s [1],reflectance_p [1],reflectance [1]\n")
        for mu, n, k in points():
            s, p = (mpf(0), mpf(0)) if (n, k) == (1.0, 0.0) else reflectances(mu, n, k)
            values = ",".join(nstr(re(v), 25, min_fixed=0, max_fixed=0) for v in (s, p, (s + p) / 2))
            out.write(f"{mu!r},{n!r},{k!r},{values}\n")


if __name__ == "__main__":
    main()
