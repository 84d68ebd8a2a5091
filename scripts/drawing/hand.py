#!/usr/bin/python3
"""Draws the speeds of the generated hand beside recorded ones: docs/pictures/hand.svg. The program makes the motion. The
recorded quantiles are those of 29,641 ticks of the Panda co-manipulation data set (arXiv 2410.13322, symbol 17)."""
import io
import pathlib
import subprocess
import sys

import matplotlib
import numpy
from matplotlib.figure import Figure

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = sys.argv[1] if sys.argv[1:] else ROOT / "build" / "release" / "bin" / "touchmark"
QUERY = "query --mesh icosphere:5 --trajectory hand --steps 200000 --reach inf --detector sphere-cluster"
MILLIMETRE = 12 ** 0.5 / 200  # of 20 cm across the box of a sphere of radius 1
RECORDED = {1: 0.0009, 5: 0.0017, 25: 0.0039, 50: 0.0083, 75: 0.025, 90: 0.079, 95: 0.125, 99: 0.224}  # %: mm a tick

matplotlib.rcParams.update({"svg.hashsalt": "hand", "svg.fonttype": "none"})
answers = subprocess.run([PROGRAM, *QUERY.split()], check=True, capture_output=True, text=True).stdout
distance, *parts = numpy.loadtxt(io.StringIO(answers), delimiter=",", skiprows=1, usecols=range(3, 10), unpack=True)
steps = numpy.diff(numpy.array(parts[:3]) + distance * numpy.array(parts[3:]))
shares = numpy.linspace(0.2, 99.8, 250)
figure = Figure(figsize=(7, 3.6), layout="constrained")
axes = figure.subplots()
axes.plot(numpy.percentile(numpy.linalg.norm(steps, axis=0) / MILLIMETRE, shares), shares, color="#4477aa", label="generated: hand")
axes.plot(list(RECORDED.values()), list(RECORDED), "kx", label="recorded: a hand guides a pen")
axes.set(xscale="log", xlabel="speed, mm a tick of 1 ms, on an object of 20 cm", ylabel="ticks that are slower, %")
axes.grid(color="0.9")
axes.legend(loc="lower right")
figure.savefig(ROOT / "docs" / "pictures" / "hand.svg", metadata={"Date": None})
