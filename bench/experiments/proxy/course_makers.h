/// What the families' makers share. Makers are listed in families.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/experiments/proxy/motion.h"
#include "bench/meshes/surface_builder.h"
#include "bench/proxies/course.h"
#include "bench/support/random.h"

namespace touchmark::bench::experiments::proxy {

using proxies::Course;

/// The usual size of a course's meshes: as of what fits under a haptic device, in metres.
inline constexpr double course_size = 0.1;

/// Seeds of one round's courses are this far from those of the next round.
inline constexpr std::uint64_t course_seed = 1000;

/// An orthonormal frame, its columns any directions.
struct Frame {
  Vec3 x, y, z;

  Vec3 operator()(const Vec3& v) const { return v.x() * x + v.y() * y + v.z() * z; }
};
inline constexpr auto upright = [] { return Frame{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}; };
Frame any_frame(support::Random& random);

TriangleMesh placed(const TriangleMesh& mesh, double scale, const Frame& frame);

/// The ticks of each of so many courses.
inline std::size_t share_of(std::size_t ticks, std::size_t courses) {
  return std::max<std::size_t>(ticks / courses, 50);
}

/// Every other course is of a bare point, the others of a ball of this share of the size.
inline double radius_of(std::size_t course, double size, double share = 0.03) {
  return course % 2 == 0 ? share * size : 0;
}

/// To and fro between -1 and 1, so many changes a period.
struct Swing {
  double period, phase;

  double at(std::size_t change) const;
};

/// Goes about the middle, and far from it at times.
std::vector<Vec3> about_the_middle(const Vec3& start, std::size_t ticks, support::Random& random);

/// A course that explores the mesh from outside its box.
Course exploring(std::string name, TriangleMesh mesh, double radius, std::uint64_t seed, std::size_t ticks);

std::vector<Course> thin_plates(std::uint64_t seed, std::size_t ticks);
std::vector<Course> wedges_inside(std::uint64_t seed, std::size_t ticks);
std::vector<Course> wedges_outside(std::uint64_t seed, std::size_t ticks);
std::vector<Course> corners(std::uint64_t seed, std::size_t ticks);
std::vector<Course> rooms(std::uint64_t seed, std::size_t ticks);
std::vector<Course> saddles(std::uint64_t seed, std::size_t ticks);
std::vector<Course> convex_edges(std::uint64_t seed, std::size_t ticks);
std::vector<Course> cracks(std::uint64_t seed, std::size_t ticks);
std::vector<Course> needle_fans(std::uint64_t seed, std::size_t ticks);
std::vector<Course> t_junctions(std::uint64_t seed, std::size_t ticks);
std::vector<Course> holes(std::uint64_t seed, std::size_t ticks);
std::vector<Course> self_intersections(std::uint64_t seed, std::size_t ticks);
std::vector<Course> doubled_faces(std::uint64_t seed, std::size_t ticks);
std::vector<Course> scaled_meshes(std::uint64_t seed, std::size_t ticks);
std::vector<Course> stabs(std::uint64_t seed, std::size_t ticks);
std::vector<Course> rest_inside(std::uint64_t seed, std::size_t ticks);
std::vector<Course> circles(std::uint64_t seed, std::size_t ticks);
std::vector<Course> tremors(std::uint64_t seed, std::size_t ticks);
std::vector<Course> friction(std::uint64_t seed, std::size_t ticks);
std::vector<Course> deforming(std::uint64_t seed, std::size_t ticks);
std::vector<Course> moving_bodies(std::uint64_t seed, std::size_t ticks);
std::vector<Course> passing_bodies(std::uint64_t seed, std::size_t ticks);
std::vector<Course> passing_sheets(std::uint64_t seed, std::size_t ticks);

}  // namespace touchmark::bench::experiments::proxy
