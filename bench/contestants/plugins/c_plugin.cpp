#include "bench/contestants/plugins/c_plugin.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

#include "bench/contestants/contestant_of.h"
#include "bench/contestants/entry.h"
#include "bench/contestants/roster.h"
#include "bench/support/system/denormals.h"
#include "bench/workload/answer.h"
#include "core/contestant.h"
#include "core/detector.h"
#include "core/mesh_update.h"

namespace touchmark::bench::contestants {
namespace {

/// Room for a text of the plug-in's, as one line whatever it wrote.
class ErrorText {
 public:
  char* data() noexcept { return text_.data(); }
  std::size_t size() const noexcept { return text_.size(); }
  std::string or_else(const char* otherwise) const {
    std::string text(text_.begin(), std::ranges::find(text_, '\0'));
    std::replace_if(
        text.begin(), text.end(), [](unsigned char letter) { return letter < ' '; }, ' ');
    return text.empty() ? otherwise : text;
  }

 private:
  std::array<char, 1024> text_{};
};

touchmark_plugin_mesh c_mesh(const TriangleMesh& mesh) noexcept {
  return {mesh.vertices().front().data(), mesh.vertices().size(), mesh.triangles().front().data(),
          mesh.size()};
}

Accuracy accuracy_of(const touchmark_plugin& plugin, const void* detector, Guarantee claimed) {
  touchmark_plugin_accuracy said{};
  if (plugin.accuracy != nullptr) plugin.accuracy(detector, &said);
  if (!(said.relative >= 0) || !(said.absolute >= 0))
    throw std::invalid_argument("the accuracy that it tells is below 0, or no number");
  Accuracy accuracy{claimed, said.relative, said.absolute, said.decides_exactly != 0,
                    said.names_exactly != 0};
  if (said.relative > 0 || said.absolute > 0) return accuracy;
  if (claimed == Guarantee::exact) {
    accuracy.relative = kernel_relative_error;
  } else {
    accuracy.absolute = std::numeric_limits<double>::infinity();
  }
  return accuracy;
}

/// A plug-in's functions as a detector. What they cost beside the plug-in's own time is the call through a
/// pointer, and the probe and the answer once more in memory.
class PluginDetector {
 public:
  struct Options {
    const touchmark_plugin* plugin = nullptr;
    Guarantee claimed = Guarantee::exact;
    std::vector<touchmark_plugin_setting> settings;  ///< their texts live as long as the call of build
  };

  /// Holds the plug-in's own session, which is gone with it.
  class Session {
   public:
    Session() = default;
    Session(const touchmark_plugin& plugin, std::shared_ptr<void> detector) : begun_(true) {
      if (plugin.create_session == nullptr) return;
      void* const made = plugin.create_session(detector.get());
      if (made == nullptr) throw std::runtime_error("create_session returns NULL");
      session_ = {made,
                  [&plugin, detector](void* session) { plugin.destroy_session(detector.get(), session); }};
    }

    void* get() const noexcept { return session_.get(); }
    bool is_begun() const noexcept { return begun_; }
    Work work;  ///< stays at zero

   private:
    std::shared_ptr<void> session_;
    bool begun_ = false;  ///< false for one that no detector has made yet: the first query makes it
  };

  /// Throws std::invalid_argument with the text of the plug-in's build.
  static PluginDetector build(const TriangleMesh& mesh, const Options& options) {
    const touchmark_plugin_mesh given = c_mesh(mesh);
    ErrorText error;
    void* const made = options.plugin->build(&given, options.settings.data(), options.settings.size(),
                                             error.data(), error.size());
    if (made == nullptr)
      throw std::invalid_argument(error.or_else("build returns NULL and does not say why"));
    return {*options.plugin, mesh, std::shared_ptr<void>(made, options.plugin->destroy), options.claimed};
  }

  Session session() const { return {*plugin_, detector_}; }
  bool answers(workload::Query query) const noexcept {
    switch (query) {
      case workload::Query::touches:
        return plugin_->touches != nullptr;
      case workload::Query::nearest:
        return plugin_->nearest != nullptr;
      case workload::Query::sweep:
        return plugin_->first_hit != nullptr;
      case workload::Query::moving:
        return false;
    }
    return false;
  }

  bool updates() const noexcept { return plugin_->update != nullptr; }

  bool touches(const Probe& probe, Session& session) const noexcept {
    return plugin_->touches(detector_.get(), begun(session), &c_probe(probe)) != 0;
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    touchmark_plugin_contact contact{};
    if (plugin_->nearest(detector_.get(), begun(session), &c_probe(probe), reach, &contact) == 0)
      return std::nullopt;
    return contact_of(contact);
  }
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept {
    const touchmark_plugin_sweep asked{{sweep.from.x(), sweep.from.y(), sweep.from.z()},
                                       {sweep.to.x(), sweep.to.y(), sweep.to.z()},
                                       sweep.radius};
    touchmark_plugin_impact impact{};
    if (plugin_->first_hit(detector_.get(), begun(session), &asked, &impact) == 0) return std::nullopt;
    return Impact{impact.fraction, contact_of(impact.contact)};
  }

  std::size_t bytes() const noexcept { return plugin_->bytes(detector_.get()); }
  Accuracy accuracy() const noexcept { return accuracy_; }
  /// Throws std::invalid_argument with the text of the plug-in's update, and for a mesh of other triangles.
  void update(const TriangleMesh& mesh) {
    connectivity_.expect(mesh);
    const touchmark_plugin_mesh given = c_mesh(mesh);
    ErrorText error;
    if (plugin_->update(detector_.get(), &given, error.data(), error.size()) != 0)
      throw std::invalid_argument(error.or_else("update fails and does not say why"));
  }

 private:
  PluginDetector(const touchmark_plugin& plugin, const TriangleMesh& mesh, std::shared_ptr<void> detector,
                 Guarantee claimed)
      : plugin_(&plugin),
        detector_(std::move(detector)),
        ids_(mesh.ids().begin(), mesh.ids().end()),
        accuracy_(accuracy_of(plugin, detector_.get(), claimed)),
        connectivity_(mesh) {}

  void* begun(Session& session) const noexcept {
    if (!session.is_begun()) session = this->session();
    return session.get();
  }
  /// Returns the probe where it lies, which has the layout of C: a copy made of single stores would keep a
  /// vector load waiting.
  static const touchmark_plugin_probe& c_probe(const Probe& probe) noexcept {
    static_assert(sizeof(Probe) == sizeof(touchmark_plugin_probe) &&
                  offsetof(Probe, radius) == offsetof(touchmark_plugin_probe, radius));
    return reinterpret_cast<const touchmark_plugin_probe&>(probe);
  }
  Contact contact_of(const touchmark_plugin_contact& contact) const noexcept {
    return {{contact.point[0], contact.point[1], contact.point[2]},
            {contact.normal[0], contact.normal[1], contact.normal[2]},
            contact.distance,
            id_of(contact.triangle),
            Side::unasked};
  }
  /// The index itself for one that is out of range, which the judge then finds to be no triangle's.
  TriangleId id_of(std::uint32_t triangle) const noexcept {
    return triangle < ids_.size() ? ids_[triangle] : triangle;
  }

  const touchmark_plugin* plugin_;
  std::shared_ptr<void> detector_;
  std::vector<TriangleId> ids_;  ///< by the mesh's order; empty where they are the same
  Accuracy accuracy_;
  Connectivity connectivity_;
};

constexpr const char* entry_symbol = "touchmark_plugin_entry";
constexpr std::uint32_t max_options = 100;

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument(why); }

std::string loader_error() {
  const char* const error = dlerror();
  return error != nullptr ? error : "the loader does not say why";
}

/// The shared object stays in the process until it ends.
const touchmark_plugin& described_by(const std::string& path) {
  void* const object = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (object == nullptr) refuse(loader_error());
  // What is compiled with -ffast-math does that to whoever loads it.
  if (support::restore_denormals())
    remark("loading it switched denormal numbers off; they were switched on again");
  dlerror();
  void* const symbol = dlsym(object, entry_symbol);
  if (symbol == nullptr)
    refuse(fmt::format("it exports no {}, which touchmark/contestant.h asks for", entry_symbol));
  const auto entry = reinterpret_cast<touchmark_plugin_entry_function>(symbol);
  const touchmark_plugin* const plugin = entry();
  if (plugin == nullptr) refuse(fmt::format("{} returns NULL", entry_symbol));
  if (plugin->version < 1 || plugin->version > TOUCHMARK_PLUGIN_VERSION)
    refuse(fmt::format("it is of version {} of touchmark/contestant.h; this program knows version {}",
                       plugin->version, TOUCHMARK_PLUGIN_VERSION));
  return *plugin;
}

std::string text_or_nothing(const char* text) { return text != nullptr ? text : ""; }

/// A name or a key, which must not hold what parts them on the command line.
std::string checked_word(const char* text, const char* what) {
  constexpr const char* allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (text == nullptr) refuse(fmt::format("{} is NULL", what));
  const std::string word = text;
  if (word.empty() || word.find_first_not_of(allowed) != std::string::npos)
    refuse(fmt::format("{} \"{}\" is not made of letters, digits, '_' and '-'", what, word));
  return word;
}

void expect_functions(const touchmark_plugin& plugin) {
  if (plugin.build == nullptr) refuse("build is NULL");
  if (plugin.destroy == nullptr) refuse("destroy is NULL");
  if (plugin.bytes == nullptr) refuse("bytes is NULL");
  if (plugin.guarantee == nullptr) refuse("guarantee is NULL");
  if (plugin.touches == nullptr && plugin.nearest == nullptr && plugin.first_hit == nullptr)
    refuse("touches, nearest and first_hit are all NULL: it answers nothing");
  if ((plugin.create_session == nullptr) != (plugin.destroy_session == nullptr))
    refuse("of create_session and destroy_session one is NULL and the other is not");
}

OptionInfo option_of(const touchmark_plugin_option& option) {
  constexpr std::array kinds{OptionKind::choice, OptionKind::number, OptionKind::count, OptionKind::length};
  OptionInfo info;
  info.key = checked_word(option.key, "an option's key");
  if (info.key == side_key || info.key == updated_key)
    refuse(fmt::format("the option {} is one that the program gives a meaning of its own", info.key));
  if (option.kind < 0 || static_cast<std::size_t>(option.kind) >= kinds.size())
    refuse(fmt::format("the option {} is of kind {}, which is none", info.key, option.kind));
  info.kind = kinds[static_cast<std::size_t>(option.kind)];
  if (info.kind == OptionKind::choice) {
    std::string rest = text_or_nothing(option.choices);
    for (std::size_t end = 0; end != std::string::npos; rest.erase(0, end + 1)) {
      end = rest.find('|');
      info.choices.push_back(checked_word(rest.substr(0, end).c_str(), "an option's choice"));
      if (end == std::string::npos) break;
    }
  }
  info.default_value = text_or_nothing(option.default_value);
  info.summary = text_or_nothing(option.summary);
  return info;
}

std::vector<OptionInfo> options_of(const touchmark_plugin& plugin) {
  std::vector<OptionInfo> options;
  if (plugin.option_count == 0) return options;
  if (plugin.options == nullptr || plugin.option_count > max_options)
    refuse(fmt::format("it says that it has {} options, at {}", plugin.option_count,
                       plugin.options != nullptr ? "one place" : "NULL"));
  for (std::uint32_t i = 0; i < plugin.option_count; ++i) options.push_back(option_of(plugin.options[i]));
  return options;
}

std::vector<workload::Query> queries_answered(const touchmark_plugin& plugin) {
  std::vector<workload::Query> queries;
  if (plugin.touches != nullptr) queries.push_back(workload::Query::touches);
  if (plugin.nearest != nullptr) queries.push_back(workload::Query::nearest);
  if (plugin.first_hit != nullptr) queries.push_back(workload::Query::sweep);
  return queries;
}

double number_of(const OptionInfo& option, const OptionValues& values, const TriangleMesh& mesh) {
  switch (option.kind) {
    case OptionKind::choice:
      break;
    case OptionKind::number:
      return values.number(option.key);
    case OptionKind::count:
      return static_cast<double>(values.count(option.key));
    case OptionKind::length:
      return values.length(option.key, mesh);
  }
  const auto chosen = std::ranges::find(option.choices, values.text(option.key));
  return static_cast<double>(chosen - option.choices.begin());
}

PluginDetector::Options detector_options(const touchmark_plugin& plugin, const std::vector<OptionInfo>& own,
                                         const TriangleMesh& mesh, const OptionValues& values) {
  PluginDetector::Options options;
  options.plugin = &plugin;
  options.claimed = *claimed_guarantee(plugin.guarantee, values);
  for (const OptionInfo& option : own)
    options.settings.push_back(
        {option.key.c_str(), values.text(option.key).c_str(), number_of(option, values, mesh)});
  return options;
}

/// Has the roster read it as it would read what a user types: defaults, and the guarantee of these.
void expect_readable(const ContestantInfo& info) {
  std::string text = info.name;
  for (const OptionInfo& option : info.options)
    text += fmt::format("{}{}={}", text == info.name ? ":" : ",", option.key, option.default_value);
  if (!Roster({info}).parse(text).claimed) refuse("guarantee is empty");
}

}  // namespace

ContestantInfo load_c_plugin(const std::string& path) { return contestant_of(described_by(path), path); }

ContestantInfo contestant_of(const touchmark_plugin& plugin, const std::string& path) {
  expect_functions(plugin);
  ContestantInfo info;
  info.name = checked_word(plugin.name, "its name");
  info.summary = text_or_nothing(plugin.summary);
  info.accuracy = plugin.guarantee;
  info.queries = queries_answered(plugin);
  info.options = options_of(plugin);
  info.plugin = path;
  info.build = [&plugin, own = info.options](const TriangleMesh& mesh, const OptionValues& values) {
    return std::make_unique<ContestantOf<PluginDetector>>(
        built<PluginDetector>(mesh, detector_options(plugin, own, mesh, values), values));
  };
  if (plugin.update != nullptr && plugin.nearest != nullptr) info.options.push_back(updated_option());
  expect_readable(info);
  return info;
}

}  // namespace touchmark::bench::contestants
