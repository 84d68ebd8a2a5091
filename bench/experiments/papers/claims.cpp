#include "bench/experiments/papers/claims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/support/names.h"

namespace touchmark::bench::experiments::papers {
namespace {

constexpr std::array<support::Name<Agreement>, 5> agreement_words{
    {{Agreement::yes, "yes"},
     {Agreement::nearly, "nearly"},
     {Agreement::no, "no"},
     {Agreement::not_printed, "unknown"},
     {Agreement::not_comparable, "not comparable (their machine)"}}};

std::string word_for(Agreement agreement) {
  return std::string(support::name_in(agreement_words, agreement));
}

}  // namespace

Claim number_claim(std::string where, std::string what, double printed, double reproduced, int digits,
                   double tolerance, std::string why_not) {
  Claim claim{std::move(where), std::move(what), fmt::format("{:.{}f}", printed, digits),
              fmt::format("{:.{}f}", reproduced, digits)};
  if (claim.printed == claim.reproduced)
    claim.agreement = Agreement::yes;
  else if (std::abs(reproduced - printed) <= tolerance * std::abs(printed))
    claim.agreement = Agreement::nearly;
  else
    claim.agreement = Agreement::no;
  if (claim.agreement != Agreement::yes) claim.why = std::move(why_not);
  return claim;
}

Claim statement_claim(std::string where, std::string statement, bool holds, std::string reproduced,
                      std::string why_not) {
  return {std::move(where),
          std::move(statement),
          "holds",
          std::move(reproduced),
          holds ? Agreement::yes : Agreement::no,
          holds ? std::string() : std::move(why_not)};
}

Claim time_claim(std::string where, std::string what, double printed, double reproduced, int digits,
                 std::string why) {
  return {std::move(where),
          std::move(what),
          fmt::format("{:.{}f}", printed, digits),
          fmt::format("{:.{}f}", reproduced, digits),
          Agreement::not_comparable,
          std::move(why)};
}

support::Table claims_table(const std::vector<Claim>& claims) {
  support::Table table({"where", "what", "printed", "reproduced", "agrees", "why"});
  for (const Claim& c : claims)
    table.add({c.where, c.what, c.printed, c.reproduced, word_for(c.agreement), c.why});
  return table;
}

std::string claims_markdown(const std::vector<Claim>& claims) {
  std::vector<std::string> reasons;
  support::Table table({"where", "what", "printed", "reproduced", "agrees", "why"});
  for (const Claim& c : claims) {
    std::string mark;
    if (!c.why.empty()) {
      auto found = std::ranges::find(reasons, c.why);
      if (found == reasons.end()) found = reasons.insert(reasons.end(), c.why);
      mark = fmt::format("({})", found - reasons.begin() + 1);
    }
    table.add({c.where, c.what, c.printed, c.reproduced, word_for(c.agreement), mark});
  }
  std::string text = table.markdown() + "\n";
  for (std::size_t i = 0; i < reasons.size(); ++i) text += fmt::format("({}) {}.\n\n", i + 1, reasons[i]);
  return text;
}

std::string summary(const std::vector<Claim>& claims) {
  const auto count = [&claims](Agreement agreement) {
    return std::ranges::count_if(claims, [&](const Claim& claim) { return claim.agreement == agreement; });
  };
  const auto not_comparable = count(Agreement::not_comparable);
  return fmt::format(
      "Of {} printed numbers and statements {} agree, {} nearly, {} do not{}.",
      claims.size() - static_cast<std::size_t>(count(Agreement::not_printed)), count(Agreement::yes),
      count(Agreement::nearly), count(Agreement::no),
      not_comparable > 0 ? fmt::format("; {} of their machine, not comparable", not_comparable) : "");
}

}  // namespace touchmark::bench::experiments::papers
