// What an older core may lack is asked for with `__has_include` and `requires`, so that it can still be
// compared.
#include "bench/regression/driver/plugin.h"

#include <bit>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"
#if __has_include("core/sphere_cluster/published/published_sphere_cluster.h")
#include "core/grid_group/published/published_grid_group.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
using PublishedGridGroup = touchmark::PublishedGridGroup;
using PublishedSphereCluster = touchmark::PublishedSphereCluster;
#else
using PublishedGridGroup = touchmark::GridGroup;
using PublishedSphereCluster = touchmark::SphereCluster;
#endif

struct TouchmarkGateDetector {
  TouchmarkGateDetector() = default;
  TouchmarkGateDetector(const TouchmarkGateDetector&) = delete;
  TouchmarkGateDetector& operator=(const TouchmarkGateDetector&) = delete;
  virtual ~TouchmarkGateDetector() = default;

  virtual TouchmarkGateResult answer(const TouchmarkGatePass& pass) const = 0;
  virtual TouchmarkGateResult replay(const TouchmarkGatePass& pass) const = 0;
};

namespace {

using touchmark::Contact;
using touchmark::Impact;
using touchmark::Probe;
using touchmark::Vec3;

/// Whether, which and how far: little enough to be folded in while time is taken.
class Answers {
 public:
  void add(bool touching) noexcept { hash_combine(touching ? 1 : 0); }
  void add(const std::optional<Contact>& contact) noexcept { contact ? add(*contact, 0) : hash_combine(0); }
  void add(const std::optional<Impact>& impact) noexcept {
    impact ? add(impact->contact, impact->fraction) : hash_combine(0);
  }
  std::uint64_t value() const noexcept { return value_; }
  static std::uint64_t details() noexcept { return 0; }

 private:
  void add(const Contact& contact, double fraction) noexcept {
    hash_combine((std::uint64_t{contact.triangle} + 1) ^ std::bit_cast<std::uint64_t>(fraction));
    hash_combine(std::bit_cast<std::uint64_t>(contact.distance));
  }
  void hash_combine(std::uint64_t bits) noexcept {
    value_ = (std::rotl(value_, 7) ^ bits) * 0x9e3779b97f4a7c15ULL;
  }

  std::uint64_t value_ = 1;  // of nothing found in one step is not that of nothing in two
};

/// Hashes points and normals, too.
class FullAnswers {
 public:
  void add(bool touching) noexcept { answers_.add(touching); }
  void add(const std::optional<Contact>& contact) noexcept {
    answers_.add(contact);
    if (contact) add(*contact);
  }
  void add(const std::optional<Impact>& impact) noexcept {
    answers_.add(impact);
    if (impact) add(impact->contact);
  }
  std::uint64_t value() const noexcept { return answers_.value(); }
  std::uint64_t details() const noexcept { return details_; }

 private:
  void add(const Contact& contact) noexcept {
    for (const double x : {contact.point.x(), contact.point.y(), contact.point.z(), contact.normal.x(),
                           contact.normal.y(), contact.normal.z()})
      details_ = (std::rotl(details_, 7) ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
  }

  Answers answers_;
  std::uint64_t details_ = 0;
};

Vec3 center_of(const TouchmarkGatePass& pass, std::size_t step) noexcept {
  const double* const at = pass.centers + 3 * step;
  return {at[0], at[1], at[2]};
}

template <touchmark::Detector D>
class DetectorOf final : public TouchmarkGateDetector {
 public:
  explicit DetectorOf(D detector) : detector_(std::move(detector)) {}

  TouchmarkGateResult answer(const TouchmarkGatePass& pass) const override { return run<FullAnswers>(pass); }
  TouchmarkGateResult replay(const TouchmarkGatePass& pass) const override { return run<Answers>(pass); }

 private:
  using Session = typename D::Session;

  template <class Hash>
  TouchmarkGateResult run(const TouchmarkGatePass& pass) const {
    Session session;
    Hash hash;
    ask(pass, session, hash);
    const touchmark::Work& work = session.work;
    return {work.cells, work.spheres, work.boxes, work.triangles, hash.value(), hash.details()};
  }

  /// Not inline: what is counted is laid out the same whatever is around it.
  template <class Hash>
  [[gnu::noinline]] void ask(const TouchmarkGatePass& pass, Session& session, Hash& hash) const noexcept {
    switch (pass.query) {
      case touchmark_gate_touches:
        for (std::size_t i = 0; i < pass.count; ++i)
          hash.add(detector_.touches(Probe{center_of(pass, i), pass.radius}, session));
        return;
      case touchmark_gate_nearest:
        for (std::size_t i = 0; i < pass.count; ++i)
          hash.add(detector_.nearest(Probe{center_of(pass, i), pass.radius}, pass.reach, session));
        return;
      case touchmark_gate_sweep:
        for (std::size_t i = 0; i < pass.count; ++i) {
          const Vec3 from = center_of(pass, i > 0 ? i - 1 : 0);
          hash.add(detector_.first_hit(touchmark::Sweep{from, center_of(pass, i), pass.radius}, session));
        }
        return;
    }
  }

  D detector_;
};

using Built = std::unique_ptr<TouchmarkGateDetector>;

template <class D>
Built built(const touchmark::TriangleMesh& mesh, const typename D::Options& options = {}) {
  return std::make_unique<DetectorOf<D>>(D::build(mesh, options));
}

template <class Options>
void make_portable(Options& options) {
  if constexpr (requires { options.widest; }) {
    options.widest = decltype(options.widest)::portable;
  } else if constexpr (requires { options.portable; }) {
    options.portable = true;
  } else {
    throw std::invalid_argument("this core has no portable form");
  }
}

/// An older core's options choose the published form.
template <class D>
typename D::Options published_options() {
  typename D::Options options;
  if constexpr (requires { options.lookup; }) options.lookup = D::Lookup::scan;
  return options;
}

Built build(std::string_view name, const touchmark::TriangleMesh& mesh) {
  using touchmark::GridGroup;
  using touchmark::SphereCluster;
  if (name == "brute-force") return built<touchmark::BruteForce>(mesh);
  if (name == "aabb-tree") return built<touchmark::AabbTree>(mesh);
  if (name == "grid-group") return built<GridGroup>(mesh);
  if (name == "sphere-cluster") return built<SphereCluster>(mesh);
  auto grid = published_options<PublishedGridGroup>();
  if (name == "grid-group:lookup=scan") return built<PublishedGridGroup>(mesh, grid);
  grid.shape = PublishedGridGroup::Shape::sphere;
  if (name == "grid-group:lookup=scan,shape=sphere") return built<PublishedGridGroup>(mesh, grid);
  grid.groups = 5000;
  if (name == "grid-group:lookup=scan,shape=sphere,groups=5000") return built<PublishedGridGroup>(mesh, grid);
  grid.shape = PublishedGridGroup::Shape::cube;
  if (name == "grid-group:lookup=scan,groups=5000") return built<PublishedGridGroup>(mesh, grid);
  SphereCluster::Options spheres;
  spheres.clustering = 0.02 * mesh.diagonal();
  if (name == "sphere-cluster:clustering=2%") return built<SphereCluster>(mesh, spheres);
  auto published = published_options<PublishedSphereCluster>();
  published.clustering = spheres.clustering;
  if (name == "sphere-cluster:clustering=2%,lookup=scan")
    return built<PublishedSphereCluster>(mesh, published);
  published.precise = false;
  if (name == "sphere-cluster:clustering=2%,precise=false")
    return built<PublishedSphereCluster>(mesh, published);
  if (name == "sphere-cluster:portable") {
    SphereCluster::Options portable;
    make_portable(portable);
    return built<SphereCluster>(mesh, portable);
  }
  throw std::invalid_argument("this core knows no detector '" + std::string(name) + "'");
}

touchmark::TriangleMesh mesh_of(const TouchmarkGateMesh& mesh) {
  std::vector<Vec3> vertices;
  vertices.reserve(mesh.vertex_count);
  for (std::size_t i = 0; i < mesh.vertex_count; ++i) {
    const double* const at = mesh.vertices + 3 * i;
    vertices.emplace_back(at[0], at[1], at[2]);
  }
  std::vector<touchmark::TriangleMesh::Corners> triangles(mesh.triangle_count);
  for (std::size_t i = 0; i < mesh.triangle_count; ++i)
    std::copy_n(mesh.triangles + 3 * i, 3, triangles[i].begin());
  return {std::move(vertices), std::move(triangles)};
}

}  // namespace

TouchmarkGateDetector* touchmark_gate_build(const char* name, const TouchmarkGateMesh* mesh, char* error,
                                            std::size_t error_size) {
  try {
    return build(name, mesh_of(*mesh)).release();
  } catch (const std::exception& failure) {
    std::snprintf(error, error_size, "%s", failure.what());
    return nullptr;
  }
}

void touchmark_gate_answer(const TouchmarkGateDetector* detector, const TouchmarkGatePass* pass,
                           TouchmarkGateResult* result) {
  *result = detector->answer(*pass);
}

void touchmark_gate_replay(const TouchmarkGateDetector* detector, const TouchmarkGatePass* pass,
                           TouchmarkGateResult* result) {
  *result = detector->replay(*pass);
}

void touchmark_gate_destroy(TouchmarkGateDetector* detector) { delete detector; }
