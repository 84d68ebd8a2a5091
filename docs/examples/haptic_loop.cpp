/// A haptic thread at 1 kHz, as docs/real-time.md describes it: a ball is lowered onto a plate, and nothing
/// that could make a tick late happens inside the loop.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <vector>

#include <sched.h>
#include <sys/mman.h>
#include <time.h>
#include <touchmark/sphere_cluster.h>

namespace {

constexpr long period_ns = 1'000'000;
constexpr double radius = 0.005;    // metres
constexpr double stiffness = 1000;  // newtons a metre
constexpr int ticks = 100;

/// A square plate in the plane z = 0, in metres.
touchmark::TriangleMesh plate() {
  return touchmark::TriangleMesh({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}},
                                 {{0, 1, 2}, {0, 2, 3}});
}

/// Stands for the device: where its tip is at this tick.
touchmark::Vec3 device_position(int tick) { return {0.04, 0.03, 0.00581 - 2e-5 * tick}; }

void report(const char* what, int result) {
  if (result != 0) std::fprintf(stderr, "%s: %s\n", what, std::strerror(errno));
}

/// Each of these may be refused (docs/real-time.md says what allows them); the loop runs all the same.
void become_real_time() {
  cpu_set_t core;
  CPU_ZERO(&core);
  CPU_SET(static_cast<unsigned>(sched_getcpu()), &core);  // one of isolcpus, if there is one
  report("pinning", sched_setaffinity(0, sizeof core, &core));
  sched_param priority{};
  priority.sched_priority = 50;
  report("SCHED_FIFO", sched_setscheduler(0, SCHED_FIFO, &priority));
  report("mlockall", mlockall(MCL_CURRENT | MCL_FUTURE));
}

timespec after(timespec time, long ns) {
  time.tv_nsec += ns;
  if (time.tv_nsec >= 1'000'000'000) {
    time.tv_nsec -= 1'000'000'000;
    ++time.tv_sec;
  }
  return time;
}

}  // namespace

int main() {
  // Whatever takes memory comes first: build, the session, the log.
  const auto detector = touchmark::SphereCluster::build(plate());
  touchmark::SphereCluster::Session session;
  std::vector<double> forces(ticks);
  become_real_time();

  // The rehearsal: a pass over places where the tip may be. It touches all code and data that the loop needs.
  for (int tick = 0; tick < ticks; ++tick) {
    detector.nearest({device_position(tick), radius}, radius, session);
    detector.prepare(session);
  }

  timespec wake_up{};
  clock_gettime(CLOCK_MONOTONIC, &wake_up);
  for (int tick = 0; tick < ticks; ++tick) {
    // An absolute time: what one tick takes too long does not move the next.
    wake_up = after(wake_up, period_ns);
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake_up, nullptr) == EINTR) {
    }
    // What the caches lost while this thread slept comes back here, and not between position and force.
    detector.prepare(session);
    const touchmark::Probe probe{device_position(tick), radius};
    const std::optional<touchmark::Contact> contact = detector.nearest(probe, radius, session);
    forces[static_cast<std::size_t>(tick)] = contact ? stiffness * (radius - contact->distance) : 0;
    // The force goes to the device here. Only then what is not urgent.
  }

  // Printing takes locks and memory, so it waits until the loop is over.
  int contacts = 0;
  double largest = 0;
  for (const double force : forces) {
    contacts += force > 0 ? 1 : 0;
    largest = force > largest ? force : largest;
  }
  std::printf("%d ticks, %d in contact, at most %.2f N\n", ticks, contacts, largest);
}
