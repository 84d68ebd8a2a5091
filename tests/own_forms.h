/// The forms of our own detectors, as their entries list them, and the exact ones among these built of a
/// mesh.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/contestants/built_in.h"
#include "bench/contestants/contestant.h"

namespace touchmark {

inline const bench::contestants::Roster& own_roster() {
  static const bench::contestants::Roster ours(bench::contestants::own_entries());
  return ours;
}

/// Returns those that can be asked for the side, in their default form.
inline std::vector<bench::contestants::ContestantSpec> own_forms_with_side() {
  std::vector<bench::contestants::ContestantSpec> specs;
  for (const bench::contestants::ContestantInfo& info : own_roster().contestants()) {
    if (!info.scenes_only) specs.push_back(own_roster().parse(info.name + ":side=on"));
  }
  return specs;
}

/// Returns every form that `bench` and `verify` ask, and those that only tests do. Brute force comes first.
inline std::vector<bench::contestants::ContestantSpec> own_forms() {
  std::vector<bench::contestants::ContestantSpec> specs = own_roster().thorough_set();
  for (auto& spec : own_roster().forms(&bench::contestants::Forms::tested)) specs.push_back(std::move(spec));
  return specs;
}

struct ExactForm {
  std::string name;
  std::unique_ptr<bench::contestants::Contestant> detector;
  bool as_published = false;
};

/// How finely fields are divided. Around a few triangles that lie across each other those as listed take
/// seconds to build under a sanitizer.
enum class Fields { as_listed, coarse };

/// Brute force comes first: the others must give its bits.
inline std::vector<ExactForm> exact_forms(const TriangleMesh& mesh, Fields fields = Fields::as_listed) {
  constexpr double largest = 1e300;  // of which percents are taken
  const bool has_percents = mesh.diagonal() < largest;
  std::vector<ExactForm> forms;
  for (bench::contestants::ContestantSpec& spec : own_forms()) {
    if (spec.claimed != Guarantee::exact) continue;
    if (spec.options.find('%') != std::string::npos && !has_percents) continue;
    if (spec.name == "field" && fields == Fields::coarse && has_percents)
      spec = own_roster().parse(spec.text() + ",error=10%");
    forms.push_back({spec.text(), own_roster().build(spec, mesh), spec.options.starts_with("lookup=scan")});
  }
  return forms;
}

}  // namespace touchmark
