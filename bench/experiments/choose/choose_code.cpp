#include "bench/experiments/choose/choose_code.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/contestants/entry.h"
#include "bench/proxies/methods.h"
#include "bench/support/length.h"

namespace touchmark::bench::experiments::choose {
namespace {

/// A double as C++ reads it.
std::string literal(double value) {
  return std::isinf(value) ? "std::numeric_limits<double>::infinity()" : fmt::format("{}", value);
}

std::string value_in_code(const contestants::OptionInfo& option, const std::string& value) {
  if (option.kind == contestants::OptionKind::choice) {
    std::string name = value;  // of an enumerator, or true or false
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  }
  if (option.kind != contestants::OptionKind::length) return value;
  const support::Length length = support::parse_length(value).value_or(support::Length{});
  return length.percent ? fmt::format("{} / 100 * mesh.diagonal()", length.value) : literal(length.value);
}

/// A statement for each option of the class that is not its default.
std::string statements(const contestants::ContestantInfo& info, const contestants::OptionValues& values) {
  const contestants::LibraryClass library = info.library(values);
  std::string text;
  for (const contestants::OptionInfo& option : info.options) {
    const std::string& value = values.text(option.key);
    if (option.code.empty() || !library.has(option.key) || value == option.default_value) continue;
    std::string code = fmt::format(fmt::runtime(option.code), value_in_code(option, value));
    const std::size_t type = code.find("= ") + 2;
    if (code.find("::") != std::string::npos) code.insert(type, "touchmark::");
    text += fmt::format("    options.{};\n", code);
  }
  return text;
}

struct Question {
  std::string answer, parameters, call;
};

/// What a class with a proxy has besides; of one without all are empty.
struct ProxyParts {
  std::string header, place, member, after_move;
};

ProxyParts proxy_parts(const workload::Workload& workload, const std::string& type,
                       const std::string& member) {
  return {
      "proxy",
      "  // The proxy belongs to this object.\n"
      "  HapticContacts(const HapticContacts&) = delete;\n"
      "  HapticContacts& operator=(const HapticContacts&) = delete;\n\n"
      "  // Where the device is when the loop begins, off the surface.\n"
      "  void place(const touchmark::Vec3& hand) noexcept { proxy_.place(hand); }\n\n",
      fmt::format("  // Set .stiffness to what the device holds, in N a mesh unit. max_work bounds a step.\n"
                  "  touchmark::Proxy<{}> proxy_{{{}, {{.radius = {}, .max_work = {}}}}};\n",
                  type, member, literal(workload.radius), proxies::usual_max_work),
      " proxy_.surface_moved();"};
}

const Question steps_proxy{"const touchmark::ProxyState&", "const touchmark::Vec3& hand",
                           "proxy_.step(hand, session_)"};

Question question_of(const workload::Workload& workload, workload::Query query, const std::string& asked) {
  const std::string radius = literal(workload.radius);
  const std::string reach = literal(workload.reach.value_or(workload.radius));
  switch (query) {
    case workload::Query::touches:
      return {"bool", "const touchmark::Vec3& center",
              fmt::format("{}.touches({{center, {}}}, session_)", asked, radius)};
    case workload::Query::nearest:
      return {"std::optional<touchmark::Contact>", "const touchmark::Vec3& center",
              fmt::format("{}.nearest({{center, {}}}, {}, session_)", asked, radius, reach)};
    case workload::Query::sweep:
    case workload::Query::moving:
      break;
  }
  return {"std::optional<touchmark::Impact>", "const touchmark::Vec3& from, const touchmark::Vec3& to",
          fmt::format("{}.first_hit({{from, to, {}}}, session_)", asked, radius)};
}

/// Asks over bodies, and says whose the contact is.
Question question_about_bodies(const workload::Workload& workload, workload::Query query) {
  Question question = question_of(workload, query, "scene_");
  for (const auto& [word, with_body] :
       {std::pair{"nearest(", "nearest_body("}, std::pair{"first_hit(", "first_hit_body("},
        std::pair{"::Contact>", "::BodyContact>"}, std::pair{"::Impact>", "::BodyImpact>"}}) {
    for (std::string* const text : {&question.answer, &question.call}) {
      const std::size_t at = text->find(word);
      if (at != std::string::npos) text->replace(at, std::string_view(word).size(), with_body);
    }
  }
  return question;
}

/// Says of what is no class of the library where its calls are.
std::string no_class(const contestants::ContestantInfo& info, const std::string& contestant) {
  return info.scenes_only
             ? fmt::format(
                   "// {} is no class of the library ({}); bench/contestants/plain_scenes.h holds the calls "
                   "that were measured.\n",
                   contestant, info.summary)
             : fmt::format(
                   "// {} is another library ({}); baselines/{} holds the calls that were measured.\n",
                   contestant, info.summary, info.name);
}

std::string options_function(const std::string& type, const contestants::ContestantInfo& info,
                             const contestants::OptionValues& values) {
  return fmt::format(
      "  static {0}::Options options_for([[maybe_unused]] const touchmark::TriangleMesh& mesh) {{\n"
      "    {0}::Options options;\n{1}    return options;\n  }}\n",
      type, statements(info, values));
}

std::string scene_code_for(const contestants::ContestantInfo& info, const contestants::ContestantSpec& spec,
                           const workload::Workload& workload, const Use& use) {
  const contestants::LibraryClass library = info.library(spec.values);
  const std::string type = "touchmark::" + library.name;
  const Question question = use.proxy ? steps_proxy : question_about_bodies(workload, use.query);
  const ProxyParts proxy = use.proxy ? proxy_parts(workload, "Scene", "scene_") : ProxyParts{};
  std::vector<std::string> headers{library.header, "pose", "probe", "scene", "triangle_mesh"};
  if (use.proxy) headers.push_back(proxy.header);
  std::ranges::sort(headers);
  std::string text = fmt::format(
      "// {}, as touchmark choose recommends it for these bodies. Lengths are in the scene's units.\n",
      spec.text());
  text += "#include <limits>\n#include <optional>\n#include <utility>\n\n";
  for (const std::string& header : headers) text += fmt::format("#include <touchmark/{}.h>\n", header);
  text += fmt::format(
      "\nclass HapticContacts {{\n public:\n"
      "  using Scene = touchmark::Scene<{0}>;\n\n{5}  // Any number of bodies may have the shape.\n"
      "  touchmark::ShapeId add_shape(touchmark::TriangleMesh mesh) {{\n"
      "    const {0}::Options options = options_for(mesh);\n"
      "    return scene_.add_shape(touchmark::Shape<{0}>::build(std::move(mesh), options));\n  }}\n"
      "  // touchmark::pose_of(position, w, x, y, z) makes the pose.\n"
      "  touchmark::BodyId add(touchmark::ShapeId shape, const touchmark::Pose& pose) {{ return "
      "scene_.add(shape, pose); }}\n"
      "  // Between two calls of ask; touchmark/shared_scene.h is for another thread.\n"
      "  void move(touchmark::BodyId body, const touchmark::Pose& pose) {{ scene_.move(body, pose);{6} }}\n\n"
      "  // Once a tick, by the thread of one haptic point.\n"
      "  {1} ask({2}) noexcept {{\n    return {3};\n  }}\n\n private:\n{4}\n"
      "  Scene scene_;\n  Scene::Session session_;\n{7}}};\n",
      type, question.answer, question.parameters, question.call, options_function(type, info, spec.values),
      proxy.place, proxy.after_move, proxy.member);
  return text;
}

bool is_on(const contestants::OptionValues& values, const std::string& key) {
  const auto found = values.all().find(key);
  return found != values.all().end() && found->second == "true";
}

}  // namespace

std::string code_for(const contestants::Roster& roster, const contestants::ContestantSpec& spec,
                     const workload::Workload& workload, const Use& use) {
  const contestants::ContestantInfo& info = roster.find(spec.name);
  if (!info.library) return no_class(info, spec.text());
  if (workload.scene) return scene_code_for(info, spec, workload, use);
  const bool sides = contestants::asks_for_side(spec.values);
  const contestants::LibraryClass library = info.library(spec.values);
  const std::string type = "touchmark::" + library.name;
  const std::string detector = sides ? fmt::format("touchmark::Signed<{}>", type) : type;
  const Question question = use.proxy ? steps_proxy : question_of(workload, use.query, "detector_");
  const ProxyParts proxy = use.proxy ? proxy_parts(workload, detector, "detector_") : ProxyParts{};
  std::vector<std::string> headers{library.header, "probe", "triangle_mesh"};
  if (use.proxy) headers.push_back(proxy.header);
  if (sides) headers.emplace_back("signed_detector");
  std::ranges::sort(headers);
  std::string text =
      fmt::format("// {}, as touchmark choose recommends it. Lengths are in mesh units.\n", spec.text());
  text += "#include <limits>\n#include <optional>\n\n";
  for (const std::string& header : headers) text += fmt::format("#include <touchmark/{}.h>\n", header);
  text += fmt::format(
      "\nclass HapticContacts {{\n public:\n"
      "  explicit HapticContacts(const touchmark::TriangleMesh& mesh)\n"
      "      : detector_({}::build(mesh, options_for(mesh))) {{}}\n\n{}  // Once a tick, by the thread of "
      "one haptic point.\n"
      "  {} ask({}) noexcept {{\n    return {};\n  }}\n",
      detector, proxy.place, question.answer, question.parameters, question.call);
  if (is_on(spec.values, "prepare") && library.has("prepare"))
    text +=
        "\n  // Right after waking, before the device is read: what the caches lost comes back here.\n"
        "  void prepare() noexcept { detector_.prepare(session_); }\n";
  text += fmt::format("\n private:\n{0}\n  {1} detector_;\n  {1}::Session session_;\n{2}}};\n",
                      options_function(type, info, spec.values), detector, proxy.member);
  return text;
}

}  // namespace touchmark::bench::experiments::choose
