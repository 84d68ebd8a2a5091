/// What the paper's text says of its tables and figures, held against the reproduction.
#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/papers/choi_sung/choi_sung_claim_list.h"
#include "bench/experiments/papers/choi_sung/choi_sung_printed.h"
#include "bench/experiments/papers/choi_sung/choi_sung_report.h"
#include "bench/experiments/papers/choi_sung/choi_sung_scores.h"

namespace touchmark::bench::experiments::papers {

namespace printed = choi_sung_printed;

bool ChoiSungClaimList::complete() const {
  return std::ranges::all_of(choi_sung_methods, [this](auto m) { return find(m, 3, true) != nullptr; });
}

bool ChoiSungClaimList::is_timed() const {
  return result_.finished && std::ranges::all_of(result_.rows, [](const ChoiSungRow& row) {
           return row.scan && row.scan->ns > 0;
         });
}

std::vector<SubdivisionMethod> ChoiSungClaimList::sorted(int level, bool clustered,
                                                         const RowValue& of) const {
  std::vector<SubdivisionMethod> order(choi_sung_methods.begin(), choi_sung_methods.end());
  std::ranges::stable_sort(
      order, [&](auto a, auto b) { return value(a, level, clustered, of) < value(b, level, clustered, of); });
  return order;
}

std::string ChoiSungClaimList::why(const Reason& reason) const {
  const char* const other_mesh = "another mesh than the paper's was measured";
  if (own_mesh_) return reason.value_or("");
  return reason ? fmt::format("{}; {}", other_mesh, *reason) : other_mesh;
}

void ChoiSungClaimList::add(const char* where, std::string statement, bool holds, std::string reproduced,
                            const Reason& reason) {
  add(statement_claim(where, std::move(statement), holds, std::move(reproduced), why(reason)));
}

void ChoiSungClaimList::add_best(const char* where, const char* statement, SubdivisionMethod expected,
                                 int from_level, bool clustered, const RowValue& of, const Reason& reason) {
  std::string found;
  bool holds = true;
  for (int level = from_level; level <= 3; ++level) {
    const SubdivisionMethod best = sorted(level, clustered, of).front();
    holds = holds && value(expected, level, clustered, of) <= value(best, level, clustered, of);
    found += fmt::format("{}level {}: {}", found.empty() ? "" : ", ", level, name_of(best));
  }
  add(where, statement, holds, found, reason);
}

namespace {

void add_spheres(ChoiSungClaimList& list, int level) {
  const ChoiSungRow* single = list.find(SubdivisionMethod::ls3, level, false);
  const ChoiSungRow* clustered = list.find(SubdivisionMethod::ls3, level, true);
  if (single == nullptr || clustered == nullptr) return;
  const printed::Level& p = printed::ls3[static_cast<std::size_t>(level)];
  const std::string where = fmt::format("Table 3, LS3 level {}", level);
  const auto a = static_cast<double>(single->spheres), b = static_cast<double>(clustered->spheres);
  list.add(number_claim(where, "spheres without clustering", p.spheres, a, 0, 0.03, list.why(std::nullopt)));
  list.add(number_claim(where, "spheres with clustering", p.clustered_spheres, b, 0, 0.03,
                        list.why(visit_order_reason)));
  list.add(number_claim(where, "reduction of spheres, %", p.sphere_reduction_percent, 100 * (1 - b / a), 0,
                        0.03, list.why(visit_order_reason)));
}

/// Two of the criteria are times: a lead of a tenth of the scale may turn over in the next run.
constexpr double close_call = 0.5;

void add_score_claims(ChoiSungClaimList& list) {
  std::vector<MethodScores> scores = choi_sung_scores(list.result());
  if (scores.empty()) return;
  const auto looks = std::ranges::max_element(
      scores, [](const auto& a, const auto& b) { return a.appearance < b.appearance; });
  std::string found;
  for (const MethodScores& s : scores)
    found += fmt::format("{}{} {:.2f}", found.empty() ? "" : ", ", name_of(s.method), s.appearance);
  list.add("Graphical test, Table 2", "LS3 is the best in terms of graphics",
           looks->method == SubdivisionMethod::ls3, found,
           "creases alone would favour the method that shrinks most; half of the score is the distance to "
           "the original");
  std::ranges::stable_sort(scores, [](const auto& a, const auto& b) { return a.total() > b.total(); });
  const MethodScores &first = scores[0], &second = scores[1];
  Claim claim = statement_claim(
      "Table 2", "LS3 has the highest total score", first.method == SubdivisionMethod::ls3,
      fmt::format("{} {:.2f}, then {} {:.2f}", name_of(first.method), first.total(), name_of(second.method),
                  second.total()),
      list.why("shrinking is rewarded three times: a smaller surface has smaller creases, smaller and so "
               "tighter spheres, and fewer edges above the fixed threshold, so fewer spheres and less time; "
               "and the time is scored twice, as detection time and as update rate"));
  const bool close = first.total() - second.total() < close_call &&
                     (first.method == SubdivisionMethod::ls3 || second.method == SubdivisionMethod::ls3);
  if (close) {
    claim.agreement = Agreement::nearly;
    claim.why = "too close to call: two of the five criteria are times, and they vary from run to run";
  }
  list.add(std::move(claim));
}

void add_model_claims(ChoiSungClaimList& list) {
  const std::vector<ModelVerdict>& models = list.result().models;
  if (models.empty()) return;
  std::string found;
  bool same = true;
  const std::vector<Claim> ours = choi_sung_statements(list.result());
  for (std::size_t begin = 0, end = 0; begin < models.size(); begin = end) {
    std::size_t alike = 0;
    for (; end < models.size() && models[end].model == models[begin].model; ++end) {
      const ModelVerdict& m = models[end];
      const auto at_bunny = std::ranges::find_if(
          ours, [&](const Claim& claim) { return claim.where == m.where && claim.what == m.what; });
      const bool agrees = at_bunny != ours.end() && (at_bunny->agreement == Agreement::yes) == m.holds;
      alike += agrees ? 1 : 0;
    }
    found += fmt::format("{}{}: {} of {} as on the bunny", found.empty() ? "" : "; ", models[begin].model,
                         alike, end - begin);
    same = same && 4 * alike >= 3 * (end - begin);
  }
  list.add(
      "Discussion", "other models (tooth, clover) show a similar tendency", same, found,
      "their models are not at hand: these are generated; models.csv has each statement on each of them");
}

}  // namespace

std::vector<Claim> choi_sung_tool_counts(const ChoiSungResult& result, bool own_mesh) {
  ChoiSungClaimList list(result, own_mesh);
  for (std::size_t m = 0; m < choi_sung_methods.size(); ++m) {
    for (int level = 1; level <= 3; ++level) {
      const ChoiSungRow* row = list.find(choi_sung_methods[m], level, false);
      if (row == nullptr) continue;
      list.add(number_claim(fmt::format("MeshLab, level {}", level),
                            fmt::format("triangles of {}", name_of(choi_sung_methods[m])),
                            printed::tool_triangles[m][static_cast<std::size_t>(level - 1)],
                            static_cast<double>(row->surface.triangles), 0, 0.03, list.why(std::nullopt)));
    }
  }
  return list.take();
}

std::vector<Claim> choi_sung_statements(const ChoiSungResult& result) {
  ChoiSungClaimList list(result, true);
  if (list.complete()) {
    add_surface_claims(list);
    add_sphere_claims(list);
  }
  return list.take();
}

std::vector<Claim> choi_sung_claims(const ChoiSungResult& result, bool own_mesh) {
  ChoiSungClaimList list(result, own_mesh);
  for (int level = 0; level <= 3; ++level) add_spheres(list, level);
  if (list.is_timed()) {
    for (int level = 0; level <= 3; ++level) add_time_claims(list, level);
  }
  if (!list.complete()) return list.take();
  add_surface_claims(list);
  add_sphere_claims(list);
  if (list.is_timed()) {
    add_time_statements(list);
    add_score_claims(list);
  }
  add_model_claims(list);
  return list.take();
}

}  // namespace touchmark::bench::experiments::papers
