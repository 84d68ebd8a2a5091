/// Prints the columns of results.csv, or of suite.csv, proxy.csv, many.csv or bodies.csv where "suite",
/// "proxy", "many" or "bodies" is the argument, as the table that scripts/docs puts into
/// docs/reference/results-csv.md.
#include <string_view>

#include <fmt/format.h>

#include "bench/experiments/many/many_row.h"
#include "bench/experiments/proxy/proxy_csv.h"
#include "bench/experiments/scaling/body_row.h"
#include "bench/experiments/suite/suite_csv.h"
#include "bench/results/results_csv.h"

namespace {

namespace results = touchmark::bench::results;

const char* text_of(results::Presence presence) {
  switch (presence) {
    case results::Presence::always:
      return "every row";
    case results::Presence::optional:
      return "where it applies";
    case results::Presence::judged:
      return "status `ok`";
    case results::Presence::built:
      return "status `ok`, with times";
    case results::Presence::timed:
      return "only status `ok`, with times";
  }
  return "";
}

std::string_view without_article(std::string_view text) {
  for (const std::string_view article : {"a ", "an "}) {
    if (text.starts_with(article)) text.remove_prefix(article.size());
  }
  return text;
}

template <class Columns>
void print_table(const Columns& columns) {
  fmt::print("| column | means | holds | filled in |\n|---|---|---|---|\n");
  for (const auto& column : columns) {
    fmt::print("| `{}` | {} | {} | {} |\n", column.name, column.means, without_article(column.kind.what),
               text_of(column.presence));
  }
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
  } else if (of == "proxy") {
    print_table(touchmark::bench::experiments::proxy::proxy_columns());
  } else {
    print_table(results::results_columns());
  }
}
