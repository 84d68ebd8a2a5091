/// Prints the columns of results.csv, or of suite.csv, proxy.csv, many.csv, bodies.csv or audit.csv where
/// "suite", "proxy", "many", "bodies" or "audit" is the argument, as the table that scripts/docs puts into
/// docs/reference/results-csv.md.
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "bench/experiments/audit/audit_row.h"
#include "bench/experiments/many/many_row.h"
#include "bench/experiments/proxy/proxy_csv.h"
#include "bench/experiments/scaling/body_row.h"
#include "bench/experiments/suite/suite_csv.h"
#include "bench/results/results_csv.h"
#include "bench/support/names.h"

namespace {

namespace results = touchmark::bench::results;

constexpr std::array<touchmark::bench::support::Name<results::Presence>, 5> texts{
    {{results::Presence::always, "every row"},
     {results::Presence::optional, "where it applies"},
     {results::Presence::judged, "status `ok`"},
     {results::Presence::built, "status `ok`, with times"},
     {results::Presence::timed, "only status `ok`, with times"}}};

std::string_view text_of(results::Presence presence) {
  return touchmark::bench::support::name_in(texts, presence);
}

std::string_view without_article(std::string_view text) {
  for (const std::string_view article : {"a ", "an "})
    if (text.starts_with(article)) text.remove_prefix(article.size());
  return text;
}

template <class Columns>
void print_table(const Columns& columns) {
  fmt::print("| column | means | holds | filled in |\n|---|---|---|---|\n");
  for (const auto& column : columns)
    fmt::print("| `{}` | {} | {} | {} |\n", column.name, column.means, without_article(column.kind.what),
               text_of(column.presence));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view of = argc > 1 ? argv[1] : "";
  if (of == "suite") {
    print_table(touchmark::bench::experiments::suite::suite_columns());
  } else if (of == "many") {
    print_table(touchmark::bench::experiments::many::many_columns());
  } else if (of == "bodies") {
    print_table(touchmark::bench::experiments::scaling::body_columns());
  } else if (of == "audit") {
    print_table(touchmark::bench::experiments::audit::audit_columns());
  } else if (of == "proxy") {
    print_table(touchmark::bench::experiments::proxy::proxy_columns());
  } else {
    print_table(results::results_columns());
  }
}
