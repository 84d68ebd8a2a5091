/// The parts of `touchmark validate`.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/results/validation/json_schema.h"
#include "bench/results/validation/located_json.h"
#include "bench/results/validation/run_check.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::results::validation {
namespace {

TEST(Fault, IsOneLineWhateverTheValueHolds) {
  EXPECT_EQ(line_of({"a.csv", 3, "ns_p50", "two\nlines\x1b", "is not a number"}),
            "a.csv:3: ns_p50 \"two\\x0alines\\x1b\" is not a number");
  EXPECT_EQ(line_of({"a.csv", 0, "", "", "the file is empty"}), "a.csv: the file is empty");
}

TEST(LocatedJson, KnowsTheLineOfEachValue) {
  const TemporaryFolder folder;
  Faults faults;
  const auto document = read_located_json(
      folder.file("x.json",
                  "{\n \"a\": 1,\n \"b/c\": [true,\n  2.5\n ,\n \"x\"],\n \"d\": {\n\n \"e\": null}}"),
      faults);
  ASSERT_TRUE(document.has_value());
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(document->line_of(""), 1U);
  EXPECT_EQ(document->line_of("/a"), 2U);
  EXPECT_EQ(document->line_of("/b~1c"), 3U);
  EXPECT_EQ(document->line_of("/b~1c/0"), 3U);
  EXPECT_EQ(document->line_of("/b~1c/1"), 4U);
  EXPECT_EQ(document->line_of("/b~1c/2"), 6U);
  EXPECT_EQ(document->line_of("/d"), 7U);
  EXPECT_EQ(document->line_of("/d/e"), 9U);
  EXPECT_EQ(document->line_of("/d/nothing/there"), 7U) << "of what would hold it";
}

std::vector<std::string> wrong_with(const char* schema, const char* document) {
  std::vector<std::string> wrong;
  for (const SchemaFault& fault :
       JsonSchema(nlohmann::json::parse(schema)).check(nlohmann::json::parse(document))) {
    wrong.push_back(fault.pointer + " " + fault.wrong);
  }
  return wrong;
}

using Wrong = std::vector<std::string>;

TEST(JsonSchema, JudgesAsDraft7Does) {
  EXPECT_EQ(wrong_with(R"({"type": "integer"})", "3"), Wrong{});
  EXPECT_EQ(wrong_with(R"({"type": "integer"})", "3.0"), Wrong{});
  EXPECT_EQ(wrong_with(R"({"type": "integer"})", "3.5"), Wrong{" is not of type integer"});
  EXPECT_EQ(wrong_with(R"({"type": "number"})", "\"3\""), Wrong{" is not of type number"});
  EXPECT_EQ(wrong_with(R"({"minimum": 2})", "1"), Wrong{" is below 2"});
  EXPECT_EQ(wrong_with(R"({"minimum": 2})", "2"), Wrong{});
  EXPECT_EQ(wrong_with(R"({"minimum": 2})", "\"no number\""), Wrong{});
  EXPECT_EQ(wrong_with(R"({"const": 1})", "1"), Wrong{});
  EXPECT_EQ(wrong_with(R"({"const": 1})", "\"1\""), Wrong{" is not 1"});
  EXPECT_EQ(wrong_with(R"({"enum": ["a", "b"]})", "\"c\""), Wrong{" is none of [\"a\",\"b\"]"});
  EXPECT_EQ(wrong_with(R"({"pattern": "^a+$"})", "\"aaa\""), Wrong{});
  EXPECT_EQ(wrong_with(R"({"pattern": "^a+$"})", "\"aab\""), Wrong{" does not match ^a+$"});
  EXPECT_EQ(wrong_with(R"({"minLength": 1})", "\"\""), Wrong{" is too short"});
  EXPECT_EQ(wrong_with(R"({"minItems": 1, "maxItems": 2})", "[]"), Wrong{" has 0 items, not at least 1"});
  EXPECT_EQ(wrong_with(R"({"minItems": 1, "maxItems": 2})", "[1, 2, 3]"),
            Wrong{" has 3 items, not at most 2"});
  EXPECT_EQ(wrong_with(R"({"anyOf": [{"type": "null"}, {"const": 1}]})", "1"), Wrong{});
  EXPECT_EQ(wrong_with(R"({"anyOf": [{"type": "null"}, {"const": 1}]})", "2").size(), 1U);
}

TEST(JsonSchema, NamesThePlaceInside) {
  EXPECT_EQ(wrong_with(R"({"properties": {"a": {"items": {"type": "string"}}}, "required": ["a", "b"]})",
                       R"({"a": ["x", 1], "c": 2})"),
            (Wrong{"/a/1 is not of type string", "/b is missing"}));
  EXPECT_EQ(wrong_with(R"({"additionalProperties": {"type": "string"}})", R"({"a": "x", "b": 1})"),
            Wrong{"/b is not of type string"});
}

TEST(JsonSchema, RefusesKeywordsThatItWouldPassOver) {
  EXPECT_THROW(JsonSchema(nlohmann::json::parse(R"({"items": {"oneOf": []}})")), std::logic_error);
}

TEST(JsonSchema, KnowsEveryKeywordOfTheRunSchema) {
  EXPECT_NO_THROW(JsonSchema(nlohmann::json::parse(run_schema)));
}

/// std::regex recurs once a character.
TEST(JsonSchema, SurvivesALongString) {
  const nlohmann::json document = std::string(1'000'000, 'a');
  EXPECT_EQ(JsonSchema(nlohmann::json::parse(R"({"pattern": "^[a-z]+$"})")).check(document).size(), 1U);
}

}  // namespace
}  // namespace touchmark::bench::results::validation
