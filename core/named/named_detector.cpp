#include "core/named/named_detector.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/named/option_text.h"
#include "core/named/published_form.h"
#include "core/sign/signed_detector.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark {
namespace {

using named::expect_published;
using named::OptionText;

template <class D>
class Named final : public NamedDetector {
 public:
  explicit Named(D detector) : detector_(std::move(detector)) {}

  std::unique_ptr<Session> begin_session() const override { return std::make_unique<OfThis>(); }

  bool touches(const Probe& probe, Session& session) const noexcept override {
    return detector_.touches(probe, own(session));
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept override {
    return detector_.nearest(probe, reach, own(session));
  }
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept override {
    return detector_.first_hit(sweep, own(session));
  }
  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept override {
    return detector_.contacts(probe, reach, own(session), into);
  }
  void prepare([[maybe_unused]] Session& session) const noexcept override {
    if constexpr (Prepares<D>) detector_.prepare(own(session));
  }
  std::size_t bytes() const noexcept override { return detector_.bytes(); }
  Accuracy accuracy() const noexcept override { return detector_.accuracy(); }
  void update(const TriangleMesh& mesh) override { detector_.update(mesh); }

 private:
  struct OfThis final : Session {
    typename D::Session session;
  };
  static typename D::Session& own(Session& session) noexcept { return static_cast<OfThis&>(session).session; }

  D detector_;
};

template <class Value, std::size_t count>
using Choices = std::array<std::pair<std::string_view, Value>, count>;
constexpr Choices<bool, 2> yes_or_no{{{"true", true}, {"false", false}}};
constexpr Choices<bool, 2> on_or_off{{{"off", false}, {"on", true}}};

/// Reads the last of a detector's options, which all have.
bool read_side(OptionText& text) {
  bool side = false;
  text.read_choice("side", on_or_off, side);
  text.expect_nothing_left();
  return side;
}

template <class D>
std::unique_ptr<NamedDetector> built(const TriangleMesh& mesh, const typename D::Options& options,
                                     bool side) {
  if (side) return std::make_unique<Named<Signed<D>>>(Signed<D>::build(mesh, options));
  return std::make_unique<Named<D>>(D::build(mesh, options));
}

/// A number that does not fit is more than any detector takes, and is refused by it.
void read_threads(OptionText& text, unsigned& threads) {
  std::size_t count = threads;
  text.read_count("threads", count);
  threads = static_cast<unsigned>(std::min<std::size_t>(count, std::numeric_limits<unsigned>::max()));
}

std::unique_ptr<NamedDetector> brute_force(const TriangleMesh& mesh, OptionText& text) {
  return built<BruteForce>(mesh, {}, read_side(text));
}

std::unique_ptr<NamedDetector> aabb_tree(const TriangleMesh& mesh, OptionText& text) {
  AabbTree::Options options;
  text.read_count("leaf_size", options.leaf_size);
  text.read_choice("certified", yes_or_no, options.certified);
  read_threads(text, options.threads);
  return built<AabbTree>(mesh, options, read_side(text));
}

std::unique_ptr<NamedDetector> grid_group(const TriangleMesh& mesh, OptionText& text) {
  using Shape = PublishedGridGroup::Shape;
  using Construction = GridGroup::Construction;
  constexpr Choices<bool, 2> lookups{{{"direct", false}, {"scan", true}}};
  constexpr Choices<Shape, 3> shapes{
      {{"cube", Shape::cube}, {"sphere", Shape::sphere}, {"centered-sphere", Shape::centered_sphere}}};
  constexpr Choices<Construction, 2> builds{{{"whole", Construction::whole}, {"lazy", Construction::lazy}}};
  bool scans = false;
  GridGroup::Options options;
  PublishedGridGroup::Options published;
  text.read_choice("lookup", lookups, scans);
  text.read_choice("shape", shapes, published.shape);
  text.read_length("cell", mesh, options.cell);
  text.read_count("groups", published.groups);
  text.read_number("bytes_per_triangle", options.bytes_per_triangle);
  text.read_choice("certified", yes_or_no, options.certified);
  text.read_choice("build", builds, options.construction);
  read_threads(text, options.threads);
  const bool side = read_side(text);
  if (!scans) return built<GridGroup>(mesh, options, side);
  expect_published(options);
  published.cell = options.cell;
  return built<PublishedGridGroup>(mesh, published, side);
}

std::unique_ptr<NamedDetector> sphere_cluster(const TriangleMesh& mesh, OptionText& text) {
  using Construction = SphereCluster::Construction;
  constexpr Choices<bool, 2> lookups{{{"tree", false}, {"scan", true}}};
  constexpr Choices<Simd, 3> widths{
      {{"avx2", Simd::avx2}, {"avx512", Simd::avx2}, {"portable", Simd::portable}}};
  constexpr Choices<Construction, 2> builds{{{"whole", Construction::whole}, {"lazy", Construction::lazy}}};
  bool scans = false;
  SphereCluster::Options options;
  PublishedSphereCluster::Options published;
  text.read_choice("lookup", lookups, scans);
  text.read_length("clustering", mesh, options.clustering);
  text.read_choice("precise", yes_or_no, published.precise);
  text.read_choice("certified", yes_or_no, options.certified);
  text.read_choice("build", builds, options.construction);
  text.read_choice("simd", widths, options.widest);
  read_threads(text, options.threads);
  const bool side = read_side(text);
  if (!scans && published.precise) return built<SphereCluster>(mesh, options, side);
  expect_published(options);
  published.clustering = options.clustering;
  return built<PublishedSphereCluster>(mesh, published, side);
}

struct Maker {
  std::string_view name;
  std::unique_ptr<NamedDetector> (*build)(const TriangleMesh&, OptionText&);
};
/// The last is a former name, until 0.4.
constexpr std::array<Maker, 5> makers{{{"brute-force", brute_force},
                                       {"aabb-tree", aabb_tree},
                                       {"grid-group", grid_group},
                                       {"sphere-cluster", sphere_cluster},
                                       {"auto", sphere_cluster}}};

}  // namespace

std::string_view NamedDetector::names() noexcept {
  return "brute-force, aabb-tree, grid-group, sphere-cluster";
}

std::unique_ptr<NamedDetector> NamedDetector::build(const TriangleMesh& mesh, std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  for (const Maker& maker : makers) {
    if (maker.name != name) continue;
    OptionText options(std::string(name),
                       colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1));
    return maker.build(mesh, options);
  }
  throw std::invalid_argument("unknown detector \"" + std::string(name) + "\"; there are " +
                              std::string(names()));
}

}  // namespace touchmark
