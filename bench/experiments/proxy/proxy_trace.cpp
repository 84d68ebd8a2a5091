#include "bench/experiments/proxy/proxy_trace.h"

#include <algorithm>

#include <fmt/format.h>

namespace touchmark::bench::experiments::proxy {

ProxyTrace::ProxyTrace()
    : text_(
          "step,segment,goal_x,goal_y,goal_z,proxy_x,proxy_y,proxy_z,contacts,force_x,force_y,force_z,ns\n") {
}

void ProxyTrace::add(std::size_t tick, const Vec3& goal, const Step& step, std::int64_t ns) {
  const std::size_t pieces = std::max<std::size_t>(step.way.size() - 1, 1);
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const Vec3& at = step.way[std::min(piece + 1, step.way.size() - 1)];
    text_ += fmt::format("{},{},{},{},{},{},{},{},", tick, piece, goal.x(), goal.y(), goal.z(), at.x(),
                         at.y(), at.z());
    if (piece + 1 < pieces)
      text_ += ",,,,\n";
    else if (step.contacts == 0)
      text_ += fmt::format("0,,,,{}\n", ns);
    else
      text_ +=
          fmt::format("{},{},{},{},{}\n", step.contacts, step.force.x(), step.force.y(), step.force.z(), ns);
  }
}

}  // namespace touchmark::bench::experiments::proxy
