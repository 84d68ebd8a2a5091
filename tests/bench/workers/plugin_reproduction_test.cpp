/// What a plug-in's `reproduce` is given, and what comes of what it returns.
#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "bench/meshes/meshes.h"
#include "bench/workers/plugin_description.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::workers {
namespace {

const std::string python_start = "class Detector:\n  def nearest(self, center, reach): pass\n";
const std::string javascript_start =
    "export const build = () => ({nearest: () => null});\n"
    "const said = (x) => typeof x === 'number' || typeof x === 'string' ? x : `[${x}]`;\n";

std::string reproduced(const char* name, const std::string& script, workload::Query query) {
  // The Python that has numpy comes first where the program looks for one.
  const std::string path = std::string("/usr/bin:") + std::getenv("PATH");
  setenv("PATH", path.c_str(), 1);
  const TemporaryFolder folder;
  std::ofstream(folder.file(name)) << script;
  const double endless = std::numeric_limits<double>::infinity();
  return reproduction(folder.file(name), meshes::load_mesh("cube"), query, {1, 2, 3},
                      {{{0.1, 5, 6}, 0.5}, endless});
}

TEST(Reproduction, PythonIsGivenTheMeshAndTheQuestion) {
  const std::string script = python_start +
                             "def reproduce(vertices, faces, query):\n"
                             "  return f'{vertices.shape[1]} {len(faces)} {query}\\n'\n";
  EXPECT_EQ(reproduced("a.py", script, workload::Query::nearest),
            "3 12 {'query': 'nearest', 'center': [0.1, 5.0, 6.0], 'reach': inf}\n");
  EXPECT_EQ(reproduced("a.py", script, workload::Query::touches),
            "3 12 {'query': 'touches', 'center': [0.1, 5.0, 6.0], 'radius': 0.5}\n");
  EXPECT_EQ(reproduced("a.py", script, workload::Query::sweep),
            "3 12 {'query': 'first_hit', 'from': [1.0, 2.0, 3.0], 'to': [0.1, 5.0, 6.0], 'radius': 0.5}\n");
}

TEST(Reproduction, JavaScriptIsGivenTheMeshAndTheQuestion) {
  const std::string script =
      javascript_start +
      "export async function reproduce(vertices, triangles, query) {\n"
      "  return `${vertices.length % 3} ${triangles.length} ` +\n"
      "    Object.entries(query).map(([key, x]) => `${key} ${said(x)}`).join(' ') + '\\n';\n}\n";
  EXPECT_EQ(reproduced("a.mjs", script, workload::Query::nearest),
            "0 36 query nearest center [0.1,5,6] reach Infinity\n");
  EXPECT_EQ(reproduced("a.mjs", script, workload::Query::touches),
            "0 36 query touches center [0.1,5,6] radius 0.5\n");
  EXPECT_EQ(reproduced("a.mjs", script, workload::Query::sweep),
            "0 36 query first_hit from [1,2,3] to [0.1,5,6] radius 0.5\n");
}

TEST(Reproduction, IsEmptyWhereThePluginHasNone) {
  EXPECT_EQ(reproduced("a.py", python_start, workload::Query::nearest), "");
  EXPECT_EQ(reproduced("a.mjs", javascript_start, workload::Query::nearest), "");
}

TEST(Reproduction, MayBeLong) {
  EXPECT_EQ(reproduced("a.mjs", javascript_start + "export const reproduce = () => 'x'.repeat(1e5);\n",
                       workload::Query::nearest)
                .size(),
            100000U);
}

/// Returns what is thrown.
std::string refused(const char* name, const std::string& script) {
  try {
    reproduced(name, script, workload::Query::nearest);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing is thrown";
}

TEST(Reproduction, IsATextOrRefused) {
  EXPECT_EQ(refused("a.py", python_start + "def reproduce(vertices, faces, query): return 7\n"),
            "TypeError: reproduce returned 7; it must return a text");
  EXPECT_EQ(refused("a.py", python_start + "def reproduce(vertices, faces, query): 1 / 0\n"),
            "ZeroDivisionError: division by zero (a.py, line 3)");
  EXPECT_EQ(refused("a.mjs", javascript_start + "export const reproduce = () => 7;\n"),
            "TypeError: reproduce returned 7; it must return a string");
  EXPECT_EQ(refused("a.mjs", javascript_start + "export const reproduce = () => null.x;\n"),
            "TypeError: Cannot read properties of null (reading 'x') (a.mjs, line 3)");
}

}  // namespace
}  // namespace touchmark::bench::workers
