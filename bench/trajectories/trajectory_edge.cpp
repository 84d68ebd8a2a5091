#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bench/trajectories/mesh_edges.h"
#include "bench/trajectories/motion_path.h"
#include "bench/trajectories/trajectory_shapes.h"

namespace touchmark::bench::trajectories {
namespace {

/// Walks from node to node along the edges of a mesh, along sharp ones as long as there are any to follow.
class EdgeWalk {
 public:
  EdgeWalk(const MeshEdges& mesh, std::uint32_t edge, support::Random& random)
      : mesh_(mesh), edge_(edge), forward_(random.below(2) == 0), done_(random.unit() * length()) {}

  const MeshEdge& edge() const { return mesh_.edges()[edge_]; }
  Vec3 position() const { return start() + done_ / length() * (end() - start()); }

  void advance(double step, support::Random& random) {
    constexpr int turns = 64;  // where edges are far shorter than a step, a tick's walk is cut
    done_ += step;
    for (int i = 0; i < turns && done_ > length(); ++i) {
      done_ -= length();
      turn(random);
    }
    done_ = std::min(done_, length());
  }

 private:
  Vec3 start() const { return mesh_.position(forward_ ? edge().from : edge().to); }
  Vec3 end() const { return mesh_.position(forward_ ? edge().to : edge().from); }
  double length() const { return (end() - start()).norm(); }

  /// On to another edge at the end of this one: a sharp one if there is one, back where there is none at all.
  void turn(support::Random& random) {
    const std::uint32_t node = forward_ ? edge().to : edge().from;
    std::uint32_t next = edge_;
    for (const bool sharp : {true, false}) {
      std::size_t seen = 0;
      for (const std::uint32_t other : mesh_.around(node)) {
        if (other == edge_ || mesh_.edges()[other].sharp != sharp) continue;
        if (random.below(++seen) == 0) next = other;  // each of those seen is as likely
      }
      if (seen > 0) break;
    }
    edge_ = next;
    forward_ = edge().from == node;
  }

  const MeshEdges& mesh_;
  std::uint32_t edge_;
  bool forward_;
  double done_;  ///< way made along the edge
};

/// The edges to start on, the longer the likelier: the sharp ones, or all of a smooth mesh.
class Starts {
 public:
  explicit Starts(const MeshEdges& mesh) {
    collect(mesh, true);
    if (edges_.empty()) collect(mesh, false);
  }
  std::optional<std::uint32_t> random(support::Random& random) const {
    if (edges_.empty()) return std::nullopt;
    const double at = random.unit() * length_up_to_.back();
    const auto found = std::ranges::upper_bound(length_up_to_, at);
    const auto last = static_cast<std::ptrdiff_t>(edges_.size()) - 1;
    return edges_[static_cast<std::size_t>(std::min(found - length_up_to_.begin(), last))];
  }

 private:
  void collect(const MeshEdges& mesh, bool sharp) {
    for (std::uint32_t e = 0; e < mesh.edges().size(); ++e) {
      const MeshEdge& edge = mesh.edges()[e];
      if (edge.sharp != sharp) continue;
      const double length = (mesh.position(edge.to) - mesh.position(edge.from)).norm();
      edges_.push_back(e);
      length_up_to_.push_back((length_up_to_.empty() ? 0 : length_up_to_.back()) + length);
    }
  }

  std::vector<std::uint32_t> edges_;
  std::vector<double> length_up_to_;
};

Vec3 limited(const Vec3& change, double most) {
  const double length = change.norm();
  return length > most ? Vec3(most / length * change) : change;
}

}  // namespace

// The centre follows the edge at an offset below the radius, which turns with the edges no faster than the
// walk itself goes.
Positions edge(Motion motion) {
  const MeshEdges mesh(motion.mesh);
  const Starts starts(mesh);
  const double step = motion.speed.value_or(0.0005) * motion.diagonal;
  constexpr std::size_t ticks_a_position = 2000, ticks_a_diagonal = 200;
  Path path(motion.steps);
  while (!path.full()) {
    const std::optional<std::uint32_t> start = starts.random(motion.random);
    if (!start) {  // a single point
      path.go(motion.mesh.corner(0, 0) + 0.9 * motion.radius * motion.random.direction(), 1);
      continue;
    }
    EdgeWalk walk(mesh, *start, motion.random);
    Vec3 offset = Vec3::Zero();
    double height = 0.9 * motion.radius * motion.random.unit();
    const double distance = path.distance_to(walk.position()) / motion.diagonal;
    path.go(walk.position(), static_cast<std::size_t>(1 + distance * ticks_a_diagonal));
    for (std::size_t i = 0; i < ticks_a_position && !path.full(); ++i) {
      walk.advance(step, motion.random);
      height = std::clamp(height + motion.random.between(-0.2, 0.2) * step, 0.0, 0.9 * motion.radius);
      offset += limited(height * walk.edge().bisector - offset, step);
      path.go(walk.position() + offset, 1);
    }
  }
  return std::move(path).positions();
}

}  // namespace touchmark::bench::trajectories
