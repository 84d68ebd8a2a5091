/// A scene that one thread moves while others ask: each query sees the bodies of one frame.
///
/// There are two copies of where the bodies are (of shapes there is one). Readers ask the one that was
/// published last; the publishing thread changes the other, and publishing exchanges them: the left-right
/// technique of Ramalhete and Correia, "Left-Right: a concurrency control technique with wait-free population
/// oblivious reads" (2015). What was changed is made good in the other copy before the next change, when its
/// readers have long left.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include "core/scene/scene.h"

namespace touchmark {

/// One thread publishes; any number of threads read, each with a session of its own. Sessions go on from
/// frame to frame.
template <BodyDetector D>
class SharedScene {
 public:
  SharedScene() : copies_{Scene<D>(), Scene<D>()} { copies_[1] = Scene<D>(copies_[0]); }
  SharedScene(const SharedScene&) = delete;
  SharedScene& operator=(const SharedScene&) = delete;
  ~SharedScene() = default;

  /// The scene as it was published last, for as long as this lives: a query or a tick, not more. While it
  /// does, the publishing thread waits with its next change but one.
  class Frame {
   public:
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;
    ~Frame() { readers_.fetch_sub(1); }

    const Scene<D>& operator*() const noexcept { return scene_; }
    const Scene<D>* operator->() const noexcept { return &scene_; }

   private:
    friend class SharedScene;
    Frame(const Scene<D>& scene, std::atomic<std::uint32_t>& readers) noexcept
        : scene_(scene), readers_(readers) {}

    const Scene<D>& scene_;
    std::atomic<std::uint32_t>& readers_;
  };

  /// For any thread. Never waits and takes no memory.
  Frame read() const noexcept {
    std::atomic<std::uint32_t>& readers = readers_[version_.load()].count;
    readers.fetch_add(1);
    return Frame(copies_[published_.load()], readers);
  }

  /// These are the publishing thread's. What they change is seen by nobody before publish(). They throw what
  /// those of Scene throw.
  ShapeId add_shape(Shape<D> shape) { return hidden().add_shape(std::move(shape)); }
  /// The shape is made when a query first needs it, which that query then waits for.
  ShapeId add_shape(ShapeSource<D> source) { return hidden().add_shape(std::move(source)); }
  BodyId add(ShapeId shape, const Pose& pose) {
    const BodyId id = hidden().add(shape, pose);
    changed_.push_back(id.index);
    return id;
  }
  void move(BodyId id, const Pose& pose) {
    hidden().move(id, pose);
    changed_.push_back(id.index);
  }
  void remove(BodyId id) {
    hidden().remove(id);
    changed_.push_back(id.index);
  }
  void reserve(std::size_t bodies) {
    hidden().reserve(bodies);
    changed_.reserve(bodies);
  }
  /// Shows all changes since the last call at once. Takes no memory and waits for nobody.
  void publish() noexcept {
    if (is_behind_) return;  // nothing has changed: the other copy is older
    const std::size_t next = 1 - published_.load();
    copies_[next].bodies_.end_span();  // what sessions see of this frame, later moves are not part of
    published_.store(next);
    is_behind_ = true;
  }

  /// Returns what both copies take, and the shapes, which they share.
  std::size_t bytes() const noexcept { return bytes_of_bodies() + copies_[0].bytes_of_shapes(); }
  /// Returns what both copies take beside the shapes.
  std::size_t bytes_of_bodies() const noexcept {
    return copies_[0].bytes_of_bodies() + copies_[1].bytes_of_bodies() +
           changed_.capacity() * sizeof(std::uint32_t);
  }

 private:
  struct alignas(64) Readers {
    std::atomic<std::uint32_t> count = 0;
  };

  /// Returns the copy that nobody reads, as far as the published one.
  Scene<D>& hidden() {
    const std::size_t published = published_.load();
    Scene<D>& other = copies_[1 - published];
    if (is_behind_) {
      wait_for_readers();
      other.follow(copies_[published], changed_);
      changed_.clear();
      is_behind_ = false;
    }
    return other;
  }
  /// Returns when all who may have begun before the last publish() are gone. Who comes now counts as of the
  /// other version, so that nobody can keep this waiting who comes again and again.
  void wait_for_readers() noexcept {
    const std::size_t before = version_.load(), next = 1 - before;
    while (readers_[next].count.load() != 0) std::this_thread::yield();
    version_.store(next);
    while (readers_[before].count.load() != 0) std::this_thread::yield();
  }

  std::array<Scene<D>, 2> copies_;
  std::atomic<std::size_t> published_ = 0;
  std::atomic<std::size_t> version_ = 0;
  mutable std::array<Readers, 2> readers_;
  std::vector<std::uint32_t>
      changed_;  ///< bodies in which the hidden copy is ahead, or behind after publish()
  bool is_behind_ = false;
};

}  // namespace touchmark
