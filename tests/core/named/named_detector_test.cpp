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
const std::set<std::string> of_the_program{"prepare", "updated"};

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

TEST(NamedDetector, TakesAutoForSphereCluster) {
  EXPECT_EQ(NamedDetector::build(pyramid(), "auto:side=on")->bytes(),
            NamedDetector::build(pyramid(), "sphere-cluster:side=on")->bytes());
}

}  // namespace
}  // namespace touchmark::bench
