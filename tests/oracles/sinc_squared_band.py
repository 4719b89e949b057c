"""Writes sinc_squared_band.csv: the integral of sinc^2(t/2) by mpmath on bands that break implementations.

    python3 tests/oracles/sinc_squared_band.py

Needs mpmath (1.3). Bounds are printed so that they read back as the same f64; `value` is the integral
between exactly those f64, with 25 significant digits. It is the difference of 2 Si(x) - 2 (1 - cos x)/x at
the bounds, with as many digits as the cancellation may take, and checked with 40 digits more: no
quadrature, no auxiliary functions and no asymptotic series of ours.
"""

import csv
import math
import pathlib
import random
import struct

import mpmath


def step(x, ulps):
    """The f64 `ulps` units in the last place above x > 0."""
    bits = struct.unpack("<q", struct.pack("<d", x))[0]
    return struct.unpack("<d", struct.pack("<q", bits + ulps))[0]


def primitive(x):
    x = mpmath.mpf(x)
    return mpmath.mpf(0) if x == 0 else 2 * mpmath.si(x) - 2 * (1 - mpmath.cos(x)) / x


def band(x0, x1):
    """The integral to 25 digits: digits are added until 40 more change nothing."""
    # 1 - cos x of the smallest bound must not be 0.
    smallest = min(abs(x) for x in (x0, x1) if x != 0)
    digits, last = 80 + max(0, int(-2.5 * math.log10(smallest))), None
    while True:
        with mpmath.workdps(digits):
            value = primitive(x1) - primitive(x0)
        text = mpmath.nstr(value, 25, strip_zeros=False)
        if text == last and value != 0:
            return text
        last, digits = text, digits + (40 if digits < 200 else digits // 2)


def bands():
    rng = random.Random(27)
    yield from [(0.0, 5e-324), (0.0, 1e-310), (-1e-320, 1e-310), (1e-200, 1e-199), (-1e-100, 3e-100)]
    yield from [(0.0, 1e-12), (1e-9, 1e-8), (-1e-5, 1e-6), (0.0, 0.1), (-0.1, 0.1), (0.0, 1e-8), (1e-8, 2e-8)]
    # About zeros of the sinc, crests and in between: from an ulp to a period.
    for n in (0, 1, 2, 3, 6, 7, 8, 50, 500, 1000, 15915):
        for part in (0.0, 0.25, 0.5, 0.9):
            x = 2 * math.pi * (n + part)
            if x > 0:
                yield from ((step(x, -a), step(x, b)) for a, b in ((0, 1), (3, 5), (1, 0), (1000, 0)))
                yield from ((x * (1 - r), x * (1 + r)) for r in (1e-12, 1e-9, 1e-6))
            yield from ((x, x + w) for w in (1e-10, 1e-6, 1e-3, 0.1, math.pi, 2 * math.pi, 6.3, 20.0))
            yield (x - 1e-7, x + 2e-7)
    # About the width at which panels end, and wider, from every range of the auxiliary functions.
    wide = 16 * math.pi
    for a in (0.0, 1e-3, 1.0, 3.9999, 4.0, 4.1, 12.0, 39.9, 40.0, 40.1, 300.0, 1e4, 9e4):
        yield from ((a, a + w) for w in (wide * (1 - 1e-12), wide * (1 + 1e-12), 51.0, 60.0, 300.0, 1e4, 1e5))
        yield from ((-a, b) for b in (1e-3, 1.0, 30.0, 50.2, 50.3, 1e3, 1e5))
    yield from [(1e5, step(1e5, 1)), (1e5 - 1e-6, 1e5), (99990.0, 1e5), (-1e5, 1e5), (5e4, 1e5), (1e-300, 1e5)]
    yield from [(1e5, 1e8), (1e8, 1e8 + 1e-6), (1e8, 2e8), (0.0, 1e12), (1e12, 1e15)]
    for _ in range(250):
        a = rng.choice((-1, 1)) * 10 ** rng.uniform(-4, 5)
        yield (a, a + 10 ** rng.uniform(-12, 4))
    for _ in range(100):
        yield (rng.uniform(-200, 200), rng.uniform(-200, 200))


def main():
    path = pathlib.Path(__file__).with_suffix(".csv")
    with path.open("w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["x0 [rad]", "x1 [rad]", "value [1]"])
        for i, (x0, x1) in enumerate(b for b in bands() if b[0] != b[1]):
            # Every seventh the other way round, every eleventh mirrored.
            x0, x1 = (x1, x0) if i % 7 == 3 else (x0, x1)
            x0, x1 = (-x0, -x1) if i % 11 == 5 else (x0, x1)
            out.writerow([repr(x0), repr(x1), band(x0, x1)])


if __name__ == "__main__":
    main()
