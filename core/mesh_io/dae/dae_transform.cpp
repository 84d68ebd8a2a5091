#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>
#include <pugixml.hpp>

#include "core/mesh_io/dae/dae_parts.h"

namespace touchmark::mesh_io {
namespace {

using Matrix4 = Eigen::Matrix4d;

Matrix4 affine(const Eigen::Matrix3d& linear, const Vec3& shift) {
  Matrix4 matrix = Matrix4::Identity();
  matrix.topLeftCorner<3, 3>() = linear;
  matrix.topRightCorner<3, 1>() = shift;
  return matrix;
}

Matrix4 impossible() { return Matrix4::Constant(std::numeric_limits<double>::quiet_NaN()); }

/// Not finite where the vector has no length.
Vec3 direction(const Vec3& vector) { return vector / vector.stableNorm(); }

Matrix4 matrix(const double* v) {
  constexpr double rounding = 1e-6;  // of a program that multiplies in single precision
  Matrix4 matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(v);
  const Eigen::RowVector4d last(0, 0, 0, 1);
  if (!((matrix.row(3) - last).cwiseAbs().maxCoeff() <= rounding)) return impossible();
  matrix.row(3) = last;
  return matrix;
}

Matrix4 translate(const double* v) { return affine(Eigen::Matrix3d::Identity(), Vec3(v[0], v[1], v[2])); }

Matrix4 scale(const double* v) {
  return affine(Eigen::Matrix3d(Vec3(v[0], v[1], v[2]).asDiagonal()), Vec3::Zero());
}

/// Quarter turns, which files turn their axes by, are exact.
Matrix4 rotate(const double* v) {
  const double angle = std::remainder(v[3], 360.0), radians = angle * std::numbers::pi / 180;
  if (angle == 0) return Matrix4::Identity();
  const bool is_quarter = std::remainder(angle, 90.0) == 0;
  const double sine = is_quarter ? std::round(std::sin(radians)) : std::sin(radians);
  const double cosine = is_quarter ? std::round(std::cos(radians)) : std::cos(radians);
  const Vec3 axis = direction(Vec3(v[0], v[1], v[2]));
  Eigen::Matrix3d cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return affine(cosine * Eigen::Matrix3d::Identity() + sine * cross + (1 - cosine) * axis * axis.transpose(),
                Vec3::Zero());
}

/// As RenderMan has it: points move along `shift` so that the direction `turned` leans towards it by the
/// angle.
Matrix4 skew(const double* v) {
  const double radians = v[0] * std::numbers::pi / 180;
  const Vec3 turned = direction(Vec3(v[1], v[2], v[3])), shift = direction(Vec3(v[4], v[5], v[6]));
  const double along = turned.dot(shift);
  const Vec3 across = turned - along * shift;
  const double height = across.norm();
  const double leaning_height = height * std::cos(radians) - along * std::sin(radians);
  constexpr double least = 1e-9;  // of parallel axes, and of an angle that leans over to `shift` itself
  if (!(height > least && leaning_height > least)) return impossible();
  const double leaning = (height * std::sin(radians) + along * std::cos(radians)) / leaning_height;
  const double slope = leaning - along / height;
  return affine(Eigen::Matrix3d::Identity() + slope / height * shift * across.transpose(), Vec3::Zero());
}

/// The frame of an eye that looks along its -z at a target.
Matrix4 lookat(const double* v) {
  const Vec3 eye(v[0], v[1], v[2]), target(v[3], v[4], v[5]), up(v[6], v[7], v[8]);
  const Vec3 z = direction(eye - target), x = direction(direction(up).cross(z));
  Eigen::Matrix3d frame;
  frame << x, z.cross(x), z;
  return affine(frame, eye);
}

struct Kind {
  std::string_view name;
  std::size_t size;
  Matrix4 (*matrix)(const double* numbers);
  const char* fault;  ///< why the matrix is not finite
};

constexpr std::array<Kind, 6> kinds = {{
    {"matrix", 16, matrix, "its last row is not 0 0 0 1"},
    {"translate", 3, translate, ""},
    {"rotate", 4, rotate, "its axis has no length"},
    {"scale", 3, scale, ""},
    {"skew", 7, skew, "its axes are parallel, or its angle is too large"},
    {"lookat", 9, lookat, "its eye, target and up direction are in one line"},
}};

}  // namespace

std::optional<Matrix4> dae_transform(const DaeDocument& document, const pugi::xml_node& element) {
  for (const Kind& kind : kinds) {
    if (kind.name != element.name()) continue;
    const std::vector<double> numbers = document.numbers(element);
    if (numbers.size() != kind.size)
      document.fail(element, "has ", numbers.size(), " numbers; it takes ", kind.size);
    const Matrix4 matrix = kind.matrix(numbers.data());
    if (!matrix.allFinite()) document.fail(element, kind.fault);
    return matrix;
  }
  return std::nullopt;
}

}  // namespace touchmark::mesh_io
