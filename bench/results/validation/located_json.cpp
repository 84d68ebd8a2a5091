#include "bench/results/validation/located_json.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "bench/support/files/text_file.h"

namespace touchmark::bench::results::validation {
namespace {

constexpr std::size_t deepest = 100;  // the pointers of what is nested deeper would fill the memory

/// Walks through text and tells how far the parser has read.
struct WatchedCharacters {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  const char** furthest;

  reference operator*() const { return *at; }
  WatchedCharacters& operator++() {
    *furthest = ++at;
    return *this;
  }
  WatchedCharacters operator++(int) {
    const WatchedCharacters before = *this;
    ++*this;
    return before;
  }
  bool operator==(const WatchedCharacters& other) const { return at == other.at; }
  bool operator!=(const WatchedCharacters& other) const { return at != other.at; }
};

std::string escaped(const std::string& key) {
  std::string text;
  for (const char c : key) text += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return text;
}

/// Follows the parser, and notes the line of each value.
class Locator : public nlohmann::json_sax<nlohmann::json> {
 public:
  Locator(std::string path, const std::string& text, LocatedJson& document, Faults& faults)
      : path_(std::move(path)),
        counted_(text.data()),
        furthest_(text.data()),
        document_(document),
        faults_(faults) {
    nlohmann::json::sax_parse(WatchedCharacters{text.data(), &furthest_},
                              WatchedCharacters{text.data() + text.size(), &furthest_}, this);
  }

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  // The parser sees where a number ends by the character behind it.
  bool number_integer(std::int64_t) override { return value(1); }
  bool number_unsigned(std::uint64_t) override { return value(1); }
  bool number_float(double, const std::string&) override { return value(1); }
  bool string(std::string&) override { return value(); }
  bool binary(nlohmann::json::binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(std::string& name) override {
    open_.back().key = escaped(name);
    if (!open_.back().keys.insert(name).second)
      faults_.push_back({path_, line(0), pointer(), name, "is there twice"});
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    return false;  // told by the parser proper
  }

 private:
  struct Open {
    bool array = false;
    std::string pointer;
    std::string key;
    std::size_t index = 0;
    std::set<std::string> keys;
  };

  std::string pointer() const {
    if (open_.empty()) return "";
    const Open& in = open_.back();
    return in.pointer + "/" + (in.array ? std::to_string(in.index) : in.key);
  }
  std::size_t line(std::ptrdiff_t read_too_far) {
    const char* const here = std::max(counted_, furthest_ - read_too_far);
    line_ += static_cast<std::size_t>(std::count(counted_, here, '\n'));
    counted_ = here;
    return line_;
  }
  bool value(std::ptrdiff_t read_too_far = 0) {
    document_.lines.emplace(pointer(), line(read_too_far));
    if (!open_.empty()) ++open_.back().index;
    return true;
  }
  bool open(bool array) {
    if (open_.size() >= deepest) {
      faults_.push_back(
          {path_, line(0), "", "", fmt::format("the text is nested deeper than {} levels", deepest)});
      return false;
    }
    document_.lines.emplace(pointer(), line(0));
    open_.push_back({array, pointer(), "", 0, {}});
    return true;
  }
  bool close() {
    open_.pop_back();
    if (!open_.empty()) ++open_.back().index;
    return true;
  }

  std::string path_;
  const char* counted_;   ///< up to here line ends are in line_
  const char* furthest_;  ///< up to here the parser has read
  std::size_t line_ = 1;
  std::vector<Open> open_;
  LocatedJson& document_;
  Faults& faults_;
};

}  // namespace

std::size_t LocatedJson::line_of(const std::string& pointer) const {
  for (std::string at = pointer;; at.resize(at.rfind('/'))) {
    const auto found = lines.find(at);
    if (found != lines.end()) return found->second;
    if (at.rfind('/') == std::string::npos) return 0;
  }
}

std::optional<LocatedJson> read_located_json(const std::string& path, Faults& faults) {
  const std::string text = support::read_text_file(path);
  LocatedJson document;
  try {
    document.value = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    faults.push_back({path, static_cast<std::size_t>(1 + std::count(text.begin(), end, '\n')), "", "",
                      "the text is not JSON"});
    return std::nullopt;
  } catch (const nlohmann::json::exception&) {  // a number beyond all bounds
    faults.push_back({path, 0, "", "", "the text is not JSON with numbers of double precision"});
    return std::nullopt;
  }
  const std::size_t before = faults.size();
  Locator(path, text, document, faults);
  const bool whole = std::none_of(faults.begin() + static_cast<std::ptrdiff_t>(before), faults.end(),
                                  [](const Fault& fault) { return fault.where.empty(); });
  return whole ? std::optional(std::move(document)) : std::nullopt;
}

}  // namespace touchmark::bench::results::validation
