/// Which meshes a study of growth takes: a family in several sizes, or meshes that were named.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace touchmark::bench::experiments::scaling {

/// "1k,30k,1.5M": whole numbers of triangles, at least two different ones. Throws std::invalid_argument.
std::vector<std::uint64_t> parse_sizes(const std::string& text);

/// What sizes are of, and from which to which they are.
struct SizesOf {
  const char* what;
  std::uint64_t least, most;
};
/// As above, of what is said. Throws std::invalid_argument.
std::vector<std::uint64_t> parse_sizes(const std::string& text, const SizesOf& of);

/// The meshes that stand for `names`: noisy-sphere and soup in each of the sizes, dragon in its four
/// resolutions, all else as it is, from small to large where that is known. `sizes` as for parse_sizes, or
/// empty for `otherwise`. Throws std::invalid_argument, also for sizes that no name takes.
std::vector<std::string> meshes_of_sizes(const std::vector<std::string>& names, const std::string& sizes,
                                         const std::string& otherwise);

/// Returns true if this is a family that is generated in any size.
bool comes_in_sizes(const std::string& family);

/// What a mesh is one size of: the name before its parameter, "noisy-sphere" of "noisy-sphere:1000"; empty
/// for a mesh that has none.
std::string family_of(const std::string& mesh);

}  // namespace touchmark::bench::experiments::scaling
