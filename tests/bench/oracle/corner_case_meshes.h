/// Small meshes on which culling goes wrong first: ties everywhere, nothing to cull by, no area, far away.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/triangle_mesh.h"
#include "tests/bench/oracle/corner_case_triangles.h"

namespace touchmark {

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

using bench::experiments::stress::mesh_of;

/// An octahedron whose faces are divided into squares of `parts` and pushed out to the unit sphere: to its
/// centre, the triangles of eight octants are exact mirror images.
inline TriangleMesh octasphere(int parts) {
  std::vector<CornerCases::Corners> triangles;
  const auto at = [&](int i, int j, const Vec3& sign) -> Vec3 {
    const Vec3 v(i, j, parts - i - j);
    return sign.cwiseProduct(v).normalized();
  };
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 sign((octant & 1) != 0 ? -1 : 1, (octant & 2) != 0 ? -1 : 1, (octant & 4) != 0 ? -1 : 1);
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; i + j < parts; ++j) {
        triangles.push_back({at(i, j, sign), at(i + 1, j, sign), at(i, j + 1, sign)});
        if (i + j + 1 < parts)
          triangles.push_back({at(i + 1, j, sign), at(i + 1, j + 1, sign), at(i, j + 1, sign)});
      }
    }
  }
  return mesh_of(triangles);
}

/// Squares of side 1 in the plane z = 0, split in two: every interior vertex belongs to six triangles.
inline TriangleMesh plate(int size) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (size + 1) + j); };
  for (int i = 0; i <= size; ++i)
    for (int j = 0; j <= size; ++j) vertices.emplace_back(i, j, 0);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

inline std::vector<NamedMesh> corner_case_meshes() {
  CornerCases cases(20);
  std::vector<CornerCases::Corners> needles, flat, soup, doubled, fan;
  for (int i = 0; i < 60; ++i) {
    needles.push_back(cases.below(2) == 0 ? cases.needle() : cases.cap());
    flat.push_back(cases.below(2) == 0 ? cases.collinear() : cases.coincident());
    soup.push_back(cases.plain());
    const CornerCases::Corners t = cases.on_lattice();
    doubled.push_back(t);
    doubled.push_back(t);
    const double angle = 1e-9 * i, next = 1e-9 * (i + 1);
    fan.push_back(
        {Vec3(0, 0, 0), Vec3(std::cos(angle), std::sin(angle), 0), Vec3(std::cos(next), std::sin(next), 0)});
  }
  std::vector<NamedMesh> meshes;
  meshes.push_back({"needles and caps", mesh_of(needles)});
  meshes.push_back({"no area", mesh_of(flat)});
  meshes.push_back({"soup", mesh_of(soup)});
  meshes.push_back({"each triangle twice", mesh_of(doubled)});
  meshes.push_back({"sliver fan", mesh_of(fan)});
  meshes.push_back({"octasphere", octasphere(4)});
  meshes.push_back({"plate", plate(6)});
  meshes.push_back({"one triangle", mesh_of({soup[0]})});
  meshes.push_back({"soup far away", mesh_of(soup).transformed(1, Vec3::Constant(1e9))});
  meshes.push_back({"tiny octasphere", octasphere(3).transformed(1e-9, Vec3::Zero())});
  meshes.push_back({"huge plate", plate(5).transformed(0x1p300, Vec3::Zero())});
  return meshes;
}

/// On and about features, in the middle of the box, and from far to very far.
inline std::vector<Vec3> corner_case_points(const TriangleMesh& mesh, CornerCases& cases, int count) {
  std::vector<Vec3> points;
  const Vec3 middle = mesh.bounds().center();
  points.push_back(middle);
  for (const double distance : {1e3, 1e9, 1e16, 1e30})
    points.push_back(middle + distance * mesh.diagonal() * cases.vector());
  points.push_back(middle + 1e12 * mesh.diagonal() * Vec3::UnitZ());
  while (static_cast<int>(points.size()) < count) {
    const std::size_t i = cases.below(mesh.size());
    points.push_back(cases.point_near({mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)}));
  }
  return points;
}

}  // namespace touchmark
