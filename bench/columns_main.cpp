/// Prints the columns of results.csv as the table that scripts/docs puts into docs/reference/results-csv.md.
#include <fmt/format.h>

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

}  // namespace

int main() {
  fmt::print("| column | means | holds | filled in |\n|---|---|---|---|\n");
  for (const auto& column : results::results_columns()) {
    fmt::print("| `{}` | {} | {} | {} |\n", column.name, column.means, without_article(column.kind.what),
               text_of(column.presence));
  }
}
