#include "bench/contestants/plugins/plugin_detector.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>

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

}  // namespace

PluginDetector::Session::Session(const touchmark_plugin& plugin, std::shared_ptr<void> detector)
    : begun_(true) {
  if (plugin.create_session == nullptr) return;
  void* const made = plugin.create_session(detector.get());
  if (made == nullptr) throw std::runtime_error("create_session returns NULL");
  session_ = {made, [&plugin, detector](void* session) { plugin.destroy_session(detector.get(), session); }};
}

PluginDetector::PluginDetector(const touchmark_plugin& plugin, const TriangleMesh& mesh,
                               std::shared_ptr<void> detector, Guarantee claimed)
    : plugin_(&plugin),
      detector_(std::move(detector)),
      ids_(mesh.ids().begin(), mesh.ids().end()),
      accuracy_(accuracy_of(plugin, detector_.get(), claimed)),
      connectivity_(mesh) {}

PluginDetector PluginDetector::build(const TriangleMesh& mesh, const Options& options) {
  const touchmark_plugin_mesh given = c_mesh(mesh);
  ErrorText error;
  void* const made = options.plugin->build(&given, options.settings.data(), options.settings.size(),
                                           error.data(), error.size());
  if (made == nullptr) throw std::invalid_argument(error.or_else("build returns NULL and does not say why"));
  return {*options.plugin, mesh, std::shared_ptr<void>(made, options.plugin->destroy), options.claimed};
}

bool PluginDetector::answers(workload::Query query) const noexcept {
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

void PluginDetector::update(const TriangleMesh& mesh) {
  connectivity_.expect(mesh);
  const touchmark_plugin_mesh given = c_mesh(mesh);
  ErrorText error;
  if (plugin_->update(detector_.get(), &given, error.data(), error.size()) != 0)
    throw std::invalid_argument(error.or_else("update fails and does not say why"));
}

}  // namespace touchmark::bench::contestants
