#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/contestants/roster.h"
#include "bench/support/failures.h"

namespace touchmark::bench::contestants {
namespace {

Roster small_roster() {
  ContestantInfo grid;
  grid.name = "grid-group";
  grid.former_names = {{"lattice", {"depth", "trial"}}};
  grid.options = {{"shape", OptionKind::choice, {"cube", "sphere"}, "cube", ""},
                  {"cell", OptionKind::length, {}, "0", ""},
                  {"groups", OptionKind::count, {}, "0", ""},
                  {"bytes", OptionKind::number, {}, "1.5", ""}};
  grid.bytes_per_triangle = [](const OptionValues& values) { return values.number("bytes"); };
  grid.build = [](const TriangleMesh&, const OptionValues&) { return nullptr; };
  ContestantInfo absent;
  absent.name = "absent";
  absent.forms.compared = {""};
  grid.forms.compared = {"", "shape=sphere"};
  return Roster({grid, absent});
}

std::string error_of(const std::string& text) {
  try {
    small_roster().parse(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Roster, FillsInTheDefaultsOfOptionsThatWereNotWritten) {
  const ContestantSpec spec = small_roster().parse("grid-group:cell=0.25");
  EXPECT_EQ(spec.text(), "grid-group:cell=0.25");
  EXPECT_EQ(spec.values.text("shape"), "cube");
  EXPECT_EQ(spec.values.number("cell"), 0.25);
  EXPECT_EQ(spec.values.number("bytes"), 1.5);
  EXPECT_EQ(spec.values.count("groups"), 0U);
}

TEST(Roster, WritesOptionsInTheContestantsOwnOrder) {
  EXPECT_EQ(small_roster().parse("grid-group:cell=2,shape=sphere").options, "shape=sphere,cell=2");
}

TEST(Roster, TakesAFormerNameAndSaysWhichOptionsHaveNoEffect) {
  const ContestantSpec spec = small_roster().parse("lattice:trial=x,cell=2,depth=5");
  EXPECT_EQ(spec.text(), "grid-group:cell=2");
  EXPECT_EQ(spec.remark,
            "lattice:trial=x,cell=2,depth=5 answers as grid-group:cell=2; without effect: trial, depth");
  EXPECT_EQ(small_roster().parse("lattice").remark, "lattice answers as grid-group");
  EXPECT_EQ(small_roster().parse("grid-group").remark, "");
  EXPECT_NE(error_of("grid-group:depth=5"), "accepted");
  EXPECT_NE(error_of("lattice:size=5"), "accepted");
  ContestantInfo another;
  another.name = "lattice";
  EXPECT_THROW(small_roster().add(another), std::invalid_argument);
}

TEST(Roster, KeepsOneWhereAFormerNameMeansAnotherOfTheList) {
  const auto texts_of = [](const std::vector<std::string>& asked) {
    std::vector<std::string> texts;
    for (const ContestantSpec& spec : small_roster().parse_all(asked)) texts.push_back(spec.text());
    return texts;
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(texts_of({"lattice", "absent", "grid-group"}), (Texts{"absent", "grid-group"}));
  EXPECT_EQ(texts_of({"lattice", "lattice:trial=1"}), (Texts{"grid-group"}));
  EXPECT_EQ(texts_of({"lattice", "grid-group:cell=1"}), (Texts{"grid-group", "grid-group:cell=1"}));
  EXPECT_EQ(texts_of({"grid-group", "grid-group"}), (Texts{"grid-group", "grid-group"}));
}

TEST(Roster, AnswersAnUnknownNameWithTheNearestOnes) {
  EXPECT_EQ(error_of("grid-grup"), "unknown contestant \"grid-grup\"; the nearest names: grid-group, absent");
}

TEST(Roster, AnswersAnUnknownKeyWithTheKeysThereAre) {
  EXPECT_EQ(error_of("grid-group:size=1"),
            "grid-group has no option \"size\"; its options: shape, cell, groups, bytes");
  EXPECT_EQ(error_of("absent:size=1"), "absent has no option \"size\": it takes none");
}

TEST(Roster, NamesTheValueThatIsWrong) {
  EXPECT_EQ(error_of("grid-group:shape=cone"), "grid-group: shape=\"cone\" is none of cube, sphere");
  EXPECT_EQ(error_of("grid-group:groups=1.5"),
            "grid-group: groups=\"1.5\" is not a whole number of 0 or more");
  EXPECT_EQ(error_of("grid-group:cell=5cm"),
            "grid-group: cell=\"5cm\" is not a length of 0 or more, as 0.01 or 0.5%");
  for (const std::string bad : {"-1", "x", "", "nan", "1x", " 1"}) {
    EXPECT_EQ(error_of("grid-group:bytes=" + bad),
              "grid-group: bytes=\"" + bad + "\" is not a number of 0 or more");
  }
}

TEST(Roster, RefusesWhatIsNotKeyEqualsValueOrComesTwice) {
  EXPECT_EQ(error_of("grid-group:cube"), "grid-group: \"cube\" is not key=value");
  EXPECT_EQ(error_of("grid-group:"), "grid-group: \"\" is not key=value");
  EXPECT_EQ(error_of("grid-group:cell=1,cell=1"), "grid-group: cell is given twice");
}

TEST(Roster, RefusesAContestantThatTakesMoreMemoryThanThereIs) {
  const Roster roster = small_roster();
  const ContestantSpec frugal = roster.parse("grid-group"), greedy = roster.parse("grid-group:bytes=1e30");
  EXPECT_NO_THROW(roster.prepare_to_build(frugal, 1000));
  EXPECT_THROW(roster.prepare_to_build(greedy, 1000), support::ResourceError);
}

TEST(Roster, LeavesOutOfTheDefaultSetWhatIsNotBuilt) {
  const std::vector<ContestantSpec> specs = small_roster().default_set();
  ASSERT_EQ(specs.size(), 2U);
  EXPECT_EQ(specs[0].text(), "grid-group");
  EXPECT_EQ(specs[1].text(), "grid-group:shape=sphere");
}

}  // namespace
}  // namespace touchmark::bench::contestants
