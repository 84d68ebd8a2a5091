#include "bench/proxies/methods.h"

#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "bench/support/did_you_mean.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::proxies {
namespace {

constexpr std::string_view own_queries = "plain";

const MethodOption queries{"queries", own_queries, "plain, or a contestant that answers sweeps"};

const std::vector<MethodInfo>& list() {
  static const std::vector<MethodInfo> all{
      {"penalty", "no proxy: a spring from the deepest contact", {}, "", false, false, &penalty_method},
      {"god-object",
       "Zilles and Salisbury 1995: a point on active faces",
       {},
       "",
       true,
       false,
       &god_object_method},
      {"virtual-proxy",
       "Ruspini 1997: a ball and planes of configuration space",
       {queries},
       "",
       false,
       false,
       &virtual_proxy_method},
      {"finger-proxy",
       "one constraint a tick, epsilon off the surface, as CHAI3D's manual describes",
       {queries,
        {"epsilon", "1e-4", "kept off the surface, m", true},
        {"smallest", "1e-13", "m^4; a bare point passes triangles whose doubled area squared is less", true}},
       "",
       false,
       false,
       &finger_proxy_method},
      {"bullet-sweep",
       "Bullet's convexSweepTest, sliding as programs do",
       {{"queries", "bullet", "the contestant that sweeps"},
        {"skin", "1e-4", "kept off the surface, m", true}},
       "bullet",
       false,
       false,
       &engine_sweep_method},
      {"fcl-ccd",
       "FCL's continuous collision, sliding as programs do",
       {{"queries", "fcl:ccd=10", "the contestant that sweeps"},
        {"skin", "1e-4", "kept off the surface, m", true}},
       "fcl",
       false,
       false,
       &engine_sweep_method},
      {"certified",
       "ours: no piece of the way is gone before its sweep is exactly free",
       {{"max_work", "0", "bounds what a tick looks at; random: another bound each tick; 0: none does", true,
         "random"}},
       "",
       false,
       true,
       &certified_method},
  };
  return all;
}

}  // namespace

double MethodOptions::number(const std::string& key) const { return *support::parse_number(text(key)); }

std::span<const MethodInfo> methods() { return list(); }

MethodSpec method_named(const std::string& text) {
  const std::string name = text.substr(0, text.find(':'));
  MethodSpec spec;
  spec.info = &support::item_named(name, list(), "method");
  std::map<std::string, std::string> values;
  for (const MethodOption& option : spec.info->options) values.emplace(option.key, option.default_value);
  if (name.size() < text.size()) spec.options = text.substr(name.size() + 1);
  std::istringstream parts(spec.options);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t equals = part.find('=');
    const std::string key = part.substr(0, equals);
    const auto value = values.find(key);
    if (equals == std::string::npos || value == values.end())
      throw std::invalid_argument(fmt::format("method {}: \"{}\" is not one of its options", name, part));
    value->second = part.substr(equals + 1);
  }
  for (const MethodOption& option : spec.info->options) {
    const std::string& value = values.at(std::string(option.key));
    if (option.is_number && value != option.word && !(support::parse_number(value).value_or(-1) >= 0))
      throw std::invalid_argument(
          fmt::format("method {}: {}=\"{}\" is not a number of 0 or more{}", name, option.key, value,
                      option.word.empty() ? "" : fmt::format(", or {}", option.word)));
  }
  spec.values = MethodOptions(std::move(values));
  return spec;
}

std::vector<MethodSpec> all_methods(const contestants::Roster& roster) {
  std::vector<MethodSpec> all;
  for (const MethodInfo& info : list()) {
    if (info.rests_on.empty() || roster.find(std::string(info.rests_on)).built())
      all.push_back(method_named(std::string(info.name)));
  }
  return all;
}

std::unique_ptr<Sweeper> sweeper_for(const MethodRequest& request, double smallest) {
  const std::string& name = request.options.text("queries");
  return name == own_queries ? plain_sweeper(request.mesh, smallest)
                             : sweeper_of(request.roster, name, request.mesh);
}

}  // namespace touchmark::bench::proxies
