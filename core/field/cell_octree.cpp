#include "core/field/cell_octree.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/field/plane_fitter.h"
#include "core/float_limits.h"
#include "core/search/threads/parallel.h"
#include "core/sign/triangle_tree.h"

namespace touchmark::field {
namespace {

/// Distances at the corners of a cube: bits 0 to 2 of the index say on which side, along x, y and z.
using Corners = std::array<double, 8>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double half_diagonal = 0.8660254037844387;  // of a cube of edge 1, rounded up
constexpr std::uint32_t max_lattice = 32;             // cubes along the longest axis
constexpr double max_places = 0x1p28;                 // smallest cubes along the longest axis

bool is_side(std::size_t corner, std::size_t axis) noexcept { return (corner >> axis & 1) != 0; }

}  // namespace

/// Divides one cube of the lattice after the other.
class CellOctree::Divider {
 public:
  Divider(const CellOctree& octree, const Division& division, double diagonal, const PlaneFitter& planes,
          std::atomic<std::size_t>& bytes)
      : octree_(octree),
        division_(division),
        planes_(planes),
        squared_pad_(4 * diagonal * octree.slop_ + 64 * epsilon * diagonal * diagonal),
        bytes_(bytes) {}

  Tree divide(const Place& at, const Corners& distance, const Sampler& sample) const {
    Tree tree;
    tree.entries.push_back(0);
    divide(tree, 0, at, octree_.depth_, distance, sample);
    return tree;
  }

 private:
  void divide(Tree& tree, std::size_t entry, const Place& at, std::uint32_t level, const Corners& distance,
              const Sampler& sample) const {
    const double edge = std::ldexp(octree_.unit_, static_cast<int>(level));
    const Vec3 corner = octree_.position(at);
    const Sample middle = sample(corner + Vec3::Constant(0.5 * edge), infinity);
    const double radius = half_diagonal * edge + octree_.slop_;
    if (middle.distance - radius > division_.band) {
      tree.entries[entry] = leaf_bit | far;
      return;
    }
    // Larger cubes need more names than there are; farther off a triangle does for cubes as large.
    if (edge <= 16 * division_.error && middle.distance <= 2 * edge) {
      if (const auto fit = planes_.fit({corner, edge, radius}, middle, sample)) {
        keep(tree, entry, *fit);
        return;
      }
    }
    const double error = error_in(at, level, distance, middle, radius);
    if (level == 0 || error <= division_.error) {
      tree.entries[entry] = leaf_bit | middle.triangle;
      tree.error = std::max(tree.error, error);
      return;
    }
    divide_further(tree, entry, at, level, distance, middle.distance, sample);
  }

  void keep(Tree& tree, std::size_t entry, const PlaneFitter::Fit& fit) const {
    const PlaneCell& plane = fit.cell;
    const std::size_t first = tree.blocks.size();
    const std::size_t blocks = (plane.words() + words_a_block - 1) / words_a_block;
    tree.blocks.resize(first + blocks);
    const auto word = [&](std::size_t i) -> std::uint32_t& {
      return tree.blocks[first + i / words_a_block].words[i % words_a_block];
    };
    std::memcpy(&word(0), &plane.stored, sizeof plane.stored);
    std::size_t end = words_of_plane;
    for (const std::uint32_t triangle : fit.near) word(end++) = triangle;
    const std::uint32_t bits = plane.bits_of_name();
    for (std::uint32_t i = 0; i < fit.names.size(); ++i)
      word(end + i * bits / 32) |= std::uint32_t{fit.names[i]} << i * bits % 32;
    tree.entries[entry] = leaf_bit | plane_bit | static_cast<std::uint32_t>(first);
    tree.error = std::max(tree.error, fit.error);
    take(blocks * sizeof(Block));
  }

  void take(std::size_t bytes) const {
    if ((bytes_ += bytes) > division_.bytes)
      throw std::invalid_argument("field: an error of " + std::to_string(division_.error) +
                                  " takes more than " + std::to_string(division_.bytes >> 20) + " MiB");
  }

  /// Bounds how much farther the middle's triangle can be than the nearest, anywhere in the cube. Neither of
  /// the two bounds is always the smaller: distances change by no more than the point moves, and see the
  /// class.
  double error_in(const Place& at, std::uint32_t level, const Corners& distance, const Sample& middle,
                  double radius) const noexcept {
    double squares = 0;  // of the distance to the triangle less those of the true one, at most
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const Vec3 there = octree_.position(corner_of(at, level, corner));
      squares =
          std::max(squares, (there - middle.nearest).squaredNorm() - distance[corner] * distance[corner]);
    }
    squares += squared_pad_;
    const double least = std::max(middle.distance - radius, 0.0);
    const double by_squares = squares / (std::sqrt(least * least + squares) + least);
    return std::min(by_squares, 2 * radius) + 2 * octree_.slop_;
  }

  /// The eight children have their corners among 27 places, of which eight and the middle are known.
  void divide_further(Tree& tree, std::size_t entry, const Place& at, std::uint32_t level,
                      const Corners& distance, double in_middle, const Sampler& sample) const {
    std::array<double, 27> known;
    for (std::uint32_t i = 0; i < 27; ++i) {
      const Place part{i % 3, i / 3 % 3, i / 9};
      const bool is_corner = part[0] != 1 && part[1] != 1 && part[2] != 1;
      Place there = at;
      for (std::size_t axis = 0; axis < 3; ++axis) there[axis] += part[axis] << (level - 1);
      if (is_corner) {
        known[i] = distance[part[0] / 2 + part[1] / 2 * 2 + part[2] / 2 * 4];
      } else {
        known[i] = i == 13 ? in_middle : sample(octree_.position(there), infinity).distance;
      }
    }
    const std::size_t first = tree.entries.size();
    take(8 * sizeof(std::uint32_t));
    tree.entries.resize(first + 8);
    tree.entries[entry] = static_cast<std::uint32_t>(first);
    for (std::size_t child = 0; child < 8; ++child) {
      Corners corners;
      for (std::size_t corner = 0; corner < 8; ++corner) {
        std::size_t i = 0;
        for (std::size_t axis = 0, stride = 1; axis < 3; ++axis, stride *= 3)
          i += stride * ((is_side(child, axis) ? 1U : 0U) + (is_side(corner, axis) ? 1U : 0U));
        corners[corner] = known[i];
      }
      divide(tree, first + child, corner_of(at, level - 1, child), level - 1, corners, sample);
    }
  }

  static Place corner_of(const Place& at, std::uint32_t level, std::size_t corner) noexcept {
    Place place = at;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (is_side(corner, axis)) place[axis] += 1U << level;
    return place;
  }

  const CellOctree& octree_;
  const Division& division_;
  const PlaneFitter& planes_;
  double squared_pad_;
  std::atomic<std::size_t>& bytes_;
};

/// The lattice goes beyond the mesh's box by the band, and its smallest cube is so small that no triangle
/// that is nearest in its middle is wrong by more than the error anywhere in it.
bool CellOctree::choose_lattice(const Aabb& bounds, const Division& division) noexcept {
  const Aabb box = bounds.padded(division.band);
  const double largest = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
  const double extent = box.extent().maxCoeff();
  slop_ = 16 * epsilon * largest;
  unit_ = (division.error - 8 * slop_) / (2.001 * half_diagonal);
  // There squares of lengths are doubles, and the kernel's bound holds.
  constexpr double shortest = 0x1p-100, longest = 0x1p200;
  if (!(unit_ > 64 * slop_ && unit_ > shortest && extent < longest && extent < max_places * unit_))
    return false;
  origin_ = box.min;
  const auto places = static_cast<std::uint32_t>(extent / unit_) + 1;
  depth_ = 0;
  while ((places >> depth_) + 1 > max_lattice) ++depth_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    counts_[axis] = (static_cast<std::uint32_t>(box.extent()[static_cast<int>(axis)] / unit_) >> depth_) + 1;
    end_[axis] = static_cast<double>(counts_[axis] << depth_);
  }
  places_per_length_ = 1 / unit_;
  return true;
}

/// Returns the distances at the corners of the lattice's cubes.
std::vector<double> CellOctree::sample_lattice(const Division& division,
                                               std::vector<Sampler>& samplers) const {
  const std::size_t across = counts_[0] + 1, rows = counts_[1] + 1, planes = counts_[2] + 1;
  std::vector<double> distances(across * rows * planes);
  in_parallel(rows * planes, division.threads, [&](unsigned thread, std::size_t row) {
    for (std::size_t x = 0; x < across; ++x) {
      const Place at{static_cast<std::uint32_t>(x << depth_),
                     static_cast<std::uint32_t>(row % rows << depth_),
                     static_cast<std::uint32_t>(row / rows << depth_)};
      distances[row * across + x] = samplers[thread](position(at), infinity).distance;
    }
  });
  return distances;
}

CellOctree::CellOctree(const TriangleMesh& mesh, std::span<const PreparedTriangle> triangles,
                       const Division& division, const std::function<Sampler()>& make_sampler) {
  if (!choose_lattice(mesh.bounds(), division)) return;
  const sign::TriangleTree tree(mesh);
  std::vector<Sampler> samplers;
  for (unsigned i = 0; i < division.threads; ++i) samplers.push_back(make_sampler());
  const std::vector<double> distances = sample_lattice(division, samplers);
  const std::size_t across = counts_[0] + 1, rows = counts_[1] + 1;
  std::vector<Tree> trees(std::size_t{counts_[0]} * counts_[1] * counts_[2]);
  std::atomic<std::size_t> bytes = trees.size() * sizeof(std::uint32_t);
  const PlaneFitter planes(tree, triangles, {division.error, unit_, slop_});
  const Divider divider(*this, division, mesh.bounds().padded(division.band).extent().norm(), planes, bytes);
  in_parallel(trees.size(), division.threads, [&](unsigned thread, std::size_t i) {
    const std::size_t x = i % counts_[0], y = i / counts_[0] % counts_[1], z = i / counts_[0] / counts_[1];
    Corners corners;
    for (std::size_t corner = 0; corner < 8; ++corner)
      corners[corner] =
          distances[((z + (corner >> 2)) * rows + y + (corner >> 1 & 1)) * across + x + (corner & 1)];
    const Place at{static_cast<std::uint32_t>(x << depth_), static_cast<std::uint32_t>(y << depth_),
                   static_cast<std::uint32_t>(z << depth_)};
    trees[i] = divider.divide(at, corners, samplers[thread]);
  });
  append(trees);
}

/// Puts the trees behind one another, behind the lattice: there children and planes are by their place among
/// all.
void CellOctree::append(const std::vector<Tree>& trees) {
  std::size_t size = trees.size(), blocks = 0;
  for (const Tree& tree : trees) {
    size += tree.entries.size() - 1;
    blocks += tree.blocks.size();
  }
  entries_.resize(size);
  blocks_.reserve(blocks);
  std::size_t end = trees.size();
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const Tree& tree = trees[i];
    const auto moved = [&](std::uint32_t entry) {
      if ((entry & leaf_bit) == 0) return entry + static_cast<std::uint32_t>(end) - 1;
      return (entry & plane_bit) != 0 ? entry + static_cast<std::uint32_t>(blocks_.size()) : entry;
    };
    entries_[i] = moved(tree.entries[0]);
    for (std::size_t k = 1; k < tree.entries.size(); ++k) entries_[end + k - 1] = moved(tree.entries[k]);
    end += tree.entries.size() - 1;
    blocks_.insert(blocks_.end(), tree.blocks.begin(), tree.blocks.end());
    error_ = std::max(error_, tree.error);
  }
}

CellOctree::Leaf CellOctree::leaf_at(const Vec3& place) const noexcept {
  Place at;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double along = place[static_cast<int>(axis)];
    if (!(along >= 0 && along < end_[axis])) return {};
    at[axis] = static_cast<std::uint32_t>(along);
  }
  const auto [x, y, z] = at;
  std::uint32_t level = depth_;
  std::uint32_t entry = entries_[((z >> level) * counts_[1] + (y >> level)) * counts_[0] + (x >> level)];
  while ((entry & leaf_bit) == 0) {
    --level;
    entry = entries_[entry + ((x >> level & 1) | (y >> level & 1) << 1 | (z >> level & 1) << 2)];
  }
  Leaf leaf;
  for (std::size_t axis = 0; axis < 3; ++axis)
    leaf.corner[static_cast<int>(axis)] = static_cast<double>(at[axis] >> level << level);
  leaf.edge = static_cast<double>(1U << level);
  leaf.held = entry & ~leaf_bit;
  if (!leaf.is_plane()) return leaf;
  StoredPlane plane;
  std::memcpy(static_cast<void*>(&plane), blocks_[leaf.held & ~plane_bit].words.data(), sizeof plane);
  leaf.plane = PlaneCell(plane);
  return leaf;
}

double CellOctree::height(const Leaf& leaf, const Vec3& place) const noexcept {
  return leaf.plane.height(place - leaf.corner, unit_);
}

std::uint32_t CellOctree::triangle_near(const Leaf& leaf, const Vec3& in_leaf, double height) const noexcept {
  const PlaneCell& plane = leaf.plane;
  const std::size_t near = std::size_t{leaf.held & ~plane_bit} * words_a_block + words_of_plane;
  const std::uint32_t bits = plane.bits_of_name();
  const std::uint32_t at = plane.square_of(in_leaf, height * places_per_length_) * bits;
  return word(near + (word(near + plane.stored.near + at / 32) >> at % 32 & ((1U << bits) - 1)));
}

Contact CellOctree::contact(const Leaf& leaf, const Vec3& point, const Vec3& place,
                            double height) const noexcept {
  const Vec3& normal = leaf.plane.normal;
  const double sign = std::copysign(1.0, height);
  return {point - height * normal, sign * normal, std::abs(height),
          triangle_near(leaf, place - leaf.corner, height)};
}

}  // namespace touchmark::field
