/// The shapes of a scene: those that are built, and those whose source is asked when they are first needed.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/detector.h"
#include "core/scene/body.h"
#include "core/scene/round/round_body.h"
#include "core/scene/shape.h"

namespace touchmark {

/// Copies share the shapes, also those that are made later. Threads may ask while one is made.
template <Detector D>
class ShapeTable {
 public:
  void add(Shape<D> shape) {
    auto entry = std::make_shared<Entry>();
    entry->shape = std::move(shape);
    entry->built.store(&entry->shape, std::memory_order_release);
    entries_.push_back(std::move(entry));
  }
  void add(ShapeSource<D> source) {
    auto entry = std::make_shared<Entry>();
    entry->source = std::move(source);
    entries_.push_back(std::move(entry));
  }

  /// Returns the shape if it is built, else null.
  const Shape<D>* built(std::uint32_t index) const noexcept {
    return entries_[index]->built.load(std::memory_order_acquire);
  }
  /// Makes the shape if it is not built. Throws what its source throws, each time.
  const Shape<D>& make(std::uint32_t index) const {
    Entry& entry = *entries_[index];
    const std::lock_guard lock(entry.making);
    if (const Shape<D>* shape = built(index)) return *shape;
    if (entry.failure) std::rethrow_exception(entry.failure);
    try {
      entry.shape = checked(entry.source.make(), entry.source.bounds);
    } catch (...) {
      entry.failure = std::current_exception();
      throw;
    }
    entry.built.store(&entry.shape, std::memory_order_release);
    return entry.shape;
  }
  /// Returns the shape, made if need be, or null where its source has failed.
  const Shape<D>* needed(std::uint32_t index) const noexcept {
    if (const Shape<D>* shape = built(index)) return shape;
    try {
      return &make(index);
    } catch (...) {
      return nullptr;
    }
  }
  /// What the first source that failed has thrown, or null.
  std::exception_ptr failure() const noexcept {
    for (const auto& entry : entries_) {
      const std::lock_guard lock(entry->making);
      if (entry->failure) return entry->failure;
    }
    return nullptr;
  }
  /// Has its source thrown?
  bool has_failed(std::uint32_t index) const noexcept {
    const std::lock_guard lock(entries_[index]->making);
    return entries_[index]->failure != nullptr;
  }
  /// Returns how many shapes are built.
  std::size_t count_built() const noexcept {
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < entries_.size(); ++i) count += built(i) == nullptr ? 0 : 1;
    return count;
  }
  std::size_t bytes() const noexcept {
    std::size_t bytes = entries_.size() * sizeof(Entry);
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
      const Shape<D>* shape = built(i);
      if (shape == nullptr) continue;
      if (shape->detector) bytes += shape->detector->bytes();
      bytes += shape->mesh->vertices().size_bytes() + shape->mesh->triangles().size_bytes() +
               shape->mesh->ids().size_bytes();
    }
    return bytes;
  }

  /// Throws SceneError for a shape that lacks its detector or its mesh, whose detector is not exact, or which
  /// is not within the bounds; and for a round one whose mesh is no axis or whose radius is out of range.
  static Shape<D> checked(Shape<D> shape, const Aabb& bounds) {
    if (!shape.mesh || (!shape.detector && !shape.is_round()))
      throw SceneError("a shape lacks its detector or its mesh");
    if (shape.is_round()) {
      expect_round(*shape.mesh, shape.radius);
    } else if (shape.detector->accuracy().guarantee != Guarantee::exact) {
      throw SceneError("a shape's detector does not claim exactness, which a scene builds on");
    }
    if (const Aabb own = shape.bounds(); !bounds.contains(own.min) || !bounds.contains(own.max))
      throw SceneError("a shape's mesh is not within the bounds that its source gave");
    return shape;
  }

 private:
  struct Entry {
    ShapeSource<D> source;
    Shape<D> shape;
    std::atomic<const Shape<D>*> built = nullptr;
    std::exception_ptr failure;
    std::mutex making;
  };

  std::vector<std::shared_ptr<Entry>> entries_;
};

}  // namespace touchmark
