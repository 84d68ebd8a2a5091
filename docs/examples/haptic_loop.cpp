/// Two haptic threads, as docs/real-time.md describes them: a proxy follows a simulated device over a plate
/// at 1 kHz, and the device gets its force at 4 kHz by the planes that hold the proxy. Nothing that could
/// make a tick late happens inside the loops. The device is a mass that a hand holds by a spring; where the
/// hand wants it is in a CSV file: time_s,x,y,z in seconds and metres.
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <sched.h>
#include <sys/mman.h>
#include <time.h>
#include <touchmark/proxy.h>
#include <touchmark/sphere_cluster.h>

namespace {

using touchmark::Vec3;

constexpr long proxy_period_ns = 1'000'000, device_period_ns = 250'000;
constexpr double device_period_s = 1e-9 * device_period_ns;
constexpr touchmark::Coupling coupling{.radius = 0.005,
                                       .stiffness = 1000,
                                       .damping = 1,
                                       .tick_s = 1e-9 * proxy_period_ns,
                                       .max_work = 6000};  // bounds a step on any mesh

/// A square plate in the plane z = 0, in metres.
touchmark::TriangleMesh plate() {
  return touchmark::TriangleMesh({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}},
                                 {{0, 1, 2}, {0, 2, 3}});
}

/// Tells where the hand wants the tip at each tick of the device, straight from one row of the file to the
/// next.
std::vector<Vec3> hand_positions(const char* path) {
  std::vector<Vec3> positions;
  std::ifstream file(path);
  std::string line;
  double time = 0, x = 0, y = 0, z = 0, last_time = 0;
  Vec3 last = Vec3::Zero();
  while (std::getline(file, line)) {
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &time, &x, &y, &z) != 4) continue;  // the header
    const Vec3 to(x, y, z);
    if (positions.empty()) positions.push_back(to);
    const double first = static_cast<double>(positions.size());
    for (double tick = first; tick * device_period_s <= time + device_period_s / 2; ++tick)
      positions.push_back(last + (tick * device_period_s - last_time) / (time - last_time) * (to - last));
    last = to;
    last_time = time;
  }
  return positions;
}

/// Stands for the device: a mass on the hand's spring and damper.
struct Device {
  static constexpr double mass = 0.1, grip = 200, hand_damping = 5;  // kg, N/m, N s/m

  Vec3 position, velocity = Vec3::Zero();

  void move(const Vec3& hand, const Vec3& force) {
    velocity += device_period_s / mass * (grip * (hand - position) - hand_damping * velocity + force);
    position += device_period_s * velocity;
  }
};

/// Hands the newest value of one thread to one other thread. Neither ever waits, and both take no memory:
/// each has a place of its own, and a third one changes hands.
template <class T>
class Newest {
 public:
  void write(const T& value) {
    places_[written_] = value;
    written_ = between_.exchange(written_ | is_new, std::memory_order_acq_rel) & ~is_new;
  }
  const T& read() {
    if ((between_.load(std::memory_order_relaxed) & is_new) != 0)
      read_ = between_.exchange(read_, std::memory_order_acq_rel) & ~is_new;
    return places_[read_];
  }

 private:
  static constexpr unsigned is_new = 4;
  std::array<T, 3> places_{};
  std::atomic<unsigned> between_{1};
  unsigned written_ = 0, read_ = 2;
};

void report(const char* what, int result) {
  if (result != 0) std::fprintf(stderr, "%s: %s\n", what, std::strerror(errno));
}

/// Each of these may be refused (docs/real-time.md says what allows them); the loops run all the same.
void become_real_time(int priority) {
  cpu_set_t core;
  CPU_ZERO(&core);
  CPU_SET(static_cast<unsigned>(sched_getcpu()), &core);  // one of isolcpus, if there is one
  report("pinning", sched_setaffinity(0, sizeof core, &core));
  sched_param fifo{};
  fifo.sched_priority = priority;
  report("SCHED_FIFO", sched_setscheduler(0, SCHED_FIFO, &fifo));
}

timespec after(timespec time, long ns) {
  time.tv_nsec += ns;
  if (time.tv_nsec >= 1'000'000'000) {
    time.tv_nsec -= 1'000'000'000;
    ++time.tv_sec;
  }
  return time;
}

void sleep_until(const timespec& time) {
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
  }
}

}  // namespace

int main(int argc, char** argv) {
  // Whatever takes memory comes first: the file, build, the session, the log, the threads.
  const char* const path = argc > 1 ? argv[1] : TOUCHMARK_HAND_CSV;
  const std::vector<Vec3> hand = hand_positions(path);
  if (hand.empty()) {
    std::fprintf(stderr, "haptic_loop: no positions in %s\n", path);
    return 2;
  }
  const touchmark::TriangleMesh mesh = plate();
  const auto detector = touchmark::SphereCluster::build(mesh);
  touchmark::SphereCluster::Session session;
  touchmark::Proxy proxy(detector, coupling, &mesh);
  std::vector<double> forces(hand.size());
  double lowest = hand.front().z();
  report("mlockall", mlockall(MCL_CURRENT | MCL_FUTURE));

  // The rehearsal: a pass over places where the tip may be. It touches all code and data that the loops need.
  proxy.place(hand.front());
  for (const Vec3& position : hand) proxy.step(position, session);
  proxy.place(hand.front());

  Newest<touchmark::ForcePlanes> planes;  // from the proxy's thread to the device's
  Newest<std::array<double, 3>> tip;      // and where the device is, the other way
  tip.write({hand.front().x(), hand.front().y(), hand.front().z()});
  std::atomic<bool> is_over{false};
  timespec start{};
  clock_gettime(CLOCK_MONOTONIC, &start);

  std::thread proxy_loop([&] {
    become_real_time(49);
    for (timespec wake_up = start; !is_over.load(std::memory_order_relaxed);) {
      // An absolute time: what one tick takes too long does not move the next.
      wake_up = after(wake_up, proxy_period_ns);
      sleep_until(wake_up);
      // What the caches lost while this thread slept comes back here, and not between position and planes.
      detector.prepare(session);
      const touchmark::ProxyState& state = proxy.step(Vec3(tip.read().data()), session);
      planes.write(proxy.planes());
      lowest = std::min(lowest, state.position.z());
    }
  });
  std::thread device_loop([&] {
    become_real_time(50);
    Device device{hand.front()};
    timespec wake_up = start;
    for (std::size_t tick = 0; tick < hand.size(); ++tick) {
      wake_up = after(wake_up, device_period_ns);
      sleep_until(wake_up);
      const Vec3 force = planes.read().force(device.position);
      device.move(hand[tick], force);
      // The force has gone to the device. Only then what is not urgent.
      tip.write({device.position.x(), device.position.y(), device.position.z()});
      forces[tick] = force.norm();
    }
    is_over = true;
  });
  device_loop.join();
  proxy_loop.join();

  // Printing takes locks and memory, so it waits until the loops are over.
  const bool was_pushed = *std::max_element(forces.begin(), forces.end()) > 0.1;
  std::printf("%zu ticks of the device, which %s\n", hand.size(),
              was_pushed ? "the plate pushed back" : "met nothing");
  std::printf("the proxy was %s\n", lowest > coupling.radius ? "never nearer than its radius" : "too near");
}
