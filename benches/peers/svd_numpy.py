"""Thin SVD of the three 512 x 512 channels of benches/svd.rs with NumPy: prints the median in ms
and the relative error at rank 10 of the first channel.

The same table: a lattice of orders under an envelope, turned and sheared, with noise from the same
generator (a linear congruential one, so that both sides have the same numbers).
"""

import sys
import time

import numpy as np


def table(n):
    i = np.arange(n, dtype=np.uint64)
    y, x = np.meshgrid((i + 0.5) / n * 2 - 1, (i + 0.5) / n * 2 - 1, indexing="ij")
    channels = []
    state = np.uint32(1)
    for k in range(3):
        noise = np.empty(n * n)
        for t in range(n * n):
            state = np.uint32((int(state) * 1664525 + 1013904223) & 0xFFFFFFFF)
            noise[t] = int(state) / 2**32
        waves = np.cos((30 + k) * (x + 0.2 * y)) * np.cos((25 + k) * (y - 0.3 * x))
        channels.append(waves**4 * np.exp(-4 * (x * x + y * y)) + 0.01 * noise.reshape(n, n))
    return [c.astype(np.float32).astype(np.float64) for c in channels]


def main():
    channels = table(512)
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 9
    times = []
    for _ in range(runs):
        begin = time.perf_counter()
        results = [np.linalg.svd(c, full_matrices=False) for c in channels]
        times.append(time.perf_counter() - begin)
    sigma = results[0][1]
    error = np.sqrt(np.sum(sigma[10:] ** 2) / np.sum(sigma**2))
    print(f"{1e3 * sorted(times)[runs // 2]:.3f} {error:.12f}")


main()
