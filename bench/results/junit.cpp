#include "bench/results/junit.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/results/verification_report.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::results {
namespace {

/// Bytes that are not UTF-8, as a file's name or a library's message may hold, are replaced.
std::string in_utf8(const std::string& text) {
  const std::string json =
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return nlohmann::json::parse(json).get<std::string>();
}

/// XML 1.0 has no way to write most control characters.
std::string escaped(const std::string& text) {
  std::string xml;
  for (const char letter : in_utf8(text)) {
    switch (letter) {
      case '&':
        xml += "&amp;";
        break;
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      case '"':
        xml += "&quot;";
        break;
      default:
        xml += static_cast<unsigned char>(letter) < ' ' && letter != '\n' && letter != '\t' ? ' ' : letter;
    }
  }
  return xml;
}

std::string element_of(const TestCase& one) {
  const std::string begin = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.6f}\"",
                                        escaped(one.group), escaped(one.name), one.seconds);
  if (one.outcome == Outcome::passed) return begin + "/>\n";
  const std::string_view what = one.outcome == Outcome::failed ? "failure" : "skipped";
  return fmt::format("{}>\n      <{} message=\"{}\">{}</{}>\n    </testcase>\n", begin, what,
                     escaped(one.message), escaped(one.details), what);
}

TestCase case_of(const measurement::ResultRow& row) {
  TestCase one{row.contestant(),
               fmt::format("{}/{}/{}", row.mesh, row.trajectory, workload::name_of(row.query)),
               Outcome::passed,
               "",
               "",
               row.busy_s};
  if (claim_is_broken(row)) {
    one.outcome = Outcome::failed;
    const std::string text = list_of_failures({row}, 1);
    const std::size_t end = std::min(text.find('\n'), text.size());
    one.message = text.substr(0, end);
    one.details = text.substr(std::min(end + 1, text.size()));
  } else if (!row.counts) {
    one.outcome = Outcome::skipped;
    one.message = row.status;
  }
  return one;
}

}  // namespace

std::string junit_xml(const std::string& suite, const std::vector<TestCase>& cases) {
  std::size_t failed = 0, skipped = 0;
  double seconds = 0;
  std::string body;
  for (const TestCase& one : cases) {
    failed += one.outcome == Outcome::failed ? 1 : 0;
    skipped += one.outcome == Outcome::skipped ? 1 : 0;
    seconds += one.seconds;
    body += element_of(one);
  }
  const std::string counts =
      fmt::format("name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\" time=\"{:.6f}\"",
                  escaped(suite), cases.size(), failed, skipped, seconds);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {0}>\n  <testsuite {0}>\n{1}  "
      "</testsuite>\n</testsuites>\n",
      counts, body);
}

std::vector<TestCase> cases_of(const std::vector<measurement::ResultRow>& rows) {
  std::vector<TestCase> cases;
  for (const measurement::ResultRow& row : rows) cases.push_back(case_of(row));
  return cases;
}

}  // namespace touchmark::bench::results
