// What is written alike for each instruction set of wide_rows.h, whose namespaces include it.

inline Wide max(Wide a, Wide b) noexcept { return a > b ? a : b; }

/// Reads as many values as there are lanes.
template <class Values>
inline Values read(const void* from) noexcept {
  Values values;
  std::memcpy(&values, from, sizeof values);
  return values;
}
