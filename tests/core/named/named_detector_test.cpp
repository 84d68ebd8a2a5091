#include "core/named/named_detector.h"

#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/own_forms.h"

namespace touchmark::bench {
namespace {

/// Options that the program measures with, and that no library has.
const std::set<std::string> of_the_program{"prepare", "updated", "budget"};

TriangleMesh pyramid() {
  return TriangleMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}},
                      {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
}

TEST(NamedDetector, TakesTheNamesAndOptionsOfTheCommandLine) {
  std::string names;
  for (const contestants::ContestantInfo& info : own_roster().contestants()) {
    if (NamedDetector::names().find(info.name) == std::string_view::npos) continue;
    names += (names.empty() ? "" : ", ") + info.name;
    for (const contestants::OptionInfo& option : info.options) {
      if (of_the_program.contains(option.key)) continue;
      std::vector<std::string> values = option.choices;
      if (values.empty()) values = {option.default_value};
      for (const std::string& value : values) {
        // Single precision answers no sweeps, and other forms go with a scan or with a tree alone.
        if (option.key == "precision" || value == "false") continue;
        const std::string text = info.name + ":" + option.key + "=" + value;
        EXPECT_NO_THROW(NamedDetector::build(pyramid(), text)) << text;
      }
    }
  }
  EXPECT_EQ(names, NamedDetector::names());
}

TEST(NamedDetector, RefusesForThePublishedFormWhatOnlyTheFastOneHas) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      NamedDetector::build(pyramid(), text);
      return text + " was taken";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  for (const std::string scan : {"lookup=scan", "precise=false"}) {
    EXPECT_EQ(refusal("sphere-cluster:build=lazy," + scan),
              "sphere-cluster: build=lazy is for lookup=tree with precise=true");
    EXPECT_EQ(refusal("sphere-cluster:certified=false," + scan),
              "sphere-cluster: certified=false is for lookup=tree with precise=true");
    EXPECT_EQ(refusal("sphere-cluster:threads=257," + scan), "sphere-cluster: threads is 257, more than 256");
  }
  EXPECT_EQ(refusal("grid-group:lookup=scan,build=lazy"),
            "grid-group: build=lazy is for lookup=direct, not for scan");
  EXPECT_EQ(refusal("grid-group:lookup=scan,certified=false"),
            "grid-group: certified=false is for lookup=direct, not for scan");
  EXPECT_EQ(refusal("grid-group:lookup=scan,bytes_per_triangle=199"),
            "grid-group: bytes_per_triangle is 199.000000, less than 200.000000");
  EXPECT_EQ(refusal("grid-group:lookup=scan,threads=257"), "grid-group: threads is 257, more than 256");
}

TEST(NamedDetector, TakesForEitherFormWhatHasNoMeaningInTheOther) {
  for (const char* text :
       {"grid-group:shape=sphere,groups=7", "grid-group:lookup=scan,bytes_per_triangle=300",
        "grid-group:lookup=scan,threads=2", "sphere-cluster:lookup=scan,simd=portable",
        "sphere-cluster:lookup=scan,threads=2", "sphere-cluster:precise=false,simd=portable"})
    EXPECT_NO_THROW(NamedDetector::build(pyramid(), text)) << text;
}

TEST(NamedDetector, TakesAutoForSphereCluster) {
  EXPECT_EQ(NamedDetector::build(pyramid(), "auto:side=on")->bytes(),
            NamedDetector::build(pyramid(), "sphere-cluster:side=on")->bytes());
}

}  // namespace
}  // namespace touchmark::bench
