/// Choi & Sung's graphical test: what subdivision makes of the surface.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/experiments/papers/choi_sung/choi_sung_claim_list.h"

namespace touchmark::bench::experiments::papers {
namespace {

using enum SubdivisionMethod;

constexpr double flat = 1e-3;  // of the volume: what counts as kept

double growth_of_vertices(const ChoiSungClaimList& list, SubdivisionMethod method, int level) {
  const auto at = [&](int l) { return static_cast<double>(list.find(method, l, false)->surface.vertices); };
  return at(level) / at(level - 1);
}

void add_growth(ChoiSungClaimList& list) {
  double low = 1e9, high = 0;
  for (const auto m : {butterfly, mid_point, loop, ls3}) {
    for (int level = 1; level <= 3; ++level) {
      low = std::min(low, growth_of_vertices(list, m, level));
      high = std::max(high, growth_of_vertices(list, m, level));
    }
  }
  list.add("Graphical test", "the vertices of all but Catmull-Clark grow 3 or 4 times a level",
           low > 2.5 && high < 4.5, fmt::format("{:.2f} to {:.2f} times", low, high));
  const double first = growth_of_vertices(list, catmull_clark_linear, 1),
               second = growth_of_vertices(list, catmull_clark_linear, 2),
               third = growth_of_vertices(list, catmull_clark_linear, 3);
  Claim claim = statement_claim(
      "Graphical test", "the vertices of Catmull-Clark grow 4.5 to 6 times a level",
      std::min(second, third) >= 4.5, fmt::format("{:.2f}, {:.2f}, {:.2f} times", first, second, third),
      list.why(
          "the tool remembers that its faces are quadrilaterals, and splits each in four from level 2 on"));
  if (claim.agreement == Agreement::no && first >= 4.5 && first <= 6.05) claim.agreement = Agreement::nearly;
  list.add(std::move(claim));
}

/// "nearly double the amount of other methods".
void add_double_vertices(ChoiSungClaimList& list) {
  const RowValue vertices = [](const ChoiSungRow& row) { return static_cast<double>(row.surface.vertices); };
  double others = 0;
  for (const auto m : {butterfly, mid_point, loop, ls3}) others += list.value(m, 3, false, vertices) / 4;
  const double times = list.value(catmull_clark_linear, 3, false, vertices) / others;
  list.add("Graphical test", "Catmull-Clark makes nearly double the vertices of the others",
           times > 1.6 && times < 2.4, fmt::format("{:.2f} times at level 3", times));
}

void add_triangle_shapes(ChoiSungClaimList& list) {
  const RowValue ratio = [](const ChoiSungRow& row) { return row.surface.mean_edge_ratio; };
  const double original = list.value(loop, 0, false, ratio);
  const double clark = list.value(catmull_clark_linear, 3, false, ratio);
  const double mid = list.value(mid_point, 3, false, ratio);
  const auto others = list.sorted(3, false, ratio);
  list.add(
      "Graphical test", "Catmull-Clark's triangles are elongated",
      clark > original && others.back() == catmull_clark_linear,
      fmt::format("longest edge over shortest {:.2f} at level 3, {:.2f} in the original", clark, original),
      "of this mesh's triangles others are longer");
  list.add("Graphical test", "Mid-point's triangles are equilateral", mid < 1.1,
           fmt::format("longest edge over shortest {:.2f} at level 3, {:.2f} in the original", mid, original),
           "halving every edge makes four triangles of the parent's shape, whatever that is; where only the "
           "long edges split the shape gets a little rounder");
}

void add_volumes(ChoiSungClaimList& list) {
  const RowValue volume = [](const ChoiSungRow& row) { return row.surface.relative_volume; };
  const RowValue kept = [](const ChoiSungRow& row) { return -std::abs(row.surface.relative_volume - 1); };
  bool all_kept = true, loop_worst = true;
  for (int level = 1; level <= 3; ++level) {
    for (const auto m : {catmull_clark_linear, mid_point})
      all_kept = all_kept && std::abs(list.value(m, level, false, volume) - 1) < flat;
    loop_worst = loop_worst && list.sorted(level, false, kept).front() == loop;
  }
  const std::vector<double> of_loop =
      over_levels(0, [&](int level) { return list.value(loop, level, false, volume); });
  list.add("Fig. 3", "Catmull-Clark and Mid-point keep the volume", all_kept,
           fmt::format("{:.4f}, {:.4f} at level 3", list.value(catmull_clark_linear, 3, false, volume),
                       list.value(mid_point, 3, false, volume)));
  list.add("Fig. 3", "Loop is the worst in volume", loop_worst,
           fmt::format("{:.3f} at level 3", of_loop.back()));
  list.add("Graphical test", "Loop shrinks more with each level", falls(of_loop),
           fmt::format("volume {:.3f}", fmt::join(std::span(of_loop).subspan(1), ", ")));
  const double share = list.find(loop, 3, false)->surface.shrinkage_at_creases;
  list.add(
      "Graphical test", "Loop's shrinkage is noticeable where the surface is highly curved", share > 1.5,
      fmt::format("the tenth of the vertices with the sharpest edges is {:.2f} times as far off", share));
}

/// Dents: where the original is convex they add to its concave edges, elsewhere they deepen them.
void add_dents(ChoiSungClaimList& list) {
  const RowValue bending = [](const ChoiSungRow& row) { return row.surface.concave_bending; };
  const double original = list.value(loop, 0, false, bending);
  if (!(original > 0)) return;
  std::string found;
  for (const SubdivisionMethod m : choi_sung_methods)
    found += fmt::format("{}{} {:.2f}", found.empty() ? "" : ", ", name_of(m),
                         list.value(m, 3, false, bending) / original);
  const double dented = list.value(butterfly, 3, false, bending);
  list.add("Graphical test", "Butterfly makes dented regions",
           dented > 1.1 * original && list.sorted(3, false, bending).back() == butterfly,
           fmt::format("concave bending (length times angle) over the original's: {}", found),
           "a dent adds concave edges, which are summed here; the paper does not say what it calls dented");
  list.add("Related works", "approximating schemes undulate less than interpolating ones",
           list.value(loop, 3, false, bending) < dented && list.value(ls3, 3, false, bending) < dented,
           "by the same sums, Loop and LS3 against Butterfly");
}

void add_kept_places(ChoiSungClaimList& list) {
  const auto kept = [&](SubdivisionMethod m) { return list.find(m, 3, false)->surface.keeps_vertices; };
  list.add("Related works", "Butterfly interpolates: the original vertices stay", kept(butterfly),
           kept(butterfly) ? "all on the surface at level 3" : "some are off the surface at level 3");
  const auto yes_no = [&](SubdivisionMethod m) { return kept(m) ? "stay" : "move"; };
  list.add("Related works", "Catmull-Clark, Loop, Mid-point and LS3 approximate: the original vertices move",
           !kept(catmull_clark_linear) && !kept(loop) && !kept(mid_point) && !kept(ls3),
           fmt::format("Catmull-Clark: {}, Loop: {}, Mid-point: {}, LS3: {}", yes_no(catmull_clark_linear),
                       yes_no(loop), yes_no(mid_point), yes_no(ls3)),
           "Mid-point moves nothing, and what the tool calls Catmull-Clark interpolates linearly; the paper "
           "says so itself where it finds that both maintain the original surface");
}

void add_smoothness(ChoiSungClaimList& list) {
  const RowValue crease = [](const ChoiSungRow& row) { return row.surface.crease_deg; };
  double smooth = 0, facets = 1e9;
  for (const auto m : {butterfly, loop, ls3}) smooth = std::max(smooth, list.value(m, 3, false, crease));
  for (const auto m : {catmull_clark_linear, mid_point})
    facets = std::min(facets, list.value(m, 3, false, crease));
  list.add("Graphical test", "Butterfly, Loop and LS3 are smoother than Catmull-Clark and Mid-point",
           smooth < facets,
           fmt::format("creases at level 3: at most {:.1f} against at least {:.1f} degrees", smooth, facets));
  Claim claim = statement_claim(
      "Related works", "approximating schemes are smoother than interpolating ones, in most cases",
      facets < list.value(butterfly, 3, false, crease),
      fmt::format("creases at level 3: Butterfly {:.1f}, LS3 {:.1f}, Loop {:.1f}, Mid-point {:.1f}, "
                  "Catmull-Clark {:.1f}",
                  list.value(butterfly, 3, false, crease), list.value(ls3, 3, false, crease),
                  list.value(loop, 3, false, crease), list.value(mid_point, 3, false, crease),
                  list.value(catmull_clark_linear, 3, false, crease)),
      list.why("Loop and LS3 are; Mid-point and the tool's Catmull-Clark, which the paper calls "
               "approximating, keep the facets"));
  if (list.value(loop, 3, false, crease) < list.value(butterfly, 3, false, crease) &&
      list.value(ls3, 3, false, crease) < list.value(butterfly, 3, false, crease) &&
      claim.agreement == Agreement::no)
    claim.agreement = Agreement::nearly;
  list.add(std::move(claim));
  const std::vector<double> creases =
      over_levels(0, [&](int level) { return list.value(ls3, level, false, crease); });
  const double off = std::ranges::max(over_levels(
      1, [&](int level) { return std::abs(list.find(ls3, level, false)->surface.relative_volume - 1); }));
  list.add("Discussion", "LS3 gets smoother with every step and keeps the original's size",
           falls(creases) && off < 0.05,
           fmt::format("creases {:.1f} to {:.1f} degrees, volume within {:.1f} %", creases.front(),
                       creases.back(), 100 * off));
}

/// "maintaining the original surfaces".
void add_kept_surfaces(ChoiSungClaimList& list) {
  const RowValue offset = [](const ChoiSungRow& row) { return row.surface.mean_offset; };
  const double clark = list.value(catmull_clark_linear, 3, false, offset),
               mid = list.value(mid_point, 3, false, offset), ls = list.value(ls3, 3, false, offset);
  list.add("Graphical test", "Catmull-Clark and Mid-point maintain the original surface",
           std::max(clark, mid) < flat * ls,
           fmt::format("mean distance to it at level 3: {:.2g} and {:.2g}, LS3 {:.2g}", clark, mid, ls));
}

}  // namespace

void add_surface_claims(ChoiSungClaimList& list) {
  add_growth(list);
  add_double_vertices(list);
  add_triangle_shapes(list);
  add_volumes(list);
  add_kept_surfaces(list);
  add_kept_places(list);
  add_smoothness(list);
  add_dents(list);
  list.add_best("Fig. 7", "Catmull-Clark makes the most triangles", catmull_clark_linear, 1, false,
                [](const auto& r) { return -static_cast<double>(r.surface.triangles); });
  list.add_best("Fig. 8", "Catmull-Clark makes the smallest triangles", catmull_clark_linear, 1, false,
                [](const auto& r) { return r.surface.mean_area; });
  const auto areas = [&](SubdivisionMethod method) {
    return over_levels(0, [&](int level) { return list.find(method, level, false)->surface.mean_area; });
  };
  list.add("Fig. 8", "the mean area of a triangle falls with every level",
           std::ranges::all_of(choi_sung_methods, [&](auto method) { return falls(areas(method)); }),
           fmt::format("LS3: {:.3g} to {:.3g}", areas(ls3).front(), areas(ls3).back()));
}

}  // namespace touchmark::bench::experiments::papers
