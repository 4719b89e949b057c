"""Oracle of sphere_light and triangle_light: tests/oracles/{sphere,triangle}_light.csv.

Run: python3 tests/oracles/lights.py (numpy).

Spheres are integrated over polar angle and azimuth about the normal, triangles over their own area, both
by tensor products of Gauss-Legendre rules: no slices xi_1 = const, no band integral. Every value is
computed with two orders; a case whose values differ by more than 1e-11 is left out.
"""

import csv
import math
import pathlib

import numpy as np

HERE = pathlib.Path(__file__).parent
RULES = {n: np.polynomial.legendre.leggauss(n) for n in (240, 400)}


def lobe(kw, ks, view, x, y):
    phase = 0.5 * kw * (y + view[1])
    return np.exp(-((ks * (x + view[0])) ** 2)) * np.sinc(phase / math.pi) ** 2


def sphere(kw, ks, view, centre, radius, n):
    nodes, weights = RULES[n]
    p = np.linalg.norm(centre)
    alpha = math.asin(radius / p)
    polar = math.acos(centre[2] / p)
    turn = math.atan2(centre[1], centre[0])
    # Polar angles between which the slices change smoothly; theta = centre + half sin(u).
    ends = sorted({max(polar - alpha, 0.0), abs(alpha - polar), min(polar + alpha, math.pi / 2)})
    ends = [end for end in ends if end <= math.pi / 2]
    if alpha > polar:
        ends = sorted({0.0, *ends})
    total = 0.0
    for low, high in zip(ends, ends[1:]):
        u = 0.5 * math.pi * nodes
        theta = 0.5 * (low + high) + 0.5 * (high - low) * np.sin(u)
        weight = 0.25 * math.pi * (high - low) * weights * np.cos(u)
        cosine = (math.cos(alpha) - np.cos(theta) * math.cos(polar)) / (np.sin(theta) * math.sin(polar))
        half = np.arccos(np.clip(cosine, -1.0, 1.0))
        azimuth = turn + half[:, None] * nodes[None, :]
        x, y = np.sin(theta)[:, None] * np.cos(azimuth), np.sin(theta)[:, None] * np.sin(azimuth)
        inner = (lobe(kw, ks, view, x, y) @ weights) * half
        total += float(np.sum(weight * np.sin(theta) * np.cos(theta) * inner))
    return total


def above(vertices):
    kept = []
    for a, b in zip(vertices, np.roll(vertices, -1, axis=0)):
        if a[2] >= 0.0:
            kept.append(a)
        if a[2] * b[2] < 0.0:
            kept.append(a + (b - a) * (a[2] / (a[2] - b[2])))
    return kept


def triangle(kw, ks, view, vertices, n):
    nodes, weights = RULES[n]
    u, w = 0.5 * (nodes + 1.0), 0.5 * weights
    kept = above(vertices)
    total = 0.0
    for b, c in zip(kept[1:], kept[2:]):
        a = kept[0]
        normal = np.cross(b - a, c - a)
        across = b[None, None, :] + u[None, :, None] * (c - b)[None, None, :]
        place = a + u[:, None, None] * (across - a)
        distance = np.linalg.norm(place, axis=2)
        measure = np.abs(place @ normal) * place[:, :, 2] / distance**4
        values = measure * lobe(kw, ks, view, place[:, :, 0] / distance, place[:, :, 1] / distance)
        total += float(np.sum((w * u)[:, None] * w[None, :] * values))
    return total


def written(name, header, rows):
    with open(HERE / name, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([[repr(float(v)) for v in row] for row in rows])


def agreed(value, *arguments):
    coarse, fine = (value(*arguments, n) for n in (240, 400))
    return fine if abs(coarse - fine) <= 1e-11 * abs(fine) else None


def main():
    rng = np.random.default_rng(2018)
    rows = {"sphere": [], "triangle": []}
    for kind in ("sphere", "triangle"):
        while len(rows[kind]) < 60:
            kw, ks = 10.0 ** rng.uniform(-1.0, 1.8, size=2)
            centre = rng.normal(size=3)
            centre[2] = abs(centre[2]) if len(rows[kind]) % 3 else 0.3 * centre[2]
            centre /= np.linalg.norm(centre)
            size = 10.0 ** rng.uniform(-2.0, -0.1)
            view = -centre[:2] + rng.uniform(-1.0, 1.0, size=2) * (size + 1.0 / ks)
            view /= max(np.hypot(*view), 1.0)
            if kind == "sphere":
                value = agreed(sphere, kw, ks, view, centre, size)
                row = [kw, ks, *view, *centre, size]
            else:
                vertices = centre + size * rng.normal(size=(3, 3))
                if len(above(vertices)) < 3:
                    continue
                value = agreed(triangle, kw, ks, view, vertices)
                row = [kw, ks, *view, *vertices.ravel()]
            if value is not None and value > 1e-12:
                rows[kind].append([*row, value])
    scratch = ["kw", "ks", "view_x", "view_y"]
    axes = [f"{v}_{k}" for v in "abc" for k in "xyz"]
    written("sphere_light.csv", [*scratch, "centre_x", "centre_y", "centre_z", "radius", "value"], rows["sphere"])
    written("triangle_light.csv", [*scratch, *axes, "value"], rows["triangle"])


if __name__ == "__main__":
    main()
