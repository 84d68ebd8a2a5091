/// Sized meshes of sheets and shells, and the list of all sized meshes.
#include <algorithm>
#include <array>
#include <cmath>

#include "bench/meshes/generated_meshes.h"
#include "bench/meshes/portable_noise.h"
#include "bench/meshes/portable_sincos.h"
#include "bench/meshes/sized_meshes.h"
#include "bench/meshes/surface_builder.h"

namespace touchmark::bench::meshes {
namespace {

/// Returns how many squares a side has where a patch of them has at most so many triangles.
std::uint32_t squares_for(double triangles) {
  return std::max(static_cast<std::uint32_t>(std::sqrt(triangles / 2)), 1U);
}

double rough(const Vec3& at, int octaves) {
  double height = 0, amplitude = 1, frequency = 3;
  for (int octave = 0; octave < octaves; ++octave, amplitude /= 2, frequency *= 2)
    height += amplitude * bumps(frequency * at, mixed(static_cast<std::uint64_t>(octave) + 21));
  return height;
}

/// A corner of the foam's walls, moved by up to 0.4 of a cell where it is inside.
Vec3 foam_corner(std::uint32_t row, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
  const Vec3 corner(i, j, k);
  const std::uint64_t bits = mixed((std::uint64_t{i} << 42) | (std::uint64_t{j} << 21) | k);
  const Vec3 moved(signed_unit(bits), signed_unit(mixed(bits)), signed_unit(mixed(mixed(bits))));
  return (corner + 0.4 * moved) / row;
}

}  // namespace

TriangleMesh sheets(std::uint64_t triangles) {
  constexpr int count = 8;
  constexpr double apart = 1e-4;
  const std::uint32_t squares = squares_for(static_cast<double>(triangles) / count);
  Surface surface;
  for (int sheet = 0; sheet < count; ++sheet)
    add_patch(surface, squares, squares, [&](double u, double v) {
      return Vec3(u, v, 0.1 * rough({u, v, 0}, 2) + sheet * apart);
    });
  return std::move(surface).mesh();
}

TriangleMesh shells(std::uint64_t triangles) {
  constexpr std::uint64_t count = 10;
  const TriangleMesh shell = noisy_sphere(std::max<std::uint64_t>(triangles / count, 6));
  Surface surface;
  for (std::uint64_t i = 0; i < count; ++i)
    surface.part(shell, 0.5 - 0.01 * static_cast<double>(i), Vec3::Zero());
  return std::move(surface).mesh();
}

TriangleMesh foam(std::uint64_t triangles) {
  std::uint32_t row = 1;
  const auto walls = [](std::uint64_t n) { return 3 * n * n * (n + 1); };
  while (2 * walls(row + 1) <= triangles) ++row;
  Surface surface;
  for (std::uint32_t i = 0; i <= row; ++i)
    for (std::uint32_t j = 0; j <= row; ++j)
      for (std::uint32_t k = 0; k <= row; ++k) surface.add(foam_corner(row, i, j, k));
  const auto at = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return (i * (row + 1) + j) * (row + 1) + k;
  };
  for (std::uint32_t i = 0; i <= row; ++i) {
    for (std::uint32_t j = 0; j < row; ++j) {
      for (std::uint32_t k = 0; k < row; ++k) {
        surface.quad(at(i, j, k), at(i, j + 1, k), at(i, j + 1, k + 1), at(i, j, k + 1));
        surface.quad(at(j, i, k), at(j + 1, i, k), at(j + 1, i, k + 1), at(j, i, k + 1));
        surface.quad(at(j, k, i), at(j + 1, k, i), at(j + 1, k + 1, i), at(j, k + 1, i));
      }
    }
  }
  return std::move(surface).mesh();
}

TriangleMesh terrain(std::uint64_t triangles) {
  const std::uint32_t squares = squares_for(static_cast<double>(triangles));
  Surface surface;
  add_patch(surface, squares, squares, [](double u, double v) {
    return Vec3(u, v, 0.08 * rough({u, v, 0.5}, 7));
  });
  return std::move(surface).mesh();
}

TriangleMesh blades(std::uint64_t triangles) {
  constexpr int count = 24;
  // Sixteen times as many strips along a blade's chord as along its length: triangles as long as those of
  // CAD.
  const std::uint32_t along = squares_for(static_cast<double>(triangles) / count / 16 / 2);
  Surface surface;
  for (int blade = 0; blade < count; ++blade) {
    for (const double side : {-1.0, 1.0}) {
      add_patch(surface, along, 16 * along, [&](double u, double v) {
        // Once round a thin profile, which twists by a tenth of a turn from root to tip.
        const SinCos around = portable_sincos(side * v / 2), twist = portable_sincos(0.1 + 0.1 * u),
                     place = portable_sincos(static_cast<double>(blade) / count);
        const double chord = 0.06 * around.cos, thick = 0.003 * around.sin * (1 + around.cos);
        const double z = chord * twist.cos - thick * twist.sin, aside = chord * twist.sin + thick * twist.cos;
        const double out = 0.15 + 0.35 * u;
        return Vec3(out * place.cos - aside * place.sin, out * place.sin + aside * place.cos, z);
      });
    }
  }
  return std::move(surface).mesh();
}

/// Rings that grow by a half each, from a hundred-thousandth of a half turn about one pole, which stays open.
TriangleMesh graded(std::uint64_t triangles) {
  constexpr std::uint32_t rings = 30;
  const std::uint32_t around = std::max(static_cast<std::uint32_t>(triangles / (2 * rings)), 3U);
  Surface surface;
  std::array<double, rings + 1> angle{};  // of a half turn
  angle[rings] = 0.98;
  for (std::uint32_t i = rings; i > 0; --i) angle[i - 1] = angle[i] / 1.5;
  add_patch(surface, rings, around, [&](double u, double v) {
    const SinCos latitude = portable_sincos(angle[static_cast<std::size_t>(std::lround(u * rings))] / 2),
                 longitude = portable_sincos(v);
    return Vec3(0.5 * latitude.sin * longitude.cos, 0.5 * latitude.sin * longitude.sin, 0.5 * latitude.cos);
  });
  return std::move(surface).mesh();
}

std::span<const SizedMesh> sized_meshes() {
  static constexpr SizedMesh list[] = {
      {"noisy-sphere:TRIANGLES",
       "bumpy unit sphere like a scan, of as many triangles (an odd number: one less)", 6,
       "noisy-sphere:2000", noisy_sphere},
      {"soup:N", "N unconnected triangles of all sizes in the unit cube", 1, "soup:500", soup},
      {"large-soup:TRIANGLES", "unconnected triangles, each as large as the cube they lie in", 1,
       "large-soup:120", large_soup},
      {"dust:TRIANGLES", "unconnected triangles, all small and far apart", 1, "", dust},
      {"clusters:TRIANGLES", "small balls in 12 clusters with nothing between", 20, "", clusters},
      {"pebbles:TRIANGLES", "balls, some 250 times as large as others", 20, "", pebbles},
      {"giant-quad:TRIANGLES", "two triangles as large as the box, and a small dense ball beside them", 8,
       "giant-quad:300", giant_quad},
      {"boxes:TRIANGLES", "boxes on a plain", 14, "boxes:302", boxes},
      {"crates:TRIANGLES", "a cube of boxes whose faces coincide", 12, "crates:324", crates},
      {"voxels:TRIANGLES", "the faces of a solid of cubes, as of a scanned volume", 12, "voxels:300", voxels},
      {"truss:TRIANGLES", "a lattice of thin beams", 144, "", truss},
      {"fins:TRIANGLES", "thin plates side by side on a base, each of 12 triangles", 24, "", fins},
      {"hair:TRIANGLES", "strands that curl, each a tube of three sides", 120, "hair:480", hair},
      {"wires:TRIANGLES", "straight wires from side to side, of triangles as long as they", 12, "", wires},
      {"cable:TRIANGLES", "37 strands twisted about one another", 888, "", cable},
      {"cylinder:TRIANGLES", "a cylinder whose caps are fans and whose wall is strips", 12, "cylinder:400",
       cylinder},
      {"bolts:TRIANGLES", "cylinders with heads of six sides on a plate", 228, "", bolts},
      {"gear:TRIANGLES", "a wheel with teeth, its faces fans", 48, "", gear},
      {"spring:TRIANGLES", "a tube wound 30 times", 48, "", spring},
      {"knot:TRIANGLES", "a tube that is a trefoil knot", 128, "", knot},
      {"spikes:TRIANGLES", "thin cones on a ball that is not there", 16, "", spikes},
      {"sheets:TRIANGLES", "eight wavy sheets 1e-4 apart", 16, "sheets:400", sheets},
      {"shells:TRIANGLES", "ten bumpy spheres, each inside the one before", 60, "", shells},
      {"foam:TRIANGLES", "cells that share their walls", 12, "foam:288", foam},
      {"terrain:TRIANGLES", "a rough height field", 2, "", terrain},
      {"blades:TRIANGLES", "24 thin twisted blades of long triangles", 1536, "", blades},
      {"graded:TRIANGLES", "a sphere whose triangles shrink towards a pole, 1 to 100,000", 180, "", graded},
  };
  return list;
}

}  // namespace touchmark::bench::meshes
