#include "core/subdivision/edge_split.h"

#include <array>

namespace touchmark {
namespace {

using Corners = TriangleMesh::Corners;

/// The parts of one triangle: 1 to 4.
struct Parts {
  std::array<Corners, 4> part;
  std::size_t count;
};

/// The trapezoid a, m, n, c left when the tip m, b, n is cut off.
bool first_diagonal_shorter(const Vec3& a, const Vec3& n, const Vec3& m, const Vec3& c) noexcept {
  return (a - n).squaredNorm() < (m - c).squaredNorm();
}

Parts parts_of(const Corners& corners, const std::array<std::uint32_t, 3>& middle,
               std::span<const Vec3> positions) {
  constexpr std::uint32_t whole = EdgeSplit::whole;
  const int long_sides = (middle[0] != whole) + (middle[1] != whole) + (middle[2] != whole);
  if (long_sides == 0) return {{corners}, 1};
  if (long_sides == 3) {
    const auto [a, b, c] = corners;
    const auto [ab, bc, ca] = middle;
    return {{{{ab, bc, ca}, {a, ab, ca}, {ab, b, bc}, {ca, bc, c}}}, 4};
  }
  // Turn the triangle so that side a-b is the only long one, or c-a the only short one.
  std::size_t turn = 0;
  while (long_sides == 1 ? middle[turn] == whole : middle[(turn + 2) % 3] != whole) ++turn;
  const std::uint32_t a = corners[turn], b = corners[(turn + 1) % 3], c = corners[(turn + 2) % 3];
  const std::uint32_t m = middle[turn], n = middle[(turn + 1) % 3];
  if (long_sides == 1) return {{{{a, m, c}, {m, b, c}}}, 2};
  if (first_diagonal_shorter(positions[a], positions[n], positions[m], positions[c]))
    return {{{{m, b, n}, {a, m, n}, {a, n, c}}}, 3};
  return {{{{m, b, n}, {a, m, c}, {m, n, c}}}, 3};
}

}  // namespace

EdgeSplit long_edges(std::span<const Vec3> positions, const EdgeMap<3>& edges, double threshold,
                     SubdivisionForm form) {
  const auto is_long = [&](const std::array<std::uint32_t, 2>& ends) {
    if (threshold == 0) return true;
    const Vec3& a = positions[ends[0]];
    const Vec3& b = positions[ends[1]];
    if (form == SubdivisionForm::published) return (a - b).squaredNorm() > threshold * threshold;
    const auto limit = static_cast<float>(threshold);
    return (a.cast<float>() - b.cast<float>()).squaredNorm() > limit * limit;
  };
  EdgeSplit split;
  split.vertex.assign(edges.size(), EdgeSplit::whole);
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (!is_long(edges.ends(e))) continue;
    split.vertex[e] = static_cast<std::uint32_t>(positions.size() + split.edges.size());
    split.edges.push_back(e);
  }
  return split;
}

std::size_t count_after(std::size_t faces, const EdgeMap<3>& edges, const EdgeSplit& split) noexcept {
  std::size_t count = faces;  // every long side makes one triangle more
  for (const std::uint32_t e : split.edges) count += edges.sides(e).size();
  return count;
}

std::vector<Corners> split_faces(std::span<const Corners> faces, const EdgeMap<3>& edges,
                                 const EdgeSplit& split, std::span<const Vec3> positions) {
  std::vector<Corners> result;
  result.reserve(count_after(faces.size(), edges, split));
  result.assign(faces.begin(), faces.end());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::array<std::uint32_t, 3> middle = {
        split.vertex[edges.edge(f, 0)], split.vertex[edges.edge(f, 1)], split.vertex[edges.edge(f, 2)]};
    const Parts parts = parts_of(faces[f], middle, positions);
    result[f] = parts.part[0];
    result.insert(result.end(), parts.part.begin() + 1,
                  parts.part.begin() + static_cast<std::ptrdiff_t>(parts.count));
  }
  return result;
}

}  // namespace touchmark
