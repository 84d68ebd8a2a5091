// Contestants of the user's own, as a user runs them: each command, and whatever may be wrong with them.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::cli {
namespace {

using Words = std::vector<std::string>;

const std::string wrapping = TOUCHMARK_WRAPPING_PLUGIN;
const std::string hostile_plugin = TOUCHMARK_HOSTILE_PLUGIN;
const Words sphere{"--mesh", "icosphere:2", "--trajectory", "slide", "--steps", "200"};

/// Has the hostile plug-in misbehave like that in what is started meanwhile.
class Misbehaving {
 public:
  explicit Misbehaving(const std::string& how) { ::setenv("HOSTILE_PLUGIN", how.c_str(), 1); }
  Misbehaving(const Misbehaving&) = delete;
  Misbehaving& operator=(const Misbehaving&) = delete;
  ~Misbehaving() { ::unsetenv("HOSTILE_PLUGIN"); }
};

Words joined(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Returns what the rows of a results.csv have in that column.
Words column_of(const std::string& file, const std::string& column) {
  Words values;
  for (const Fields& record : fields_in(file, {column})) values.push_back(record.front());
  return values;
}

Words on_sphere(const std::string& command, const Words& more) {
  return joined(joined({command}, sphere), more);
}

TEST(Plugin, IsVerifiedLikeAnyOther) {
  const Outcome outcome = run_touchmark(on_sphere("verify", {"--plugin", wrapping}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("wrapped"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("600 answers judged exactly"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("grid-group"), std::string::npos) << outcome.out;
}

TEST(Plugin, AnswersAsTheDetectorThatItWraps) {
  for (const char* const query : {"touches", "nearest", "sweep"}) {
    const Words asked{"--query", query, "--radius", "2%"};
    const Outcome wrapped = run_touchmark(on_sphere("query", joined({"--plugin", wrapping}, asked)));
    const Outcome own = run_touchmark(on_sphere("query", joined({"--detector", "grid-group"}, asked)));
    EXPECT_EQ(wrapped.status, 0) << wrapped.err;
    EXPECT_EQ(wrapped.out, own.out) << query;
  }
}

TEST(Plugin, NamesTrianglesByTheIdsOfTheFile) {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("quad.obj");
  // A polygon of two triangles is one face of the file, with one id.
  std::ofstream(mesh)
      << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\nv 6 5 5\nv 5 6 5\nf 1 2 3 4\nf 5 6 7\n";
  const Words asked{"query", "--mesh", mesh, "--trajectory", "jump", "--steps", "50", "--reach", "inf"};
  const Outcome wrapped = run_touchmark(joined(asked, {"--plugin", wrapping}));
  const Outcome own = run_touchmark(joined(asked, {"--detector", "brute-force"}));
  ASSERT_EQ(wrapped.status, 0) << wrapped.err;
  EXPECT_EQ(wrapped.out, own.out);
}

TEST(Plugin, RunsBesideOthersAndWithOptions) {
  const TemporaryFolder folder;
  const Outcome outcome = run_touchmark(on_sphere(
      "verify", {"--plugin", wrapping, "--detector", "brute-force", "--detector", "wrapped:cell=20%",
                 "--plugin", hostile_plugin, "--query", "nearest", "--out", folder.path()}));
  EXPECT_EQ(outcome.status, 1) << outcome.err;  // the hostile one finds nothing and claims exactness
  const std::string csv = folder.file("results.csv");
  EXPECT_EQ(column_of(csv, "detector"), (Words{"brute-force", "wrapped", "hostile"}));
  EXPECT_EQ(column_of(csv, "options"), (Words{"", "cell=20%", ""}));
}

TEST(Plugin, IsTimedOnTheSameAnswers) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_touchmark(on_sphere("bench", {"--plugin", wrapping, "--quick", "--benchmark_repetitions=1",
                                        "--benchmark_min_time=0.001", "--no-cold", "--out", folder.path()}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string csv = folder.file("results.csv");
  EXPECT_EQ(column_of(csv, "status"), Words{"ok"});
  EXPECT_GT(std::stod(column_of(csv, "ns_per_query").at(0)), 0);
  const Outcome valid = run_touchmark({"validate", folder.path()});
  EXPECT_EQ(valid.status, 0) << valid.out << valid.err;
}

TEST(Plugin, ThatWaitsIsTimedByTheTimeThatPasses) {
  const Misbehaving now("sleep in a query");
  const TemporaryFolder folder;
  const Outcome outcome = run_touchmark({"bench", "--mesh", "cube", "--trajectory", "slide", "--steps", "20",
                                         "--plugin", hostile_plugin, "--quick", "--benchmark_repetitions=1",
                                         "--benchmark_min_time=0.001", "--no-cold", "--out", folder.path()});
  const std::string csv = folder.file("results.csv");
  for (const char* const column : {"ns_per_query", "cpu_ns_per_query", "ns_p50"})
    EXPECT_GE(std::stod(column_of(csv, column).at(0)), 1e6) << column << outcome.err;
}

TEST(Plugin, FollowsAMeshThatMoves) {
  const Outcome outcome =
      run_touchmark({"update", "--mesh", "icosphere:2", "--steps", "50", "--plugin", wrapping});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("wrapped"), std::string::npos) << outcome.out;
}

TEST(Plugin, IsStressedScaledAndListed) {
  const Outcome stress =
      run_touchmark({"stress", "--family", "needles", "--probes", "50", "--plugin", wrapping});
  EXPECT_EQ(stress.status, 0) << stress.out << stress.err;
  const Outcome list = run_touchmark({"list", "--plugin", wrapping});
  EXPECT_NE(list.out.find("wrapped"), std::string::npos);
  EXPECT_NE(list.out.find("cell=LENGTH"), std::string::npos);
}

TEST(Plugin, IsPlannedAndRunWithoutBeingNamedAgain) {
  const TemporaryFolder folder;
  const std::string manifest = folder.file("sweep.json");
  const Outcome planned =
      run_touchmark(on_sphere("plan", {"--plugin", wrapping, "--effort", "accuracy", "--out", manifest}));
  ASSERT_EQ(planned.status, 0) << planned.err;
  const Outcome run = run_touchmark({"run", "--manifest", manifest, "--out", folder.file("jobs")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("1 jobs done"), std::string::npos) << run.err;
}

TEST(Plugin, ThatChangedSinceItWasPlannedIsNotRun) {
  const TemporaryFolder folder;
  const std::string manifest = folder.file("sweep.json"), copy = folder.file("copy.so");
  std::filesystem::copy_file(wrapping, copy);
  ASSERT_EQ(run_touchmark(on_sphere("plan", {"--plugin", copy, "--out", manifest})).status, 0);
  std::ofstream(copy, std::ios::app) << ' ';
  expect_bad_input({"run", "--manifest", manifest, "--out", folder.file("jobs")},
                   {copy, "is not the one that was planned"});
}

TEST(Plugin, ThatIsNoneIsRefusedInOneLine) {
  const TemporaryFolder folder;
  const std::string text = folder.file("text.so"), empty = folder.file("empty.so"),
                    library = folder.file("a.dll");
  std::ofstream(text) << "not a shared object\n";
  std::ofstream(empty) << "";
  std::ofstream(library) << "";
  for (const std::string& file : {text, empty, folder.file("absent.so")})
    expect_bad_input(on_sphere("verify", {"--plugin", file}), {"--plugin " + file});
  expect_bad_input(on_sphere("verify", {"--plugin", folder.path()}), {"it is not a file"});
  expect_bad_input(on_sphere("verify", {"--plugin", library}), {"ends in none of .so"});
  expect_bad_input(on_sphere("verify", {"--plugin", TOUCHMARK_NO_PLUGIN}), {"touchmark_plugin_entry"});
  expect_bad_input(on_sphere("verify", {"--plugin", wrapping, "--plugin", wrapping}),
                   {"\"wrapped\" is taken by"});
  expect_bad_input(on_sphere("query", {"--plugin", wrapping, "--detector", "brute-force"}), {"exactly one"});
}

TEST(Plugin, WhoseDescriptionIsWrongIsRefusedInOneLine) {
  for (const auto& [how, why] :
       std::vector<std::pair<std::string, std::string>>{{"crash on load", "crashed:SIGABRT"},
                                                        {"another version", "of version 2"},
                                                        {"version 0", "of version 0"},
                                                        {"NULL", "returns NULL"},
                                                        {"the name of another", "\"grid-group\" is taken by"},
                                                        {"a bad name", "\"a:b\""},
                                                        {"a bad guarantee", "\"perfect\""},
                                                        {"options at NULL", "5 options"},
                                                        {"a bad default", "\"eager\""},
                                                        {"a bad kind", "kind 9"},
                                                        {"a reserved key", "option side"},
                                                        {"no build", "build is NULL"},
                                                        {"no query", "it answers nothing"}}) {
    const Misbehaving now(how);
    expect_bad_input(on_sphere("verify", {"--plugin", hostile_plugin}), {hostile_plugin, why});
  }
}

TEST(Plugin, ThatFailsLaterHasAStatusAndEndsNothing) {
  for (const auto& [how, status] : std::vector<std::pair<std::string, std::string>>{
           {"crash in build", "crashed:SIGABRT"},
           {"hang in build", "timeout"},
           {"refuse without a word", "refused: build returns NULL and does not say why"},
           {"refuse to build", "refused: 320 triangles are <too> many & more, cell 0.34"},
           {"accuracy of NaN", "refused: the accuracy that it tells is below 0, or no number"},
           {"no session", "refused: create_session returns NULL"},
           {"crash in a query", "crashed:SIGABRT"},
           {"exit in a query", "crashed:exit 7"},
           {"hang in a query", "timeout"}}) {
    const Misbehaving now(how);
    const TemporaryFolder folder;
    const Outcome outcome =
        run_touchmark(on_sphere("verify", {"--plugin", hostile_plugin, "--query", "nearest", "--detector",
                                           "brute-force", "--timeout", "0.3", "--out", folder.path()}));
    const Words statuses = column_of(folder.file("results.csv"), "status");
    ASSERT_EQ(statuses.size(), 2u) << how << outcome.err;
    EXPECT_EQ(statuses[0], "ok") << how;
    EXPECT_TRUE(statuses[1].starts_with(status)) << how << ": " << statuses[1];
  }
}

#ifdef __SSE__
TEST(Plugin, ThatSwitchesDenormalsOffIsToldOf) {
  const Misbehaving now("flush to zero");
  const Outcome outcome = run_touchmark(on_sphere("verify", {"--plugin", hostile_plugin}));
  EXPECT_NE(outcome.err.find("hostile: loading it switched denormal numbers off"), std::string::npos)
      << outcome.err;
}
#endif

TEST(Plugin, ThatAnswersGarbageIsFoundOut) {
  for (const auto& [how, column] :
       std::vector<std::pair<std::string, std::string>>{{"answer nothing but NaN", "malformed"},
                                                        {"name a triangle that is none", "wrong_triangle"},
                                                        {"leave the contact as it was", "wrong_normal"},
                                                        {"find nothing", "missed"}}) {
    const Misbehaving now(how);
    const TemporaryFolder folder;
    const Outcome outcome =
        run_touchmark(on_sphere("verify", {"--plugin", hostile_plugin, "--query", "nearest", "--reach", "inf",
                                           "--out", folder.path()}));
    EXPECT_EQ(outcome.status, 1) << how << outcome.err;
    EXPECT_EQ(column_of(folder.file("results.csv"), column).at(0), "200") << how;
  }
}

TEST(Plugin, ThatClaimsLittleIsNotBroken) {
  const Misbehaving now("approximate");
  const Outcome outcome =
      run_touchmark(on_sphere("verify", {"--plugin", hostile_plugin, "--query", "nearest"}));
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("as claimed"), std::string::npos);
}

TEST(NewPlugin, WritesAnExampleAndNothingOverAnother) {
  const TemporaryFolder folder;
  const std::string where = folder.file("mine");
  const Outcome outcome = run_touchmark({"new-plugin", where});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("verify"), std::string::npos);
  const std::string written = content_of(where + "/mine.cpp");
  EXPECT_NE(written.find("touchmark_plugin_entry"), std::string::npos);
  EXPECT_LT(std::count(written.begin(), written.end(), '\n'), 100);
  std::filesystem::remove(where + "/CMakeLists.txt");
  expect_bad_input({"new-plugin", where}, {"mine.cpp", "is there already"});
  EXPECT_FALSE(std::filesystem::exists(where + "/CMakeLists.txt"));
  expect_bad_input({"new-plugin", where + "/mine.cpp"}, {"is not a folder"});
  expect_bad_input({"new-plugin"}, {"folder is required"});
}

}  // namespace
}  // namespace touchmark::bench::cli
