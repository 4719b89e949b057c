"""Prints the linear sRGB of gold at normal incidence, from data/measured/, for data_sets.rs.

    pip install colour-science==0.4.7 numpy
    python3 tests/tables/gold.py

XYZ by colour-science at 1 nm, reflectance linear between the measured wavelengths; the matrix from
its sRGB primaries with the white of the same tables.
"""

import csv
import pathlib

import colour
import numpy

data = pathlib.Path(__file__).parents[2] / "data/measured/optical_constants/Au.Johnson.csv"
rows = [r for r in csv.reader(line for line in data.open() if not line.startswith("#"))][1:]
wavelength, n, k = numpy.array(rows, float).T
reflectance = ((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2)

shape = colour.SpectralShape(360, 780, 1)
nodes = numpy.arange(360, 781.0)
gold = colour.SpectralDistribution(numpy.interp(nodes, wavelength, reflectance), nodes)
observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape)
d65 = colour.SDS_ILLUMINANTS["D65"].copy()
d65 = colour.SpectralDistribution(numpy.interp(nodes, d65.wavelengths, d65.values), nodes)


def xyz(reflector):
    return colour.sd_to_XYZ(reflector, observer, d65, method="Integration") / 100


white = xyz(colour.sd_ones(shape))
primaries = colour.RGB_COLOURSPACES["sRGB"].primaries
matrix = colour.normalised_primary_matrix(primaries, colour.XYZ_to_xy(white))
print(numpy.linalg.inv(matrix) @ xyz(gold))
