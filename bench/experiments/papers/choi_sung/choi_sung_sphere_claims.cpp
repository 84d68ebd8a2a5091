/// What Choi & Sung say of the spheres: Figs 6 and 9, their centres, the distance of clustering.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>

#include "bench/experiments/papers/choi_sung/choi_sung_claim_list.h"

namespace touchmark::bench::experiments::papers {
namespace {

using enum SubdivisionMethod;

/// "a 1.000, b 1.100": the methods at a level by a value, the least first.
std::string order_text(const ChoiSungClaimList& list, int level, const RowValue& of) {
  std::string text;
  for (const SubdivisionMethod method : list.sorted(level, false, of))
    text += fmt::format("{}{} {:.3f}", text.empty() ? "" : ", ", name_of(method),
                        list.value(method, level, false, of));
  return text;
}

void add_tightness(ChoiSungClaimList& list) {
  const std::vector<SubdivisionMethod> printed{catmull_clark_linear, mid_point, butterfly, ls3, loop};
  const RowValue absolute = [](const ChoiSungRow& row) { return row.relative_tightness; };
  const RowValue scale_free = [](const ChoiSungRow& row) { return row.relative_looseness; };
  const Reason reason =
      "the formula as printed adds lengths, so it favours the surfaces that shrink and the triangles that "
      "are small; the next row reads it without a scale";
  list.add_best("Fig. 6", "Catmull-Clark is the tightest at levels 2 and 3", catmull_clark_linear, 2, false,
                absolute, reason);
  list.add("Fig. 6", "then Mid-point, Butterfly, LS3, Loop follow (level 3)",
           list.sorted(3, false, absolute) == printed, order_text(list, 3, absolute), reason);
  list.add("Fig. 6, read without a scale",
           "at levels 2 and 3 the order is Catmull-Clark, Mid-point, Butterfly, LS3, Loop",
           list.sorted(2, false, scale_free) == printed && list.sorted(3, false, scale_free) == printed,
           fmt::format("level 2: {}; level 3: {}; Mid-point's neighbours lie on the spheres, so rounding "
                       "decides where it stands",
                       order_text(list, 2, scale_free), order_text(list, 3, scale_free)),
           "mean of (radius - distance) / radius, Catmull-Clark's quadrilaterals cut between the levels");
  bool tighter = true;
  for (const auto m : choi_sung_methods)
    for (int level = 1; level <= 3; ++level) tighter = tighter && list.value(m, level, false, absolute) < 1;
  list.add("Fig. 6", "spheres of a refined model are tighter than the original's", tighter,
           fmt::format("{:.3f} to {:.3f} of the original's at level 3, by the formula as printed",
                       list.value(list.sorted(3, false, absolute).front(), 3, false, absolute),
                       list.value(list.sorted(3, false, absolute).back(), 3, false, absolute)));
}

void add_sphere_centres(ChoiSungClaimList& list) {
  int smaller = 0, all = 0;
  std::string found;
  for (const auto m : choi_sung_methods) {
    for (int level = m == butterfly ? 0 : 1; level <= 3; ++level, ++all) {
      const SurfaceMeasures& s = list.find(m, level, false)->surface;
      smaller += s.centroid_radius < s.circumradius ? 1 : 0;
    }
  }
  const SurfaceMeasures& original = list.find(ls3, 0, false)->surface;
  list.add("Prior work", "spheres about centroids have smaller mean radii than about circumcentres",
           2 * smaller > all,
           fmt::format("on {} of {} surfaces; {:.4f} against {:.4f} on the original", smaller, all,
                       original.centroid_radius, original.circumradius),
           "about the circumcentre lies the smallest sphere through the corners of a triangle without an "
           "obtuse angle; only an obtuse one gains by the centroid");
}

void add_sphere_counts(ChoiSungClaimList& list) {
  bool holds = true;
  std::string found;
  const RowValue spheres = [](const auto& r) { return static_cast<double>(r.spheres); };
  for (const bool clustered : {false, true}) {
    const SubdivisionMethod method = list.sorted(3, clustered, spheres).front();
    holds = holds && (method == loop || method == ls3);
    found += fmt::format("{}{} clustering: {}", clustered ? ", " : "", clustered ? "with" : "without",
                         name_of(method));
  }
  list.add("Fig. 9", "Loop and LS3 have the fewest spheres at level 3", holds, found, visit_order_reason);
  const auto growth = [&](bool clustered) {
    return list.value(ls3, 3, clustered, spheres) / list.value(ls3, 0, clustered, spheres);
  };
  list.add("Fig. 9", "with clustering the spheres grow slightly with the levels, without it rapidly (LS3)",
           growth(true) < growth(false) / 3,
           fmt::format("{:.1f} times with, {:.1f} times without", growth(true), growth(false)));
  const std::vector<double> reductions = over_levels(0, [&](int level) {
    return 1 - list.value(ls3, level, true, spheres) / list.value(ls3, level, false, spheres);
  });
  list.add("Discussion", "the reduction of the spheres grows with the level (LS3)", rises(reductions),
           fmt::format("{:.0f} % at level 3", 100 * reductions.back()));
}

/// Bottom-up against top-down, by the paper's tightness.
void add_partitions(ChoiSungClaimList& list) {
  int tighter = 0, all = 0, published = 0;
  std::string found;
  for (const ChoiSungRow& row : list.result().rows) {
    if (!row.partitions) continue;
    ++all;
    tighter += row.partitions->bottom_up < row.partitions->top_down ? 1 : 0;
    published += row.partitions->published < row.partitions->top_down ? 1 : 0;
    if (row.surface.method == name_of(ls3) && row.surface.level == 3)
      found = fmt::format("LS3 level 3: {:.4f} against {:.4f}, and {:.4f} about centroids as published",
                          row.partitions->bottom_up, row.partitions->top_down, row.partitions->published);
  }
  if (all == 0) return;
  list.add("Related works", "spheres made bottom-up are tighter than made top-down", 2 * published > all,
           fmt::format("as published on {} of {} clustered surfaces; in the smallest spheres about the same "
                       "clusters on {}; {}",
                       published, all, tighter, found),
           "top-down: as many parts by halving the longest side, in their smallest spheres; the clusters are "
           "as good a partition, but spheres about a first triangle's centroid are larger than they need to "
           "be. Ruspini's and Weller's own programs are not at hand");
}

/// "the time complexity can be reduced to logarithms".
void add_hierarchy(ChoiSungClaimList& list) {
  const ChoiSungRow &coarse = *list.find(ls3, 0, false), &fine = *list.find(ls3, 3, false);
  if (!coarse.tree || !fine.tree || !(coarse.tree->work > 0)) return;
  const double spheres = static_cast<double>(fine.spheres) / static_cast<double>(coarse.spheres),
               grown = fine.tree->work / coarse.tree->work;
  list.add("Related works", "a hierarchy reduces the number of tests to logarithms",
           grown < std::log2(spheres),
           fmt::format("LS3 level 3 has {:.0f} times the spheres; the exact tree looks at {:.1f} times as "
                       "much, {:.0f} tests",
                       spheres, grown, fine.tree->work));
}

/// "The more we applied surface subdivision, the more the results became precise": of the surfaces
/// themselves, which the exact forms and the scans answer for.
void add_precision(ChoiSungClaimList& list) {
  std::map<std::string, std::map<int, double>> errors;
  for (const DistanceRow& row : list.result().distances)
    if (row.mesh == "paper" && row.clustering == 0 && row.mean_error)
      errors[row.method][row.level] = *row.mean_error;
  if (errors.count("original") == 0 || errors.count("ls3") == 0) return;
  const double original = errors["original"][0];
  bool falls = true;
  std::string found;
  for (const auto& [method, by_level] : errors) {
    if (method == "original") continue;
    double last = original;
    for (const auto& [level, error] : by_level) {
      falls = falls && error < last;
      last = error;
    }
    found += fmt::format("{}{} {:.2f}", found.empty() ? "" : ", ", method, last / original);
  }
  list.add("Abstract", "the more subdivision, the more precise the detection", falls,
           fmt::format("error to the smooth surface at the finest level over the original's: {}", found),
           "smaller triangles are no gain by themselves: Mid-point and the tool's Catmull-Clark answer as "
           "the original does, Loop goes to a surface of its own, and LS3 goes to this smooth surface, which "
           "is its limit; precision as the paper defines it is the triangles' size (Fig. 8)");
}

/// The distance with the least tests, and with the least time, of a mesh and a method at its finest level.
struct BestDistance {
  const DistanceRow *by_tests = nullptr, *by_time = nullptr;
};

void add_distances(ChoiSungClaimList& list) {
  std::map<std::string, BestDistance> best;
  double paper = 0;
  for (const ChoiSungRow& row : list.result().rows) paper = std::max(paper, row.clustering);
  for (const DistanceRow& row : list.result().distances) {
    if (row.mesh != "paper" || row.level != 3) continue;
    BestDistance& b = best[row.method];
    if (b.by_tests == nullptr || row.tests_per_query < b.by_tests->tests_per_query) b.by_tests = &row;
    if (row.ns && (b.by_time == nullptr || *row.ns < *b.by_time->ns)) b.by_time = &row;
  }
  if (best.empty()) return;
  const auto times_paper = [&](const DistanceRow* row) { return row->clustering / paper; };
  std::string tests, time;
  bool tests_hold = true, time_holds = true, timed = true;
  for (const auto& [method, b] : best) {
    tests += fmt::format("{}{} {:.2g}", tests.empty() ? "" : ", ", method, times_paper(b.by_tests));
    tests_hold = tests_hold && std::abs(times_paper(b.by_tests) - 1) < 0.01;
    if (!(timed = timed && b.by_time != nullptr)) continue;
    time += fmt::format("{}{} {:.2g}", time.empty() ? "" : ", ", method, times_paper(b.by_time));
    time_holds = time_holds && std::abs(times_paper(b.by_time) - 1) < 0.01;
  }
  const char* const what = "0.02 is the optimal clustering distance (level 3)";
  const Reason reason = "the best of those tried, as multiples of the paper's distance";
  list.add("Collision detection test, in tests", what, tests_hold, tests, reason);
  if (timed) list.add("Collision detection test, in time", what, time_holds, time, reason);
}

/// The paper's distance was chosen on other models: do different models at least agree on one?
void add_model_distances(ChoiSungClaimList& list) {
  std::map<std::string, const DistanceRow*> best;
  std::map<std::string, double> paper;  // the fourth of those tried
  for (const DistanceRow& row : list.result().distances) {
    if (row.mesh == "paper") continue;
    const DistanceRow*& found = best[row.mesh];
    if (found == nullptr || row.tests_per_query < found->tests_per_query) found = &row;
    if (row.clustering > 0 && paper.count(row.mesh) == 0) paper[row.mesh] = 4 * row.clustering;
  }
  if (best.empty()) return;
  std::string found;
  bool same = true;
  for (const auto& [model, row] : best) {
    const double times = row->clustering / paper[model];
    same = same && std::abs(times - 1) < 0.01;
    found += fmt::format("{}{} {:.2g}", found.empty() ? "" : ", ", model, times);
  }
  list.add("Collision detection test, in tests", "0.02 is the optimal distance for tooth, clover and hat",
           same, found,
           "multiples of the bunny's distance, both in parts of the box diagonal, LS3 at the finest level; "
           "their models and the unit of 0.02 are not known");
}

}  // namespace

void add_sphere_claims(ChoiSungClaimList& list) {
  add_tightness(list);
  add_sphere_counts(list);
  add_sphere_centres(list);
  add_partitions(list);
  add_hierarchy(list);
  add_precision(list);
  add_distances(list);
  add_model_distances(list);
}

}  // namespace touchmark::bench::experiments::papers
