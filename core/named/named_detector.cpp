#include "core/named/named_detector.h"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/named/detector_options.h"
#include "core/named/option_text.h"
#include "core/sign/signed_detector.h"

namespace touchmark {
namespace {

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
  LimitedWork* limited_work([[maybe_unused]] Session& session) const noexcept override {
    if constexpr (KeepsToLimit<D>) return &own(session).work;
    return nullptr;
  }
  std::optional<Impact> first_hit_moving([[maybe_unused]] const Sweep& sweep,
                                         [[maybe_unused]] const MeshMotion& motion,
                                         [[maybe_unused]] Session& session) const noexcept override {
    if constexpr (AnswersMovingSweep<D>) return detector_.first_hit_moving(sweep, motion, own(session));
    return std::nullopt;
  }
  bool sees_mesh_motion() const noexcept override { return AnswersMovingSweep<D>; }
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

template <class D>
std::unique_ptr<NamedDetector> built(const TriangleMesh& mesh, const typename D::Options& options,
                                     bool side) {
  if (side) return std::make_unique<Named<Signed<D>>>(Signed<D>::build(mesh, options));
  return std::make_unique<Named<D>>(D::build(mesh, options));
}

std::unique_ptr<NamedDetector> built_form(const TriangleMesh& mesh, const BruteForce::Options& options,
                                          bool side) {
  return built<BruteForce>(mesh, options, side);
}
std::unique_ptr<NamedDetector> built_form(const TriangleMesh& mesh, const AabbTree::Options& options,
                                          bool side) {
  return built<AabbTree>(mesh, options, side);
}
std::unique_ptr<NamedDetector> built_form(const TriangleMesh& mesh, const named::GridGroupForm& form,
                                          bool side) {
  return form.is_published ? built<PublishedGridGroup>(mesh, form.published_options(), side)
                           : built<GridGroup>(mesh, form.fast, side);
}
std::unique_ptr<NamedDetector> built_form(const TriangleMesh& mesh, const named::SphereClusterForm& form,
                                          bool side) {
  return form.is_published() ? built<PublishedSphereCluster>(mesh, form.published_options(), side)
                             : built<SphereCluster>(mesh, form.fast, side);
}

template <class Form>
std::unique_ptr<NamedDetector> build_named(const TriangleMesh& mesh, const std::string& name,
                                           std::string_view text) {
  Form form;
  bool side = false;
  std::vector<named::Option> options = named::options_of(form);
  options.push_back(named::side_option(side));
  named::read_options(name, text, mesh, options);
  return built_form(mesh, form, side);
}

struct Maker {
  std::string_view name;
  std::unique_ptr<NamedDetector> (*build)(const TriangleMesh&, const std::string& name,
                                          std::string_view text);
};
/// The last is a former name, until 0.4.
constexpr std::array<Maker, 5> makers{{{"brute-force", build_named<BruteForce::Options>},
                                       {"aabb-tree", build_named<AabbTree::Options>},
                                       {"grid-group", build_named<named::GridGroupForm>},
                                       {"sphere-cluster", build_named<named::SphereClusterForm>},
                                       {"auto", build_named<named::SphereClusterForm>}}};

}  // namespace

void NamedDetector::expect_limited(std::uint64_t max_work, Session& session) const {
  if (max_work > 0 && limited_work(session) == nullptr)
    throw std::invalid_argument("max_work is " + std::to_string(max_work) +
                                ", but this detector keeps to no limit; sphere-cluster and grid-group do");
}

void NamedDetector::expect_sees_mesh_motion() const {
  if (!sees_mesh_motion())
    throw std::invalid_argument(
        "this detector does not see how a mesh moves; sphere-cluster, aabb-tree and brute-force do");
}

std::string_view NamedDetector::names() noexcept {
  return "brute-force, aabb-tree, grid-group, sphere-cluster";
}

std::unique_ptr<NamedDetector> NamedDetector::build(const TriangleMesh& mesh, std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  for (const Maker& maker : makers) {
    if (maker.name != name) continue;
    return maker.build(mesh, std::string(name),
                       colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1));
  }
  throw std::invalid_argument("unknown detector \"" + std::string(name) + "\"; there are " +
                              std::string(names()));
}

}  // namespace touchmark
