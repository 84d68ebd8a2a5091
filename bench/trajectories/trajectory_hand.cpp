#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "bench/meshes/portable_sincos.h"
#include "bench/support/length_unit.h"
#include "bench/support/names.h"
#include "bench/support/numbers.h"
#include "bench/support/split.h"
#include "bench/trajectories/drape.h"
#include "bench/trajectories/trajectory_shapes.h"

namespace touchmark::bench::trajectories {
namespace {

enum class Kind { contact, free, tap };

/// How a hand differs from what was recorded, as the words behind its name say.
struct Options {
  Kind kind = Kind::contact;
  double speed = 1, tremor = 1, noise = 1;  ///< factors on what was recorded
  double encoder_m = 0;                     ///< the step of the sensor, in metres; 0: none
  double size_m = 0;                        ///< the diagonal of the mesh's box, in metres; 0: not said
};

constexpr std::array<support::Name<Kind>, 3> kinds{
    {{Kind::contact, "contact"}, {Kind::free, "free"}, {Kind::tap, "tap"}}};

struct Key {
  std::string_view name;
  double Options::*value;
  double least, most;
  bool is_length = false;
};

constexpr Key keys[] = {{"speed", &Options::speed, 0, 100},
                        {"tremor", &Options::tremor, 0, 100},
                        {"noise", &Options::noise, 0, 100},
                        {"encoder", &Options::encoder_m, 0, 1000, true},
                        {"size", &Options::size_m, 1e-6, 1000, true}};

/// Returns the factor, or the length in metres, where the key takes it.
std::optional<double> value_of(const Key& key, std::string_view text) {
  double unit = 1;
  if (key.is_length) {
    const auto found = std::ranges::find_if(support::length_units,
                                            [&](const auto& known) { return text.ends_with(known.name); });
    if (found == support::length_units.end()) return std::nullopt;
    unit = found->metres;
    text.remove_suffix(found->name.size());
  }
  const double value = unit * support::parse_number(text).value_or(-1);
  return value >= key.least && value <= key.most ? std::optional(value) : std::nullopt;
}

/// Reads "hand", "hand:free" or "hand:tap,speed=2,encoder=4.5um".
Options parse_options(const std::string& trajectory) {
  Options options;
  const std::size_t colon = trajectory.find(':');
  if (colon == std::string::npos) return options;
  std::set<std::string_view> seen;
  for (const std::string_view word : support::split(std::string_view(trajectory).substr(colon + 1), ',')) {
    const std::string_view name = word.substr(0, word.find('='));
    const std::optional<Kind> kind = support::value_in<Kind>(kinds, word);
    const auto* const key = std::ranges::find(keys, name, &Key::name);
    std::optional<double> value;
    if (key != std::end(keys) && name != word) value = value_of(*key, word.substr(name.size() + 1));
    if ((!kind && !value) || !seen.insert(kind ? "kind" : name).second)
      throw std::invalid_argument(
          fmt::format("trajectory '{}': \"{}\" is unknown, out of range or one too many; write hand{}, F "
                      "from 0 to 100, LENGTH as 4.5um or 20cm",
                      trajectory, word, hand_words));
    if (kind) options.kind = *kind;
    if (value) options.*key->value = *value;
  }
  return options;
}

// Fitted to three recordings of a hand that guides a pen over paper: hand_test compares both. Metres, ticks
// of a millisecond, and turns.

/// Each of eight strokes in a row has another peak of its speed.
constexpr std::array<double, 8> peak_speeds = {12e-6, 18.5e-6, 25e-6, 30e-6, 35e-6, 77e-6, 142e-6, 186e-6};
constexpr double mean_of_peak = 8. / 15;  // with minimum jerk
constexpr double min_stroke = 500, max_stroke = 1100, max_rest = 620;
constexpr double max_turn = 1. / 3, max_turning = 0.0009;  // between two strokes, and a tick along one
constexpr double tremor_rms = 15e-6;
constexpr std::array<double, 3> noise_rms = {1.28e-6, 1.55e-6, 1.62e-6};  // of a position

/// About normal, with mean 0 and variance 1: of six numbers in [0, 1) the sum has mean 3 and variance 1/2.
double normal_number(support::Random& random) {
  double sum = -3;
  for (int i = 0; i < 6; ++i) sum += random.unit();
  return std::sqrt(2.) * sum;
}

/// In the recordings seven rows hold ten readings: from row to row the sensor goes on by one reading or by
/// two.
double reading_time(std::size_t tick, double unsteadiness) {
  const auto steady = static_cast<double>(tick);
  return steady + unsteadiness * (0.7 * static_cast<double>(tick * 10 / 7) - steady);
}

/// Heights between which a hand moves, and how steep its strokes are at most: the sine of the slope.
struct Band {
  double low, high, steepest;
};

Band band_of(Kind kind, const Motion& motion, double metre) {
  const double clear = 1.1 * motion.radius, middle = 0.5 * motion.radius;
  if (kind == Kind::free) return {clear + 0.001 * motion.diagonal, clear + 0.15 * motion.diagonal, 0.9};
  if (kind == Kind::tap) return {middle, middle + 0.15 * motion.diagonal, 0.98};
  const double wander = std::min(0.2 * motion.radius, 1e-4 * metre);
  return {middle - wander, middle + wander, 0.1};
}

/// The hand itself, over flat ground: strokes with minimum jerk, and rests between them.
class Strokes {
 public:
  Strokes(Kind kind, const Band& band, double speed, support::Random random)
      : taps_(kind == Kind::tap), band_(band), speed_(speed), random_(random), at_(0, 0, band.low) {}

  /// `time` never goes back.
  const Vec3& at(double time) {
    while (time >= begin_ + ticks_ + rest_) {
      go(ticks_);
      begin_ += ticks_ + rest_;
      start_next();
    }
    go(std::min(time - begin_, ticks_));
    return at_;
  }

 private:
  void go(double ticks) {
    const double part = ticks_ > 0 ? ticks / ticks_ : 0;
    const double way = length_ * part * part * part * (10 + part * (6 * part - 15));
    const meshes::SinCos heading = meshes::portable_sincos(heading_ + turning_ * ticks);
    const double level = std::sqrt(1 - slope_ * slope_);
    at_ += (way - way_) * Vec3(level * heading.cos, level * heading.sin, slope_);
    way_ = way;
  }

  void start_next() {
    heading_ += turning_ * ticks_ + random_.between(-max_turn, max_turn);
    const double bend = random_.between(-1, 1);
    turning_ = max_turning * bend * std::abs(bend);
    rest_ = random_.between(0, max_rest);
    way_ = 0;
    const bool returns = taps_ && slope_ > 0;
    if (!returns) choose_length();
    const double height = taps_ ? (returns ? band_.low : band_.high) : random_.between(band_.low, band_.high);
    if (length_ > 0) slope_ = std::clamp((height - at_.z()) / length_, -band_.steepest, band_.steepest);
  }

  void choose_length() {
    const std::size_t stroke = strokes_++ % peaks_.size();
    if (stroke == 0) random_.shuffle(peaks_);
    const double speed = speed_ * mean_of_peak * peaks_[stroke];
    ticks_ = random_.between(min_stroke, max_stroke);
    length_ = speed * ticks_;
    if (!taps_ || speed == 0) return;
    length_ = std::max(length_, 3 * band_.low);  // upwards it loses the contact
    ticks_ = length_ / speed;
  }

  bool taps_;
  Band band_;
  double speed_;
  support::Random random_;
  std::array<double, 8> peaks_ = peak_speeds;
  std::size_t strokes_ = 0;
  Vec3 at_;
  double begin_ = 0, ticks_ = 0, rest_ = 0, length_ = 0, heading_ = 0, turning_ = 0, slope_ = 0;
  double way_ = 0;  ///< made of the length
};

}  // namespace

Positions hand(Motion motion) {
  const Options options = parse_options(motion.name);
  const double metre = options.size_m > 0 ? motion.diagonal / options.size_m : motion.metre;
  const Band band = band_of(options.kind, motion, metre);
  support::Random sensor(motion.random.below(1 << 30));
  Strokes strokes(options.kind, band, options.speed * metre, support::Random(motion.random.below(1 << 30)));
  double last_tremor = 0, tremor_before = 0;
  // A narrow band of noise about 10.5 Hz, with variance 1: a resonance that decays to 0.97 of itself each
  // tick.
  const auto tremor = [&] {
    const double now = 0.0245869 * normal_number(sensor) + 1.9357792 * last_tremor - 0.9409 * tremor_before;
    tremor_before = std::exchange(last_tremor, now);
    return now;
  };
  for (int i = 0; i < 1000; ++i) tremor();  // until it no longer knows its start
  const double trembling = options.tremor * tremor_rms * metre, noise = options.noise * metre;
  const double rms = std::sqrt(trembling * trembling + noise * noise * noise_rms[2] * noise_rms[2]);
  const bool is_bound = options.kind != Kind::free && rms > 0;
  const double along_normal = is_bound ? std::min(1., motion.radius / (4 * rms)) : 1;
  const double highest = options.kind == Kind::contact ? 0.95 * motion.radius : 2 * band.high;
  const double encoder = options.encoder_m * metre;
  Positions flat;
  for (std::size_t i = 0; i < motion.steps; ++i) {
    Vec3 at = strokes.at(reading_time(i, std::min(options.noise, 1.)));
    for (int axis = 0; axis < 3; ++axis)
      at[axis] += (axis == 2 ? along_normal : 1) * noise * noise_rms[axis] * normal_number(sensor);
    at.z() += along_normal * trembling * tremor();
    if (encoder > 0) at = encoder * (at / encoder).array().round();
    at.z() = std::clamp(at.z(), 0.0, highest);
    flat.push_back(at);
  }
  return laid_on_surface(flat, motion);
}

}  // namespace touchmark::bench::trajectories
