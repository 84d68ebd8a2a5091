#include "bench/contestants/entry.h"

#include <optional>
#include <stdexcept>

#include "baselines/bullet/bullet_detector.h"
#include "baselines/bullet/bullet_scene.h"
#include "baselines/bullet/view.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/rival_options.h"
#include "bench/contestants/rival_scene.h"

namespace touchmark::bench::contestants {

ContestantInfo bullet_entry() {
  ContestantInfo info = introduced("bullet", 60, "Bullet Physics: a hierarchy of quantised boxes",
                                   "approximate; method=callback: exact");
  using baselines::BulletDetector;
  using Precision = BulletDetector::Precision;
  using Method = BulletDetector::Method;
  using Frame = BulletDetector::Frame;
  static const Names<Precision> precisions{{"double", Precision::double_precision},
                                           {"float", Precision::single_precision}};
  static const Names<Method> methods{{"contact", Method::contact}, {"callback", Method::callback}};
  static const Names<Frame> frames{{"mesh", Frame::mesh}, {"fitted", Frame::fitted}};
  info.queries = queries_of<BulletDetector>();
  info.options = {
      choice("precision", precisions, "which of Debian's two builds of the library"),
      choice("method", methods, "contact: as most programs use it; callback: this project's kernel"),
      choice("frame", frames, "fitted: moved and scaled to the size that Bullet is written for"),
      query_option()};
  // The two builds define the same names, so a program has one or the other.
  info.worker_program = [](const OptionValues& values) {
    return values.text("precision") == "float" ? "touchmark-worker-bullet-float" : default_worker_program;
  };
  const auto options_of = [](const OptionValues& values) -> BulletDetector::Options {
    if (chosen(values, "precision", precisions) != BulletDetector::precision())
      throw std::invalid_argument("bullet: precision=" + values.text("precision") +
                                  " is not the build of Bullet that this program has");
    return {chosen(values, "method", methods), chosen(values, "frame", frames), asking(values)};
  };
  info.build = [options_of](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<BulletDetector>(mesh, options_of(values));
  };
  info.build_scene = build_rival_scene<baselines::BulletScene>(options_of);
  info.storage_rounding = [](const TriangleMesh& mesh,
                             const OptionValues& values) -> std::optional<StorageRounding> {
    if (values.text("precision") != "float" || values.text("method") != "contact") return std::nullopt;
    baselines::BulletView view;
    if (chosen(values, "frame", frames) == Frame::fitted) view = baselines::BulletView::fitted(mesh);
    return stored_in_single_precision(view.scale, view.origin);
  };
  info.forms = {
      .compared = {"", "precision=float", "precision=float,frame=fitted", "method=callback,frame=fitted"},
      .verified = {"frame=fitted", "precision=float,method=callback"},
      .frontier = {"", "frame=fitted", "precision=float", "precision=float,frame=fitted",
                   "method=callback,frame=fitted"},
      .scaled = {"method=callback,frame=fitted"},
      .updated = {"", "method=callback,frame=fitted"},
      .suite = {"method=callback,frame=fitted", "precision=float,method=callback,frame=fitted"},
      .scenes = {"method=callback,frame=fitted"}};
  return info;
}

}  // namespace touchmark::bench::contestants
