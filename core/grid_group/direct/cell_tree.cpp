#include "core/grid_group/direct/cell_tree.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "core/grid_group/direct/rough_search.h"
#include "core/search/linear_scan.h"
#include "core/search/threads/parallel.h"

namespace touchmark::grid {
namespace {

/// So many that they are worth handing out.
constexpr std::size_t cells_a_piece = 64;

}  // namespace

CellTree::Leaf CellTree::nearest_to(const TriangleStore& store, const BoxTree& tree, const Vec3& middle,
                                    std::uint32_t hint, std::uint64_t budget, Work& work) const noexcept {
  const Vec3 center = store.frame.from_frame(middle);
  RoughSearch search(store, center, min_part, std::numeric_limits<double>::infinity());
  search.consider(hint);
  const bool found = search.consider_tree(tree, budget);
  const RoughNearest& nearest = search.nearest();
  work.triangles += nearest.triangles;
  work.boxes += nearest.boxes;
  if (!found) return {nearest.slot, 0};
  const double distance = store.frame.scale() * std::sqrt(double{min_part} * nearest.squared);
  return {nearest.slot, std::max(rounded_down(distance - middle_error_), 0.0F)};
}

bool CellTree::build_lazily(const Vec3& in_frame, const TriangleStore& store, const BoxTree& tree,
                            std::uint64_t budget, Work& work) const noexcept {
  const Units units_at = units(in_frame);
  const Found at = find(units_at);
  if (states_.empty() || !states_[at.leaf].claim()) return false;
  const Leaf inherited = leaves_[at.leaf].load();
  // A tick's work is bounded: where that is not enough, what is known will do.
  Leaf leaf = nearest_to(store, tree, middle(units_at, at.shift), inherited.slot, budget, work);
  leaf.distance = std::max(leaf.distance, inherited.distance);
  leaves_[at.leaf].store(leaf);
  states_[at.leaf].finish();
  return true;
}

/// Level by level, so that what memory there is goes evenly around.
class CellTreeBuilder {
 public:
  CellTreeBuilder(const TriangleStore& store, const BoxTree& tree, const CellOptions& options)
      : store_(store), tree_(tree), options_(options) {}

  CellTree build() {
    set_up_cube();
    const auto root = cells_.root_ = static_cast<std::uint32_t>(cells_.links_.size());
    cells_.links_.push_back(0);
    std::vector<Open> level = {{Vec3::Zero(), root, {0, 0}}};
    for (unsigned depth = 0; !level.empty(); ++depth) level = refine(level, depth);
    fill_top(root);
    cells_.links_.shrink_to_fit();
    cells_.leaves_.shrink_to_fit();
    cells_.states_.shrink_to_fit();
    return std::move(cells_);
  }

 private:
  /// A cell whose link is not set yet.
  struct Open {
    Vec3 middle;
    std::uint32_t link;
    CellTree::Leaf inherited;  ///< a triangle that is probably near, and how far the mesh is at least
  };

  void set_up_cube() {
    // The mesh's box reaches to 1 at most; a little room for probes that touch it from outside.
    constexpr double half_edge = 1.04;
    cells_.half_ = half_edge;
    if (options_.smallest > 0) {
      cells_.half_ = options_.smallest / 2;
      while (cells_.half_ < half_edge) cells_.half_ *= 2;
    }
    cells_.middle_error_ =
        store_.frame.from_frame_error(cells_.half_) + CellTree::middle_relative_error * cells_.half_;
    cells_.unit_ = std::ldexp(2 * cells_.half_, -static_cast<int>(CellTree::max_levels));
    // A little less, so that a sum rounded up to the cube's edge still counts as inside.
    cells_.units_per_length_ = (1 - 0x1p-50) / cells_.unit_;
    // One cell at the top to 32 triangles or so, and no more of them than a cache likes.
    while (cells_.top_levels_ < 5 && std::size_t{32} << (3 * cells_.top_levels_) < store_.size())
      ++cells_.top_levels_;
    cells_.links_.assign(std::size_t{1} << (3 * cells_.top_levels_), 0);
    min_edge_ = options_.smallest > 0 ? options_.smallest : 0.25 * mean_size();
    const double finest = cells_.unit_ * 4;
    cells_.coarsened_ = min_edge_ < finest;
    min_edge_ = std::max(min_edge_, finest);
  }

  double size_of(const PreparedTriangle& t) const {
    const double twice_area = (t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]).norm();
    return store_.frame.scale() * std::sqrt(twice_area);
  }

  double mean_size() const {
    double sum = 0;
    for (const PreparedTriangle& t : store_.exact) sum += size_of(t);
    return sum / store_.size();
  }

  std::vector<Open> refine(const std::vector<Open>& open, unsigned level) {
    const double edge = std::ldexp(2 * cells_.half_, -static_cast<int>(level));
    cells_.smallest_edge_ = edge;
    std::vector<Open> next;
    std::vector<CellTree::Leaf> leaves(open.size());
    // Where leaves are built lazily, what the parent knows tells which cells are such leaves.
    const auto inherits = [&](const Open& cell) {
      return options_.lazy && level >= cells_.top_levels_ && !needs_children(cell.inherited, edge);
    };
    in_ranges(open.size(), cells_a_piece, options_.threads, [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i)
        leaves[i] = inherits(open[i]) ? open[i].inherited : nearest_to(open[i]);
    });
    for (std::size_t at = 0; at < open.size(); ++at) {
      const Open& cell = open[at];
      const CellTree::Leaf& leaf = leaves[at];
      const bool inherited = inherits(cell);
      if (level < cells_.top_levels_ ||
          (!inherited && needs_children(leaf, edge) && has_bytes_for_children(next.size()))) {
        const auto node = static_cast<std::uint32_t>(cells_.links_.size());
        cells_.links_[cell.link] = node;
        cells_.links_.resize(cells_.links_.size() + 8);
        // The distance changes by no more than the way to a child's middle.
        const double to_child = 0.25 * std::sqrt(3.0) * edge;
        const float least =
            std::max(CellTree::rounded_down(static_cast<double>(leaf.distance) - to_child), 0.0F);
        for (std::uint32_t i = 0; i < 8; ++i) {
          const Vec3 side(i & 1u ? 1 : -1, i & 2u ? 1 : -1, i & 4u ? 1 : -1);
          next.push_back({cell.middle + 0.25 * edge * side, node + i, {leaf.slot, least}});
        }
      } else {
        cells_.links_[cell.link] = CellTree::is_leaf | static_cast<std::uint32_t>(cells_.leaves_.size());
        cells_.leaves_.push_back({leaf.slot, leaf.distance});
        if (options_.lazy) cells_.states_.push_back(inherited ? LazyState::unbuilt() : LazyState());
      }
    }
    return next;
  }

  CellTree::Leaf nearest_to(const Open& cell) const {
    Work unreported;
    return cells_.nearest_to(store_, tree_, cell.middle, cell.inherited.slot, any_work, unreported);
  }

  /// Near the surface, down to the size of the triangles there.
  bool needs_children(const CellTree::Leaf& leaf, double edge) const {
    // In sizes: without a group to find, a triangle is as good that is somewhat farther.
    constexpr double with_group = 3, without_group = 6;
    if (edge < 1.5 * min_edge_ || static_cast<double>(leaf.distance) > edge) return false;
    if (options_.smallest > 0) return true;
    const bool has_group = options_.groups == nullptr || options_.groups->of(leaf.slot).count() > 0;
    return edge > (has_group ? with_group : without_group) * size_of(store_.exact[leaf.slot]);
  }

  bool has_bytes_for_children(std::size_t open_cells) {
    constexpr std::size_t bytes_a_cell = sizeof(CellTree::Leaf) + sizeof(std::uint32_t);
    const std::size_t cells = cells_.leaves_.size() + cells_.links_.size() / 8 + open_cells + 8;
    const bool fits = cells * bytes_a_cell <= options_.max_bytes;
    cells_.coarsened_ |= !fits;
    return fits;
  }

  void fill_top(std::uint32_t root) {
    const std::uint32_t count = 1u << cells_.top_levels_;
    for (std::uint32_t z = 0; z < count; ++z) {
      for (std::uint32_t y = 0; y < count; ++y) {
        for (std::uint32_t x = 0; x < count; ++x) {
          std::uint32_t link = cells_.links_[root];
          for (unsigned shift = cells_.top_levels_; shift-- > 0;)
            link =
                cells_.links_[link + ((x >> shift & 1u) | (y >> shift & 1u) << 1 | (z >> shift & 1u) << 2)];
          cells_.links_[(z * count + y) * count + x] = link;
        }
      }
    }
  }

  const TriangleStore& store_;
  const BoxTree& tree_;
  CellOptions options_;
  double min_edge_ = 0;
  CellTree cells_;
};

void CellTree::update(const TriangleStore& store, const BoxTree& tree, const std::vector<Aabb>& moved,
                      unsigned threads) {
  struct Open {
    Vec3 middle;
    std::uint32_t link;
    double quarter;  ///< a quarter of the cell's edge
  };
  std::vector<Open> open = {{Vec3::Zero(), links_[root_], 0.5 * half_}}, changed;
  while (!open.empty()) {
    const Open cell = open.back();
    open.pop_back();
    if ((cell.link & is_leaf) == 0) {
      for (std::uint32_t i = 0; i < 8; ++i) {
        const Vec3 side(i & 1u ? 1 : -1, i & 2u ? 1 : -1, i & 4u ? 1 : -1);
        open.push_back({cell.middle + cell.quarter * side, links_[cell.link + i], 0.5 * cell.quarter});
      }
      continue;
    }
    const std::uint32_t number = cell.link & ~is_leaf;
    const Leaf leaf = leaves_[number].load();
    if (any_within(moved, cell.middle, upper_bound(static_cast<double>(leaf.distance))))
      changed.push_back(cell);
  }
  in_ranges(changed.size(), cells_a_piece, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const std::uint32_t number = changed[i].link & ~is_leaf, slot = leaves_[number].load().slot;
      Work unreported;
      const bool is_lazy = !states_.empty();
      leaves_[number].store(is_lazy ? Leaf{slot, 0}
                                    : nearest_to(store, tree, changed[i].middle, slot, any_work, unreported));
      if (is_lazy) states_[number] = LazyState::unbuilt();
    }
  });
}

CellTree CellTree::build(const TriangleStore& store, const BoxTree& tree, const CellOptions& options) {
  return CellTreeBuilder(store, tree, options).build();
}

}  // namespace touchmark::grid
