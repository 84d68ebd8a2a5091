/// What a paper says, beside what came out here: the reports' list, number by number.
#pragma once

#include <string>
#include <vector>

#include "bench/support/table.h"

namespace touchmark::bench::experiments::papers {

/// How a number agrees with the printed one. not_comparable: a time or rate of the authors' machine, which
/// they do not describe.
enum class Agreement { yes, nearly, no, not_printed, not_comparable };

struct Claim {
  std::string where;       ///< in the paper: "Table 3, level 1"
  std::string what;        ///< what is claimed
  std::string printed;     ///< "?" where no copy at hand shows it
  std::string reproduced;  ///< empty where it was not measured
  Agreement agreement = Agreement::not_printed;
  std::string why = {};  ///< the reason where they differ
};

/// yes when equal after rounding to `digits` decimals, nearly within `tolerance` (relative), else no.
Claim number_claim(std::string where, std::string what, double printed, double reproduced, int digits,
                   double tolerance, std::string why_not);

/// A statement that holds or does not.
Claim statement_claim(std::string where, std::string statement, bool holds, std::string reproduced,
                      std::string why_not);

/// A time or rate, which is of the machine it was taken on.
Claim time_claim(std::string where, std::string what, double printed, double reproduced, int digits,
                 std::string why);

support::Table claims_table(const std::vector<Claim>& claims);
/// Returns the claims in Markdown, with the reasons numbered below the table.
std::string claims_markdown(const std::vector<Claim>& claims);

/// "Of 45 printed numbers and statements 23 agree, 5 nearly, 12 do not; 5 of their machine, not
/// comparable." The last part where there are such.
std::string summary(const std::vector<Claim>& claims);

}  // namespace touchmark::bench::experiments::papers
