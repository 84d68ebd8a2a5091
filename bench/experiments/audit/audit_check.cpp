#include "bench/experiments/audit/audit_check.h"

#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/audit/audit_row.h"
#include "bench/results/validation/row_check.h"

namespace touchmark::bench::experiments::audit {

namespace validation = results::validation;

void check_audit(const validation::CsvTable& table, validation::Faults& faults) {
  validation::check_rows(
      table, audit_columns(), audit_columns().size(), faults, [](const validation::RowCheck& row) {
        row.check_fields(audit_columns(), false);
        std::uint64_t asked = 0;
        for (const char* column : {"inside", "cavities", "near", "beyond"}) asked += row.count(column);
        row.expect(asked == row.count("points"), "points", fmt::format("is not the {} of all places", asked));
        for (const auto& [part, of] :
             {std::pair{"made_up", "contacts"}, std::pair{"missed", "true_contacts"}})
          row.expect(row.count(part) <= row.count(of), part, fmt::format("is above {}", of));
        row.expect(!row.is_ok() || row.count("made_up") + row.count("missed") == 0, "status",
                   "is ok with contacts made up or missed");
      });
}

}  // namespace touchmark::bench::experiments::audit
