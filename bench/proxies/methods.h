/// The contestants of the proxy suite by name: "NAME[:key=value,...]". A new one is a function and its line
/// in methods.cpp.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/proxies/proxy_method.h"
#include "bench/proxies/sweeper.h"

namespace touchmark::bench::proxies {

class MethodOptions {
 public:
  explicit MethodOptions(std::map<std::string, std::string> values) : values_(std::move(values)) {}

  const std::string& text(const std::string& key) const { return values_.at(key); }
  double number(const std::string& key) const;  ///< 0 or more; checked when the method was chosen

 private:
  std::map<std::string, std::string> values_;
};

/// All that a method is made of. The references outlive the call only.
struct MethodRequest {
  const contestants::Roster& roster;
  const TriangleMesh& mesh;
  const Coupling& coupling;
  const MethodOptions& options;
  const std::string& detector;  ///< one of ours, asked by those that claim never to cross
  /// Meshes of the bodies that `mesh` consists of, where it does, and where they are.
  std::span<const TriangleMesh> bodies = {};
  std::span<const Vec3> places = {};
};

using MakeMethod = std::unique_ptr<ProxyMethod> (*)(const MethodRequest& request);

/// Coupling::max_work where nothing else is asked for: it ends few ticks of a hand.
inline constexpr std::uint64_t usual_max_work = 6000;

struct MethodOption {
  std::string_view key, default_value, meaning;
  bool is_number = false;
  std::string_view word = {};  ///< what stands for no number
};

struct MethodInfo {
  std::string_view name, meaning;
  std::vector<MethodOption> options;
  /// Which contestant it rests on; empty: none. Without that one built in, the method is left out.
  std::string_view rests_on;
  bool points_only = false;  ///< runs with radius 0 whatever the course
  bool claims = false;       ///< says that it never crosses: its crossings are failures of the run
  MakeMethod make = nullptr;
};

std::span<const MethodInfo> methods();

/// A method as chosen.
struct MethodSpec {
  const MethodInfo* info = nullptr;
  std::string options;  ///< as typed
  MethodOptions values{{}};

  std::string text() const {
    return options.empty() ? std::string(info->name) : std::string(info->name) + ":" + options;
  }
};

/// Throws std::invalid_argument naming the name, key or value that is wrong.
MethodSpec method_named(const std::string& text);
/// Those whose contestants are built in.
std::vector<MethodSpec> all_methods(const contestants::Roster& roster);

/// The plain sweeper, or the contestant that the option `queries` names. `smallest` is the plain one's.
std::unique_ptr<Sweeper> sweeper_for(const MethodRequest& request, double smallest = 0);

std::unique_ptr<ProxyMethod> penalty_method(const MethodRequest& request);
std::unique_ptr<ProxyMethod> god_object_method(const MethodRequest& request);
std::unique_ptr<ProxyMethod> virtual_proxy_method(const MethodRequest& request);
std::unique_ptr<ProxyMethod> finger_proxy_method(const MethodRequest& request);
std::unique_ptr<ProxyMethod> certified_method(const MethodRequest& request);
/// As certified_method, over a scene of the bodies; null for a detector that is not named plainly, or takes
/// no scenes.
std::unique_ptr<ProxyMethod> certified_over_bodies(const MethodRequest& request);
std::unique_ptr<ProxyMethod> engine_sweep_method(const MethodRequest& request);

}  // namespace touchmark::bench::proxies
