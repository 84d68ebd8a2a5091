/// FCL's continuous collision of a ball with a mesh, as its default request has it: poses sampled evenly
/// along the way, the first that collides. Between two samples it sees nothing. Its conservative advancement
/// is not offered: for a mesh and a ball in pure translation FCL 0.7 finds no contact at all by it.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "baselines/hidden.h"
#include "core/detector.h"

namespace touchmark::baselines {

/// Answers sweeps only; satisfies Detector, Updates and AnswersSweep.
class FclCcd {
 public:
  struct Options {
    std::size_t samples = 10;  ///< FCL's own default
  };
  struct Session {
    Work work;  ///< triangles: contacts that FCL reports. It does not tell what it looks at.
  };

  /// Throws MeshError for more than 2^31 - 1 triangles or vertices.
  static FclCcd build(const TriangleMesh& mesh, const Options& options);
  void update(const TriangleMesh& mesh);

  /// The fraction is that of the last sample before the first that collides: where a program would stop. The
  /// contact is FCL's deepest at the sample that collides.
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept;

  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  struct Model;
  explicit FclCcd(Hidden<Model> model) noexcept : model_(std::move(model)) {}

  Hidden<Model> model_;
};

}  // namespace touchmark::baselines
