"""Oracle of the powers of orders: writes diffraction.csv beside this file.

Independent of the crate: Fourier coefficients of exp(-i phase profile) over one period in 40 digits by
mpmath's quadrature, for the sinusoid as for the rectangle; no Bessel function is called. Inputs are f64
numbers printed so that they read back exactly (repr), values have 22 digits.

Columns: profile (0 sinusoid, 1 rectangle), order, duty (0 for the sinusoid), phase, power.

Run: python3 tests/oracles/diffraction.py   (needs mpmath; about a minute)
"""

import random
from pathlib import Path

from mpmath import cos, expj, mp, mpf, nstr, pi, quad, sin

mp.dps = 40


def sinusoid(order, phase):
    """J_order(phase)^2 by Bessel's integral (1/pi) int cos(m t - a sin t) dt over [0, pi]."""
    a, m = mpf(phase), order
    value = quad(lambda t: cos(m * t - a * sin(t)), [pi * i / 8 for i in range(9)]) / pi
    return value * value


def rectangle(order, duty, phase):
    """|int_0^1 exp(-i phi(t)) exp(-2 pi i m t) dt|^2, phi = phase below duty and 0 above."""
    q, step = mpf(duty), expj(-mpf(phase))
    wave = lambda t: expj(-2 * pi * order * t)
    cut = lambda a, b: [a + (b - a) * i / 6 for i in range(7)]
    low = quad(wave, cut(mpf(0), q)) if q > 0 else mpf(0)
    high = quad(wave, cut(q, mpf(1))) if q < 1 else mpf(0)
    return abs(step * low + high) ** 2


def rows():
    drawn = random.Random(2017)
    phases = [0.0, 1e-300, 1e-8, 1e-3, 0.1, 0.5, 1.0, 1.676, 1.8411837813406593, 2.404825557695773]
    phases += [3.141592653589793, 3.831705970207512, 5.520078110286311, 6.283185307179586, 10.0]
    phases += [12.5, 15.7, 19.99, 20.0]
    for order in range(11):
        for phase in phases + [drawn.uniform(0, 20) for _ in range(8)]:
            yield 0, order, 0.0, phase, sinusoid(order, phase)
        for duty in [0.0, 0.1, 0.25, 1 / 3, 0.5, 0.9, 1.0, drawn.random()]:
            for phase in [0.0, 1e-3, 1.0, 3.141592653589793, 20.0, drawn.uniform(0, 20)]:
                yield 1, order, duty, phase, rectangle(order, duty, phase)


with open(Path(__file__).with_name("diffraction.csv"), "w", newline="\n") as out:
    out.write("profile,order,duty,phase,power\n")
    for profile, order, duty, phase, power in rows():
        out.write(f"{profile},{order},{duty!r},{phase!r},{nstr(power, 22)}\n")
