/// A haptic thread at 1 kHz, as docs/real-time.md describes it. A proxy follows a simulated device over a
/// plate, and nothing that could make a tick late happens inside the loop. The device is a mass that a hand
/// holds by a spring; where the hand wants it is in a CSV file: time_s,x,y,z in seconds and metres.
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <sched.h>
#include <sys/mman.h>
#include <time.h>
#include <touchmark/proxy.h>
#include <touchmark/sphere_cluster.h>

namespace {

using touchmark::Vec3;

constexpr long period_ns = 1'000'000;
constexpr double period_s = 1e-9 * period_ns;
constexpr touchmark::Coupling coupling{.radius = 0.005, .stiffness = 1000, .damping = 1, .tick_s = period_s};

/// A square plate in the plane z = 0, in metres.
touchmark::TriangleMesh plate() {
  return touchmark::TriangleMesh({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}},
                                 {{0, 1, 2}, {0, 2, 3}});
}

/// Tells where the hand wants the tip at each tick, straight from one row of the file to the next.
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
    for (double tick = first; tick * period_s <= time + period_s / 2; ++tick)
      positions.push_back(last + (tick * period_s - last_time) / (time - last_time) * (to - last));
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
    velocity += period_s / mass * (grip * (hand - position) - hand_damping * velocity + force);
    position += period_s * velocity;
  }
};

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

void sleep_until(const timespec& time) {
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
  }
}

}  // namespace

int main(int argc, char** argv) {
  // Whatever takes memory comes first: the file, build, the session, the log.
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
  become_real_time();

  // The rehearsal: a pass over places where the tip may be. It touches all code and data that the loop needs.
  proxy.place(hand.front());
  for (const Vec3& position : hand) proxy.step(position, session);

  Device device{hand.front()};
  proxy.place(device.position);
  double lowest = device.position.z();
  timespec wake_up{};
  clock_gettime(CLOCK_MONOTONIC, &wake_up);
  for (std::size_t tick = 0; tick < hand.size(); ++tick) {
    // An absolute time: what one tick takes too long does not move the next.
    wake_up = after(wake_up, period_ns);
    sleep_until(wake_up);
    // What the caches lost while this thread slept comes back here, and not between position and force.
    detector.prepare(session);
    const touchmark::ProxyState& state = proxy.step(device.position, session);
    device.move(hand[tick], state.force);
    // The force has gone to the device. Only then what is not urgent.
    forces[tick] = state.force.norm();
    lowest = state.position.z() < lowest ? state.position.z() : lowest;
  }

  // Printing takes locks and memory, so it waits until the loop is over.
  int contacts = 0;
  double largest = 0;
  for (const double force : forces) {
    contacts += force > 0 ? 1 : 0;
    largest = force > largest ? force : largest;
  }
  std::printf("%zu ticks, %d in contact, at most %.2f N\n", hand.size(), contacts, largest);
  std::printf("the proxy was %s\n", lowest > coupling.radius ? "never nearer than its radius" : "too near");
}
