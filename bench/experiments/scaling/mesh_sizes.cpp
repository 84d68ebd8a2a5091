#include "bench/experiments/scaling/mesh_sizes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "bench/meshes/generated_meshes.h"
#include "bench/support/numbers.h"
#include "bench/support/split.h"

namespace touchmark::bench::experiments::scaling {
namespace {

constexpr SizesOf of_noisy_spheres{"triangles", 6, meshes::max_generated_triangles};

/// "1.5M".
std::optional<std::uint64_t> parse_size(std::string_view text, const SizesOf& of) {
  double unit = 1;
  if (text.ends_with('k')) unit = 1e3;
  if (text.ends_with('M')) unit = 1e6;
  if (unit > 1) text.remove_suffix(1);
  const double size = support::parse_number(text).value_or(0) * unit;
  if (!(size >= static_cast<double>(of.least) && size <= static_cast<double>(of.most)) ||
      size != std::floor(size))
    return std::nullopt;
  return static_cast<std::uint64_t>(size);
}

}  // namespace

bool comes_in_sizes(const std::string& family) { return family == "noisy-sphere" || family == "soup"; }

std::vector<std::uint64_t> parse_sizes(const std::string& text) {
  return parse_sizes(text, of_noisy_spheres);
}

std::vector<std::uint64_t> parse_sizes(const std::string& text, const SizesOf& of) {
  std::vector<std::uint64_t> sizes;
  for (const std::string_view part : support::split(text, ',')) {
    const std::optional<std::uint64_t> size = parse_size(part, of);
    if (!size)
      throw std::invalid_argument(
          fmt::format("--sizes \"{}\": \"{}\" is not a whole number of {} from {} to {}, as 5000, 5k or 1.5M",
                      text, part, of.what, of.least, of.most));
    sizes.push_back(*size);
  }
  std::ranges::sort(sizes);
  sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
  if (sizes.size() < 2)
    throw std::invalid_argument(fmt::format("--sizes \"{}\" has not two different sizes", text));
  return sizes;
}

std::vector<std::string> meshes_of_sizes(const std::vector<std::string>& names, const std::string& sizes,
                                         const std::string& otherwise) {
  const std::vector<std::uint64_t> wanted = parse_sizes(sizes.empty() ? otherwise : sizes);
  std::vector<std::string> meshes;
  for (const std::string& name : names) {
    if (comes_in_sizes(name)) {
      for (const std::uint64_t size : wanted) meshes.push_back(fmt::format("{}:{}", name, size));
    } else if (name == "dragon") {
      for (int resolution = 4; resolution >= 1; --resolution)
        meshes.push_back(fmt::format("{}:{}", name, resolution));
    } else {
      meshes.push_back(name);
    }
  }
  if (!sizes.empty() && std::ranges::none_of(names, comes_in_sizes))
    throw std::invalid_argument(
        fmt::format("--sizes \"{}\": none of the meshes comes in any size; noisy-sphere and soup do", sizes));
  if (meshes.size() < 2)
    throw std::invalid_argument(fmt::format(
        "--mesh \"{}\" is one size: name noisy-sphere, soup or dragon, or several meshes", meshes.front()));
  return meshes;
}

std::string family_of(const std::string& mesh) {
  const std::size_t colon = mesh.find(':');
  return colon == std::string::npos ? "" : mesh.substr(0, colon);
}

}  // namespace touchmark::bench::experiments::scaling
