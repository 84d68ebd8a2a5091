#include "bench/experiments/papers/tuning.h"

#include <tuple>

#include <fmt/format.h>

namespace touchmark::bench::experiments::papers {

bool holds_rate(const FrontierPoint& point, double rate) {
  return point.ns_p99 && *point.ns_p99 * rate <= 1e9;
}

Tuned tune(const FrontierResult& result, double rate) {
  Tuned tuned;
  const auto better = [](const FrontierPoint& a, const FrontierPoint& b) {
    return std::tie(a.error.mean, a.ns) < std::tie(b.error.mean, b.ns);
  };
  for (const FrontierPoint& point : result.points) {
    if (!holds_rate(point, rate)) continue;
    const bool published = point.form == "scan" || point.form == "fast level";
    std::optional<FrontierPoint>& kept = published ? tuned.published : tuned.fast;
    if (!kept || better(point, *kept)) kept = point;
  }
  return tuned;
}

std::string detector_of(const FrontierPoint& point) {
  if (point.form == "grid") return "grid-group";
  if (point.form == "tree") return "sphere-cluster";
  std::string text = "sphere-cluster:lookup=scan";
  if (point.clustering > 0) text += fmt::format(",clustering={:.6g}", point.clustering);
  if (point.form == "fast level") text += ",precise=false";
  return text;
}

}  // namespace touchmark::bench::experiments::papers
