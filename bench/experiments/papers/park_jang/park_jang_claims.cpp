/// What Park & Jang print, held against the reproduction: one verdict a statement. Their mesh's size is not
/// stated, so a number agrees if it comes out on some mesh of those tried. "Certain" is what the badly
/// scanned text says in two places, "likely" what it says in one.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "bench/experiments/papers/park_jang/park_jang.h"
#include "bench/support/median.h"

namespace touchmark::bench::experiments::papers {
namespace {

using CurveValue = std::function<std::optional<double>(const ParkJangCurve&)>;

std::vector<ParkJangCurve> of_shape(const ParkJangResult& result, const std::string& shape) {
  std::vector<ParkJangCurve> curves = park_jang_curves(result);
  std::erase_if(curves, [&](const ParkJangCurve& curve) { return curve.shape != shape; });
  return curves;
}

/// "61 of 948 triangles, 70 of 3851": a value of every mesh.
std::string listed(const std::vector<ParkJangCurve>& curves, const CurveValue& value) {
  std::string text;
  for (const ParkJangCurve& curve : curves) {
    const std::optional<double> found = value(curve);
    text += fmt::format("{}{} ({} triangles)", text.empty() ? "" : ", ",
                        found ? fmt::format("{:.0f}", *found) : "none", curve.triangles);
  }
  return text;
}

/// yes within a quarter of the printed number on some mesh, nearly within a factor of two.
Claim some_mesh_claim(const char* where, const char* what, double printed,
                      const std::vector<ParkJangCurve>& curves, const CurveValue& value) {
  Claim claim{where, what, fmt::format("about {:.0f}", printed), listed(curves, value), Agreement::no};
  double nearest = 1e9;
  for (const ParkJangCurve& curve : curves)
    if (const auto found = value(curve)) nearest = std::min(nearest, std::abs(std::log2(*found / printed)));
  claim.agreement = nearest <= std::log2(1.25) ? Agreement::yes
                    : nearest <= 1             ? Agreement::nearly
                                               : Agreement::no;
  if (claim.agreement != Agreement::yes)
    claim.why = "the paper states neither its mesh's size nor its path; the number depends on both";
  return claim;
}

/// Spheres' operations and times over those of cuboids in the same cells, up to the printed turn.
struct SpheresOverCubes {
  std::vector<double> operations, times;
};

SpheresOverCubes over_cubes(const ParkJangResult& result, const std::string& shape) {
  SpheresOverCubes found;
  for (const ParkJangRow& sphere : result.rows) {
    if (sphere.form != shape || sphere.groups < 8 || sphere.groups > park_jang_turn) continue;
    for (const ParkJangRow& cube : result.rows) {
      if (cube.form != "cube" || cube.mesh != sphere.mesh || cube.groups != sphere.groups) continue;
      if (cube.counted.mean > 0)
        found.operations.push_back(operations_of(sphere, sphere.counted.mean) /
                                   operations_of(cube, cube.counted.mean));
      if (cube.timed && sphere.timed && cube.timed->ns > 0)
        found.times.push_back(sphere.timed->ns / cube.timed->ns);
    }
  }
  return found;
}

Claim spheres_claim(const ParkJangResult& result, const char* shape, const char* kind) {
  const SpheresOverCubes ratios = over_cubes(result, shape);
  const auto more = [](const std::vector<double>& all) {
    return 4 * std::ranges::count_if(all, [](double r) { return r > 1; }) >=
           3 * static_cast<std::ptrdiff_t>(all.size());
  };
  Claim claim{"Fig. 7", fmt::format("spheres ({}) are slower than cuboids", kind), "holds",
              fmt::format("{:.2f} times the operations, {:.2f} times the time (medians of 8 to {} groups)",
                          support::median(ratios.operations), support::median(ratios.times), park_jang_turn)};
  claim.agreement = !more(ratios.operations)                     ? Agreement::no
                    : ratios.times.empty() || more(ratios.times) ? Agreement::yes
                                                                 : Agreement::nearly;
  if (claim.agreement != Agreement::yes)
    claim.why =
        "a sphere holds more space than the cuboid of the same triangles, so more triangles are tested; but "
        "its own test is the cheaper one here (a squared distance, no root), which decides where groups are "
        "many";
  return claim;
}

Claim rise_claim(const ParkJangResult& result) {
  bool holds = true;
  std::string found;
  for (const ParkJangRow& row : result.rows) {
    const bool last =
        &row == &result.rows.back() || (&row + 1)->form != "cube" || (&row + 1)->mesh != row.mesh;
    if (row.form != "cube" || !last) continue;
    holds = holds && row.groups_per_triangle > 1;
    found += fmt::format("{}{} groups hold a triangle {:.1f} times", found.empty() ? "" : ", ", row.groups,
                         row.groups_per_triangle);
  }
  return statement_claim("Fig. 7",
                         "it rises since groups are tested one by one and a mesh lies in several of them",
                         holds, found, "no triangle lies in two groups");
}

Claim pictured_claim(const char* where, const char* what, std::size_t printed, std::size_t found) {
  return number_claim(where, what, static_cast<double>(printed), static_cast<double>(found), 0, 0.01,
                      "cells come in steps on this mesh");
}

Claim ungrouped_claim(const ParkJangResult& result) {
  std::string found;
  for (const ParkJangRow& row : result.rows)
    if (row.form == "ungrouped" && row.timed && row.timed->ns > 0)
      found += fmt::format("{}{:.3g} ({} triangles)", found.empty() ? "" : ", ", row.timed->ns * 1e-6,
                           row.triangles);
  return {"Fig. 7 (certain)",
          "ungrouped time, ms",
          "about 1",
          found,
          Agreement::not_comparable,
          "neither their machine nor their mesh's size is stated"};
}

}  // namespace

std::vector<Claim> park_jang_claims(const ParkJangResult& result) {
  std::vector<Claim> claims;
  if (!result.finished) return claims;
  const std::vector<ParkJangCurve> cubes = of_shape(result, "cube");
  if (cubes.empty()) return claims;
  claims.push_back(ungrouped_claim(result));
  claims.push_back(some_mesh_claim("Fig. 7 (certain)", "groups from where on a query takes a tenth of that",
                                   park_jang_tenth, cubes,
                                   [](const auto& curve) { return curve.tenth_from; }));
  claims.push_back(some_mesh_claim("Fig. 7 (certain)", "groups beyond which it rises again", park_jang_turn,
                                   cubes, [](const auto& curve) { return curve.rises_from; }));
  claims.push_back(rise_claim(result));
  claims.push_back(some_mesh_claim(
      "Text (likely)", "cuboids that suit the bunny best", park_jang_best_count, cubes,
      [](const auto& curve) -> std::optional<double> { return static_cast<double>(curve.best); }));
  claims.push_back(spheres_claim(result, "sphere", "smallest enclosing, as the abstract has them"));
  claims.push_back(spheres_claim(result, "centered-sphere",
                                 "about the cuboid's centre to the farthest vertex, as the text has them"));
  if (result.pictured_cubes)
    claims.push_back(pictured_claim("Fig. 5", "groups of cuboids", park_jang_cubes, *result.pictured_cubes));
  if (result.pictured_spheres)
    claims.push_back(
        pictured_claim("Fig. 6", "groups of spheres", park_jang_spheres, *result.pictured_spheres));
  const double least = std::ranges::min_element(cubes, [](const auto& a, const auto& b) {
                         return a.factor < b.factor;
                       })->factor;
  claims.push_back(
      statement_claim("Abstract", "grouping makes the detection faster", least > 1,
                      fmt::format("{:.3g} times fewer operations at least, with the best count", least), ""));
  return claims;
}

}  // namespace touchmark::bench::experiments::papers
