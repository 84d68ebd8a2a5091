/// What was checked, as JUnit's XML, which CI systems show as tests.
#pragma once

#include <string>
#include <vector>

#include "bench/measurement/result_row.h"

namespace touchmark::bench::results {

enum class Outcome { passed, failed, skipped };

struct TestCase {
  std::string group;  ///< what it belongs to, as a class of a program
  std::string name;
  Outcome outcome = Outcome::passed;
  std::string message;  ///< one line: why it failed or was skipped
  std::string details;  ///< lines under it, or nothing
  double seconds = 0;
};

std::string junit_xml(const std::string& suite, const std::vector<TestCase>& cases);

/// Returns a case a row. A row fails where its claim of exactness is broken, as in the exit status; it is
/// skipped where nothing was judged.
std::vector<TestCase> cases_of(const std::vector<measurement::ResultRow>& rows);

}  // namespace touchmark::bench::results
