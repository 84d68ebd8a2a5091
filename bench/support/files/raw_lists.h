/// Lists of numbers as they lie in memory, one behind the other, from one program of a build to another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace touchmark::bench::support {

/// Errors stay with the file: ask std::ferror at the end.
inline void put_number(std::FILE* to, std::uint64_t number) { std::fwrite(&number, sizeof number, 1, to); }
template <class T>
void put_list(std::FILE* to, std::span<const T> items) {
  static_assert(std::is_trivially_copyable_v<T>);
  put_number(to, items.size());
  std::fwrite(items.data(), sizeof(T), items.size(), to);
}
inline void put_text(std::FILE* to, std::string_view text) {
  put_list(to, std::span<const char>(text.data(), text.size()));
}

/// Throws std::runtime_error where the file ends before the number does.
inline std::uint64_t take_number(std::FILE* from) {
  std::uint64_t number = 0;
  if (std::fread(&number, sizeof number, 1, from) != 1) throw std::runtime_error("the input ends too early");
  return number;
}

/// Throws std::runtime_error where the file ends before the list does, or the list has more than `most`
/// items.
template <class T>
std::vector<T> take_list(std::FILE* from, std::size_t most = std::size_t{1} << 32) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::uint64_t count = take_number(from);
  if (count > most) throw std::runtime_error("the input ends too early");
  std::vector<T> items(count);
  if (std::fread(items.data(), sizeof(T), items.size(), from) != items.size())
    throw std::runtime_error("the input ends too early");
  return items;
}
inline std::string take_text(std::FILE* from) {
  const std::vector<char> text = take_list<char>(from, 1 << 20);
  return {text.begin(), text.end()};
}

}  // namespace touchmark::bench::support
