/// A COLLADA file as XML: elements by their ids, lists of numbers, and errors that name the element and the
/// line.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/mesh_io/mesh_builder.h"

namespace pugi {
class xml_node;
}

namespace touchmark::mesh_io {

/// Returns the parts of a message, words and whole numbers, as one text.
template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return std::move(text).str();
}

/// Every function throws MeshError("line N: <element> 'id': what is wrong").
class DaeDocument {
 public:
  /// Refuses what is not well-formed, and every root but a COLLADA of version 1.4 or 1.5. UTF-8, UTF-16,
  /// UTF-32 and Latin-1 are read. Prefixes of COLLADA's namespace are removed from the names of elements.
  explicit DaeDocument(std::string_view bytes);
  ~DaeDocument();

  pugi::xml_node root() const;
  std::size_t element_count() const noexcept;
  const std::vector<pugi::xml_node>& all_of(const std::string& kind) const;

  /// Returns an attribute's value; empty where there is none.
  std::string_view attribute(const pugi::xml_node& element, const char* name) const;
  /// Returns an attribute that must be a whole number from 0 on; `absent` where there is none.
  std::size_t count(const pugi::xml_node& element, const char* name) const;
  std::size_t count_or(const pugi::xml_node& element, const char* name, std::size_t absent) const;
  /// Returns an attribute that must be a finite number.
  double number(const pugi::xml_node& element, const char* name) const;
  /// Returns the only child of a name, or the null node. Refuses a second one.
  pugi::xml_node only_child(const pugi::xml_node& element, const char* name) const;
  /// Returns the element of one of these kinds that an attribute names as "#id".
  pugi::xml_node target(const pugi::xml_node& element, const char* attribute,
                        std::initializer_list<const char*> kinds) const;

  /// The words of an element that holds text alone.
  struct Words {
    std::string text;
    std::string what;  ///< what errors call a number: "<p> in 'id': the number"
    std::size_t line;
    TextCursor cursor() const { return TextCursor(text, 0, line); }
  };
  Words words(const pugi::xml_node& element) const;
  std::vector<double> numbers(const pugi::xml_node& element) const;

  /// Throws with the parts of a message one after the other.
  template <class... Parts>
  [[noreturn]] void fail(const pugi::xml_node& element, const Parts&... parts) const {
    throw_error(element, text_of(parts...));
  }
  /// Refuses an element that its parent cannot have here.
  [[noreturn]] void fail_unknown(const pugi::xml_node& element) const;

 private:
  [[noreturn]] void throw_error(const pugi::xml_node& element, const std::string& message) const;
  TextCursor cursor_at(const pugi::xml_node& element) const;

  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace touchmark::mesh_io
