#include "core/field/field_options.h"

#include <stdexcept>
#include <string>

#include "core/search/threads/parallel.h"

namespace touchmark::field {
namespace {

double checked_length(double length, const char* name, double otherwise) {
  if (!(length >= 0))
    throw std::invalid_argument(std::string("field: ") + name + " is " + std::to_string(length) +
                                ", not a number of 0 or more");
  return length > 0 ? length : otherwise;
}

}  // namespace

Division checked_division(const FieldOptions& options, double diagonal) {
  constexpr double default_error = 0.01, default_band = 0.05;  // of the diagonal
  constexpr std::size_t max_bytes = std::size_t{1} << 30;
  return {checked_length(options.error, "error", default_error * diagonal),
          checked_length(options.band, "band", default_band * diagonal),
          threads_to_use(options.threads, "field"), max_bytes};
}

}  // namespace touchmark::field
