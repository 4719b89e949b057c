"""FLIP of small synthetic images by NVIDIA's evaluator (flip-evaluator 1.7, BSD-3).

    pip install numpy flip-evaluator==1.7
    python tests/oracles/flip.py

writes flip.csv (a row per case: mean, exposures of HDR-FLIP) and flip_pixels.csv (every 13th pixel)
beside itself. The images are made of integers and powers of two, so that `tests/compare.rs` makes
the same ones to the bit.
"""

import csv
import pathlib

import flip_evaluator
import numpy as np

HERE = pathlib.Path(__file__).parent
STANDARD = 3840.0 * np.pi / 180.0

# name, width, height, pixels per degree, range, kind of difference
CASES = [
    ("noise", 61, 47, STANDARD, "LDR", "noise"),
    ("shift", 64, 40, STANDARD, "LDR", "shift"),
    ("tint", 33, 50, STANDARD, "LDR", "tint"),
    ("near", 40, 32, 25.0, "LDR", "noise"),
    ("far", 90, 70, 160.0, "LDR", "shift"),
    ("small", 5, 3, STANDARD, "LDR", "noise"),
    ("hdr_noise", 61, 47, STANDARD, "HDR", "noise"),
    ("hdr_shift", 64, 40, STANDARD, "HDR", "shift"),
    ("hdr_tint", 33, 50, 40.0, "HDR", "tint"),
]


def hashed(x, y, channel):
    """1024 values of a hash in 32 bits of unsigned arithmetic."""
    h = (x * 0x9E3779B1 + y * 0x85EBCA77 + channel * 0xC2B2AE3D) & 0xFFFFFFFF
    h ^= h >> 15
    h = (h * 0x2C1B3C6D) & 0xFFFFFFFF
    h ^= h >> 12
    return h >> 22


def reference(x, y, channel, width, dynamic_range):
    """Multiples of 1/1024 in [0, 1): a ramp, bars, a checkerboard; 2^-6 to 2^5 times that in HDR."""
    if channel == 0:
        value = x * 1023 // (width - 1)
    elif channel == 1:
        value = 700 if (x + y) // 9 % 2 == 0 else 180
    else:
        value = 900 if (x // 5 + y // 7) % 2 == 0 else 64
    return value / 1024.0 * (2.0 ** (12 * x // width - 6) if dynamic_range == "HDR" else 1.0)


def pair(x, y, channel, width, dynamic_range, kind):
    """Test and reference value of a pixel, both exact in f32."""
    value = reference(x, y, channel, width, dynamic_range)
    if kind == "noise":
        test = value * (0.75 + hashed(x, y, channel) / 2048.0)
    elif kind == "shift":
        test = reference(max(x - 2, 0), y, channel, width, dynamic_range)
    else:
        test = value * (0.5, 0.875, 1.0)[channel]
    return np.float32(min(test, 1.0) if dynamic_range == "LDR" else test), np.float32(value)


def main():
    with open(HERE / "flip.csv", "w", newline="") as cases, \
            open(HERE / "flip_pixels.csv", "w", newline="") as pixels:
        cases, pixels = csv.writer(cases, lineterminator="\n"), csv.writer(pixels, lineterminator="\n")
        cases.writerow(["case", "width", "height", "ppd", "range", "kind", "mean", "start", "stop", "count"])
        pixels.writerow(["case", "x", "y", "flip"])
        for name, width, height, ppd, dynamic_range, kind in CASES:
            test = np.zeros((height, width, 3), np.float32)
            expected = np.zeros((height, width, 3), np.float32)
            for y in range(height):
                for x in range(width):
                    for c in range(3):
                        test[y, x, c], expected[y, x, c] = pair(x, y, c, width, dynamic_range, kind)
            error, mean, used = flip_evaluator.evaluate(
                expected, test, dynamic_range, inputsRGB=False, applyMagma=False,
                parameters={"ppd": ppd})
            exposures = ["", "", ""]
            if dynamic_range == "HDR":
                exposures = [repr(float(used[key])) for key in ("startExposure", "stopExposure")]
                exposures.append(used["numExposures"])
            cases.writerow([name, width, height, repr(float(ppd)), dynamic_range, kind,
                            repr(float(error.astype(np.float64).mean())), *exposures])
            for at in range(0, width * height, 13):
                x, y = at % width, at // width
                pixels.writerow([name, x, y, repr(float(error[y, x, 0]))])


if __name__ == "__main__":
    main()
