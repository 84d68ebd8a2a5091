/// A method's way as a table that others can check: one row a straight piece.
#pragma once

#include <cstdint>
#include <string>

#include "bench/proxies/course.h"
#include "bench/proxies/proxy_method.h"

namespace touchmark::bench::experiments::proxy {

using proxies::Step;

/// Columns step, segment, goal_x, goal_y, goal_z, proxy_x, proxy_y, proxy_z, contacts, force_x, force_y,
/// force_z, ns. Steps count from 0, and each has a row, also where the proxy rests; `proxy` is where the
/// piece ends. The last piece of a step has contacts, force and time; where it is free, contacts is 0 and the
/// force empty. Doubles are the shortest that read back as they were.
class ProxyTrace {
 public:
  ProxyTrace();
  void add(std::size_t tick, const Vec3& goal, const Step& step, std::int64_t ns);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace touchmark::bench::experiments::proxy
