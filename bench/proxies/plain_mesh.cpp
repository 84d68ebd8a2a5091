#include "bench/proxies/plain_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/proxies/sweeper.h"

namespace touchmark::bench::proxies {

using oracle::Triangle;

Vec3 nearest_on_triangle(const Vec3& point, const Triangle& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = point - t[0];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return t[0];
  const Vec3 bp = point - t[1];
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t[0] + (d1 / (d1 - d3)) * ab;
  const Vec3 cp = point - t[2];
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t[0] + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return t[1] + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (t[2] - t[1]);
  const double sum = va + vb + vc;
  return t[0] + (vb / sum) * ab + (vc / sum) * ac;
}

PlainMesh::Nearest PlainMesh::nearest(const Vec3& center) {
  Nearest best;
  double limit = std::numeric_limits<double>::infinity();
  tree_.visit([&](const oracle::Box& box) { return oracle::distance_below(box, center); }, limit,
              [&](std::uint32_t index) {
                ++work_;
                const Vec3 point = nearest_on_triangle(center, oracle::triangle_of(mesh_, index));
                const double distance = (center - point).norm();
                if (distance < limit || (distance == limit && index < best.triangle))
                  best = {index, point, limit = distance};
              });
  return best;
}

std::optional<double> segment_meets(const Vec3& from, const Vec3& to, const Triangle& t) {
  const Vec3 way = to - from, ab = t[1] - t[0], ac = t[2] - t[0];
  const Vec3 p = way.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return std::nullopt;
  const Vec3 s = from - t[0];
  const double u = s.dot(p) / determinant;
  if (!(u >= 0 && u <= 1)) return std::nullopt;
  const Vec3 q = s.cross(ab);
  const double v = way.dot(q) / determinant;
  if (!(v >= 0 && u + v <= 1)) return std::nullopt;
  const double fraction = ac.dot(q) / determinant;
  if (!(fraction >= 0 && fraction <= 1)) return std::nullopt;
  return fraction;
}

namespace {

/// A ball that comes in at less than this angle only grazes an edge or corner: it would sink in by half the
/// angle's square of its radius. Without it a ball that slides over the edge between two faces of one plane
/// stops there.
constexpr double grazing = 1e-6;
/// What touches and moves in at less than this angle slides.
constexpr double sliding = 1e-7;

/// Returns where a f^2 + 2 b f + c falls through zero in [0, 1]; 0 where it already is below, which only
/// rounding can make so of what does not touch at the start.
std::optional<double> first_root(double a, double b, double c, double radius) {
  if (!(a > 0) || !(b < 0)) return std::nullopt;
  const double discriminant = b * b - a * c;
  if (!(discriminant > grazing * grazing * a * radius * radius)) return std::nullopt;
  const double fraction = std::max((-b - std::sqrt(discriminant)) / a, 0.0);
  if (!(fraction <= 1)) return std::nullopt;
  return fraction;
}

struct Moving {
  Vec3 from, way;
  double radius;

  Vec3 at(double fraction) const { return from + fraction * way; }
};

std::optional<double> meets_ball(const Moving& ball, const Vec3& corner) {
  const Vec3 m = ball.from - corner;
  return first_root(ball.way.squaredNorm(), m.dot(ball.way), m.squaredNorm() - ball.radius * ball.radius,
                    ball.radius);
}

std::optional<double> meets_cylinder(const Moving& ball, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a, m = ball.from - a;
  const double length = edge.squaredNorm();
  if (!(length > 0)) return std::nullopt;
  const Vec3 way = ball.way - (ball.way.dot(edge) / length) * edge,
             across = m - (m.dot(edge) / length) * edge;
  const std::optional<double> fraction = first_root(
      way.squaredNorm(), across.dot(way), across.squaredNorm() - ball.radius * ball.radius, ball.radius);
  if (!fraction) return std::nullopt;
  const double along = (ball.at(*fraction) - a).dot(edge);
  return along >= 0 && along <= length ? fraction : std::nullopt;
}

std::optional<double> meets_face(const Moving& ball, const Triangle& t) {
  Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = normal.norm();
  if (!(area > 0)) return std::nullopt;
  normal /= area;
  double height = normal.dot(ball.from - t[0]);
  if (height < 0) height = -height, normal = -normal;
  const double sinking = -normal.dot(ball.way);
  if (!(sinking > sliding * ball.way.norm())) return std::nullopt;
  const double fraction = std::max((height - ball.radius) / sinking, 0.0);
  if (!(fraction <= 1)) return std::nullopt;
  const Vec3 center = ball.at(fraction), foot = center - normal.dot(center - t[0]) * normal;
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = (t[(i + 1) % 3] - t[i]).cross(foot - t[i]).dot((t[1] - t[0]).cross(t[2] - t[0]));
    if (side < 0) return std::nullopt;
  }
  return fraction;
}

std::optional<SweepHit> ball_meets(const Moving& ball, const Triangle& t) {
  const Vec3 start_gap = ball.from - nearest_on_triangle(ball.from, t);
  if (start_gap.squaredNorm() <= ball.radius * ball.radius) {
    if (!(start_gap.dot(ball.way) < -sliding * start_gap.norm() * ball.way.norm())) return std::nullopt;
    return SweepHit{0, start_gap.normalized(), 0};
  }
  std::optional<double> first = meets_face(ball, t);
  const auto consider = [&](const std::optional<double>& fraction) {
    if (fraction && (!first || *fraction < *first)) first = fraction;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    consider(meets_cylinder(ball, t[i], t[(i + 1) % 3]));
    consider(meets_ball(ball, t[i]));
  }
  if (!first) return std::nullopt;
  const Vec3 center = ball.at(*first), gap = center - nearest_on_triangle(center, t);
  return SweepHit{*first, gap.norm() > 0 ? Vec3(gap.normalized()) : Vec3(-ball.way.normalized()), 0};
}

std::optional<SweepHit> point_meets(const Vec3& from, const Vec3& to, const Triangle& t, double smallest) {
  const std::optional<double> fraction = segment_meets(from, to, t);
  const Vec3 twice_area = (t[1] - t[0]).cross(t[2] - t[0]);
  if (!fraction || twice_area.squaredNorm() < smallest) return std::nullopt;
  const Vec3 normal = twice_area.normalized();
  return SweepHit{*fraction, normal.dot(to - from) > 0 ? Vec3(-normal) : normal, 0};
}

class PlainSweeper final : public Sweeper {
 public:
  PlainSweeper(const TriangleMesh& mesh, double smallest) : mesh_(mesh), smallest_(smallest) {}

  std::optional<SweepHit> first_hit(const Vec3& from, const Vec3& to, double radius) override {
    std::optional<SweepHit> first;
    if (from == to) return first;
    mesh_.near(from, to, radius, [&](std::uint32_t index, const Triangle& triangle) {
      std::optional<SweepHit> hit = radius > 0 ? ball_meets({from, to - from, radius}, triangle)
                                               : point_meets(from, to, triangle, smallest_);
      if (!hit || (first && !(hit->fraction < first->fraction))) return;
      hit->triangle = index;
      first = hit;
    });
    return first;
  }
  void update(const TriangleMesh& mesh) override { mesh_.update(mesh); }
  std::uint64_t work() const override { return mesh_.work(); }

 private:
  PlainMesh mesh_;
  double smallest_;
};

}  // namespace

std::unique_ptr<Sweeper> plain_sweeper(const TriangleMesh& mesh, double smallest) {
  return std::make_unique<PlainSweeper>(mesh, smallest);
}

}  // namespace touchmark::bench::proxies
