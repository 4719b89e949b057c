"""Oracle of the scratch references: writes scratch_response.csv beside this file.

Independent of the crate: eq. 1-5 of velinov2018 as printed, with mpmath's complex erf, in 60 digits
and as many more as the Gaussian in front of erf takes away. Inputs are f64 numbers printed so that
they read back exactly, values have 25 digits. `peak` is what errors are relative to: the largest
value over all directions, bounded by |xi| = 0 and |D| = 2.

Run: python3 tests/oracles/scratch_response.py   (needs mpmath)
"""

import math
import random
from pathlib import Path

from mpmath import cos, erf, exp, expj, inf, mp, mpc, mpf, nstr, pi, sin, sinc, sqrt

mp.dps = 60


def amplitude(width, depth, wavelength, sigma, along, across, offset, begin, end, mu_sum):
    """W D eta of eq. 3-5; the depth phase at its angles."""
    k = 2 * pi / wavelength
    b = sigma * k * along
    mp.dps = 60 + int(b * b / 2 / 2.3)  # exp(-b^2/2) erf is a product of very unlike factors
    d = sqrt(pi / 2) * sigma * exp(-(offset**2) / (2 * sigma**2) - b * b / 2) * expj(-k * offset * across)
    at = lambda h: mpf(-1) if h == -inf else mpf(1) if h == inf else erf(mpc(h / sigma, b) / sqrt(mpf(2)))
    value = width * sinc(pi * width * across / wavelength) * d * (at(end) - at(begin))
    value *= 1 - expj(2 * pi * mu_sum * depth / wavelength)
    mp.dps = 60
    return value


def base(wavelength, sigma, along, across):
    k = 2 * pi / wavelength
    return 2 * pi * sigma**2 * exp(-(sigma * k) ** 2 * (along**2 + across**2) / 2)


def ends(rng, sigma):
    kind = rng.randrange(6)
    if kind == 0:
        return -inf, inf
    if kind == 1:
        return rng.uniform(-2, 2) * sigma, inf
    if kind == 2:
        begin = rng.uniform(-2, 2) * sigma
        return begin, begin + 10 ** rng.uniform(-4, 1) * sigma
    if kind == 3:
        return 0.0, 10 ** rng.uniform(-3, 1) * sigma
    if kind == 4:
        return rng.uniform(3, 6) * sigma, rng.uniform(6, 9) * sigma
    return -rng.uniform(3, 12) * sigma, rng.uniform(3, 12) * sigma


def points():
    rng = random.Random(2018)
    for index in range(420):
        sigma = rng.choice([60.0, 10.0, 10 ** rng.uniform(-1, 3)])
        wavelength = rng.uniform(0.38, 0.78)
        width, depth = 10 ** rng.uniform(-0.5, 1.3), 10 ** rng.uniform(-0.5, 1.3)
        if index % 20 == 0:
            width = rng.choice([0.01, 1000.0])
        if index % 20 == 1:
            depth = wavelength / 4 * rng.randrange(1, 40)
        unit = wavelength / (2 * math.pi * sigma)
        along = rng.choice([0.0, rng.gauss(0, 1) * unit, rng.uniform(-6, 6) * unit, rng.uniform(-0.03, 0.03)])
        along = max(-60 * unit, min(60 * unit, along))
        across = rng.choice([0.0, rng.gauss(0, 1) * unit, rng.uniform(-4, 4) * wavelength / width, rng.uniform(-1, 1)])
        offset = rng.uniform(-2, 2) * sigma
        begin, end = ends(rng, sigma)
        yield width, depth, wavelength, sigma, along, across, offset, begin, end, rng.uniform(0, 2)


def text(value):
    return "inf" if value == inf else "-inf" if value == -inf else repr(float(value))


def main():
    names = "width_um depth_um wavelength_um sigma_um xi_along xi_across offset_um begin_um end_um mu_sum"
    more = "second_width_um second_depth_um second_offset_um turn_rad"
    values = "scratch mirror pair density peak"
    rng = random.Random(7)
    with open(Path(__file__).with_name("scratch_response.csv"), "w") as out:
        out.write(",".join((names + " " + more + " " + values).split()) + "\n")
        for point in points():
            width, depth, wavelength, sigma, along, across, offset, begin, end, mu_sum = exact = [
                x if x in (inf, -inf) else mpf(x) for x in point
            ]
            second = (
                10 ** rng.uniform(-0.5, 1.3),
                10 ** rng.uniform(-0.5, 1.3),
                rng.uniform(-2, 2) * point[3],
                rng.choice([0.0, rng.gauss(0, 0.01), rng.uniform(-3.2, 3.2)]),
            )
            width_b, depth_b, offset_b, turn = map(mpf, second)
            area = pi * sigma**2 * wavelength**2
            scratch = amplitude(*exact)
            mirror = base(wavelength, sigma, along, across) - scratch
            turned = (along * cos(turn) + across * sin(turn), across * cos(turn) - along * sin(turn))
            pair = amplitude(width, depth, wavelength, sigma, along, across, offset, -inf, inf, mu_sum)
            if abs(turned[0]) * 2 * pi / wavelength * sigma < 200:
                pair += amplitude(width_b, depth_b, wavelength, sigma, *turned, offset_b, -inf, inf, mu_sum)
            phase = lambda h: mpf(-1) if h == -inf else mpf(1) if h == inf else erf(h / sigma / sqrt(mpf(2)))
            length = sqrt(pi / 2) * sigma * (phase(end) - phase(begin))
            density = width / (pi * sigma**2) * exp(-(offset**2) / (2 * sigma**2)) * length
            peak = (2 * width * length) ** 2 * exp(-(offset**2) / sigma**2) / area
            row = [text(x) for x in point] + [text(x) for x in second]
            row += [nstr(v, 25, min_fixed=0, max_fixed=0)
                    for v in (abs(scratch) ** 2 / area, abs(mirror) ** 2 / area, abs(pair) ** 2 / area, density, peak)]
            out.write(",".join(row) + "\n")


if __name__ == "__main__":
    main()
