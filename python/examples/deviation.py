#!/usr/bin/python3
# %% [markdown]
# Closest points on a scan: where does a made part differ from its design?
# The part is a torus with a dent and a weld bead; a scanner has measured points on it, with some noise.
# Run it as a script, or cell by cell in an editor that knows `# %%`.

# %%
import argparse

import matplotlib
import numpy as np

import touchmark

parser = argparse.ArgumentParser(description="draws where a scan differs from its design")
parser.add_argument("--out", default="deviation.png")
out = parser.parse_args().out
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  after the choice of where to draw


# %% The design: a torus as a mesh.
def torus(u, v, tube=0.35):
    tube = np.asarray(tube)
    return np.stack([(1 + tube * np.cos(v)) * np.cos(u), (1 + tube * np.cos(v)) * np.sin(u), tube * np.sin(v)], -1)


around, across = 240, 80
u, v = np.meshgrid(np.arange(around) * 2 * np.pi / around, np.arange(across) * 2 * np.pi / across, indexing="ij")
i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
a, b = i * across + j, (i + 1) % around * across + j
c, d = (i + 1) % around * across + (j + 1) % across, i * across + (j + 1) % across
faces = np.concatenate([np.stack(corners, -1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))])
design = touchmark.Mesh(torus(u, v).reshape(-1, 3), faces)

# %% The scan: 60,000 points of the part as it was made, along scan lines, with noise.
random = np.random.default_rng(3)
u = np.repeat(np.linspace(0, 2 * np.pi, 300), 200)
v = np.tile(np.linspace(0, 2 * np.pi, 200), 300)
dent = -0.03 * np.exp(-((u - 2.2) ** 2 + (v - 0.9) ** 2) / 0.12)
bead = 0.015 * np.exp(-((u - 4.5) / 0.06) ** 2)
scan = torus(u, v, 0.35 + dent + bead) + random.normal(0, 0.0008, (len(u), 3))

# %% The closest point of the design for each, and on which side of its surface it is.
detector = touchmark.SphereCluster(design)
closest = detector.nearest(scan, threads=0)
signed = np.where(detector.side(scan, threads=0) == touchmark.Side.INSIDE, -1, 1) * closest.distance
print(f"{len(scan)} points: {signed.min():+.4f} to {signed.max():+.4f}, "
      f"{100 * np.mean(np.abs(signed) > 0.005):.1f} % farther than 0.005")

# %% A picture: the scan as seen from above, and all deviations.
figure, (view, counts) = plt.subplots(1, 2, figsize=(10, 4.4), width_ratios=(1.25, 1), layout="constrained")
upper = scan[:, 2] > 0
limit = np.abs(signed).max()
points = view.scatter(*scan[upper, :2].T, c=signed[upper], s=1.5, cmap="RdBu_r", vmin=-limit, vmax=limit, linewidths=0)
view.set_aspect("equal")
view.set(title="Deviation of the scan from the design, seen from above", xlabel="x", ylabel="y")
view.title.set_size(10)
figure.colorbar(points, ax=view, label="signed distance (outside > 0)")
counts.hist(signed, bins=120, color="#4477aa")
counts.set_yscale("log")
counts.set(title="All points", xlabel="signed distance", ylabel="points")
counts.title.set_size(10)
figure.savefig(out, dpi=130)
