#include "core/mesh_io/dae/dae_document.h"

#include <algorithm>
#include <new>
#include <unordered_map>
#include <utility>

#include <pugixml.hpp>

namespace touchmark::mesh_io {
namespace {

using pugi::xml_node;

/// Returns where the lines begin in the UTF-8 that the parser made of the bytes; nothing where that is not
/// known.
std::vector<std::size_t> line_starts(std::string_view bytes, pugi::xml_encoding encoding) {
  const bool is_wide = encoding == pugi::encoding_utf16_le || encoding == pugi::encoding_utf16_be;
  if (!is_wide && encoding != pugi::encoding_utf8 && encoding != pugi::encoding_latin1) return {};
  const std::size_t low = encoding == pugi::encoding_utf16_be ? 1 : 0;
  std::vector<std::size_t> starts = {0};
  std::size_t at = 0;
  unsigned last = 0;
  const auto byte = [&](std::size_t i) {
    return static_cast<unsigned>(static_cast<unsigned char>(bytes[i]));
  };
  for (std::size_t i = 0; i + is_wide < bytes.size(); i += is_wide ? 2 : 1) {
    const unsigned unit = is_wide ? byte(i + low) | byte(i + 1 - low) << 8 : byte(i);
    const bool is_half = (unit >> 11) == (0xd800 >> 11);  // two make a character of four bytes
    at += unit < 0x80 || encoding == pugi::encoding_utf8 ? 1 : unit < 0x800 || is_half ? 2 : 3;
    if (unit == '\n' && last == '\r') starts.pop_back();
    if (unit == '\n' || unit == '\r') starts.push_back(at);
    last = unit;
  }
  return starts;
}

/// The next element in the order of the file, without recursion: a file may nest as it likes.
xml_node next_node(xml_node node) {
  if (node.first_child()) return node.first_child();
  while (node && !node.next_sibling()) node = node.parent();
  return node.next_sibling();
}

std::string key(std::string_view kind, std::string_view id) {
  return std::string(kind).append("#").append(id);
}

/// What an element is called in errors: its name and its id, or that of the next element around it that has
/// one.
std::string label(const xml_node& element) {
  constexpr std::size_t max_length = 40;
  std::string text =
      std::string("<").append(std::string_view(element.name()).substr(0, max_length)).append(">");
  for (xml_node named = element; named; named = named.parent()) {
    const char* id = named.attribute("id").value();
    if (*id != '\0') return text + (named == element ? " " : " in ") + quoted(id);
  }
  return text;
}

}  // namespace

struct DaeDocument::Content {
  struct Identified {
    xml_node element;
    std::size_t count = 0;
  };

  pugi::xml_document document;
  std::vector<std::size_t> lines;
  std::unordered_map<std::string, Identified> by_id;
  std::unordered_map<std::string, std::vector<xml_node>> by_kind;
  std::size_t elements = 0;

  void parse(std::string_view bytes);
  void check_root() const;
  void index();
  /// 0 where it is not known.
  std::size_t line_at(std::ptrdiff_t offset) const;
  std::string place(std::ptrdiff_t offset) const;
};

std::size_t DaeDocument::Content::line_at(std::ptrdiff_t offset) const {
  if (offset < 0) return 0;
  const auto after = std::upper_bound(lines.begin(), lines.end(), static_cast<std::size_t>(offset));
  return static_cast<std::size_t>(after - lines.begin());
}

std::string DaeDocument::Content::place(std::ptrdiff_t offset) const {
  const std::size_t line = line_at(offset);
  return line == 0 ? "" : "line " + std::to_string(line) + ": ";
}

void DaeDocument::Content::parse(std::string_view bytes) {
  if (bytes.starts_with("PK\x03\x04"))
    throw MeshError("is a zip archive (.zae); unpack it and take the .dae file that is in it");
  // White space alone may separate two numbers with comments around it.
  constexpr unsigned options = pugi::parse_default | pugi::parse_ws_pcdata | pugi::parse_doctype;
  const pugi::xml_parse_result result = document.load_buffer(bytes.data(), bytes.size(), options);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  lines = line_starts(bytes, result.encoding);
  if (!result) throw MeshError(place(result.offset) + "is no well-formed XML: " + result.description());
  if (result.encoding != pugi::encoding_utf8) return;
  const std::size_t end = std::min(bytes.find('\0'), bytes.rfind('>') + 1);
  if (!is_padding(bytes.substr(end)))
    throw MeshError(place(static_cast<std::ptrdiff_t>(end)) + "goes on after the end of its XML");
}

void DaeDocument::Content::check_root() const {
  std::size_t roots = 0;
  for (const xml_node& child : document.children()) {
    if (child.type() == pugi::node_doctype &&
        std::string_view(child.value()).find("<!ENTITY") != std::string_view::npos)
      throw MeshError(place(child.offset_debug()) +
                      "declares entities, which are not read; write their text out");
    if (child.type() == pugi::node_element) ++roots;
  }
  const xml_node root = document.document_element();
  const std::string_view version = root.attribute("version").value();
  const std::string where = place(root.offset_debug());
  if (roots > 1)
    throw MeshError(where + "is no well-formed XML: has " + std::to_string(roots) + " root elements");
  if (std::string_view(root.name()) != "COLLADA")
    throw MeshError(where + "begins with " + quoted(root.name()) + " instead of COLLADA");
  if (!version.empty() && !version.starts_with("1.4") && !version.starts_with("1.5"))
    throw MeshError(where + "COLLADA " + quoted(version) + " is not read; export it as 1.4 or 1.5");
}

void DaeDocument::Content::index() {
  const std::string_view root = document.document_element().name();
  const std::string prefix(root.substr(0, root.find(':') == root.npos ? 0 : root.find(':') + 1));
  for (xml_node node = document.document_element(); node; node = next_node(node)) {
    if (node.type() != pugi::node_element) continue;
    ++elements;
    std::string name = node.name();
    if (!prefix.empty() && name.starts_with(prefix)) {
      name.erase(0, prefix.size());
      node.set_name(name.c_str());
    }
    if (const char* id = node.attribute("id").value(); *id != '\0') {
      Identified& identified = by_id[key(name, id)];
      identified.element = node;
      ++identified.count;
    }
    if (name == "asset" || name == "visual_scene") by_kind[name].push_back(node);
  }
}

DaeDocument::DaeDocument(std::string_view bytes) : content_(std::make_unique<Content>()) {
  content_->parse(bytes);
  content_->index();
  content_->check_root();
}

DaeDocument::~DaeDocument() = default;

xml_node DaeDocument::root() const { return content_->document.document_element(); }

std::size_t DaeDocument::element_count() const noexcept { return content_->elements; }

const std::vector<xml_node>& DaeDocument::all_of(const std::string& kind) const {
  return content_->by_kind[kind];
}

std::string_view DaeDocument::attribute(const xml_node& element, const char* name) const {
  const pugi::xml_attribute found = element.attribute(name);
  for (pugi::xml_attribute other = found.next_attribute(); other; other = other.next_attribute())
    if (std::string_view(other.name()) == name) fail(element, "has two attributes ", name);
  return found.value();
}

TextCursor DaeDocument::cursor_at(const xml_node& element) const {
  return TextCursor({}, 0, content_->line_at(element.offset_debug()));
}

std::size_t DaeDocument::count(const xml_node& element, const char* name) const {
  const std::int64_t number =
      parse_integer(attribute(element, name), label(element) + ": " + name, cursor_at(element));
  if (number < 0) fail(element, name, " ", number, " is negative");
  return static_cast<std::size_t>(number);
}

double DaeDocument::number(const xml_node& element, const char* name) const {
  return parse_double(attribute(element, name), label(element) + ": " + name, cursor_at(element));
}

std::size_t DaeDocument::count_or(const xml_node& element, const char* name, std::size_t absent) const {
  return element.attribute(name) ? count(element, name) : absent;
}

xml_node DaeDocument::only_child(const xml_node& element, const char* name) const {
  const xml_node child = element.child(name);
  if (child.next_sibling(name)) fail(child.next_sibling(name), "is the second one here; one is allowed");
  return child;
}

xml_node DaeDocument::target(const xml_node& element, const char* attribute_name,
                             std::initializer_list<const char*> kinds) const {
  const std::string_view name = attribute(element, attribute_name);
  if (name.empty()) fail(element, "has no attribute ", attribute_name);
  if (name.front() != '#')
    fail(element, "names ", quoted(name),
         ", which is in another file, or lacks its #; export all parts into one file");
  std::string wanted;
  for (const char* kind : kinds) {
    wanted += (wanted.empty() ? "<" : " or <") + std::string(kind) + ">";
    auto found = content_->by_id.find(key(kind, name.substr(1)));
    if (found == content_->by_id.end())
      found = content_->by_id.find(key(kind, decoded_percents(name.substr(1)).value_or("")));
    if (found == content_->by_id.end()) continue;
    const auto& [target, count] = found->second;
    if (count > 1) fail(element, "names ", quoted(name), ", an id that ", count, " <", kind, "> have");
    return target;
  }
  fail(element, "names ", quoted(name), ", but no ", wanted, " has this id");
}

DaeDocument::Words DaeDocument::words(const xml_node& element) const {
  Words words;
  std::ptrdiff_t begin = element.offset_debug();
  for (const xml_node& child : element.children()) {
    if (child.type() == pugi::node_element) fail_unknown(child);
    if (child.type() != pugi::node_pcdata && child.type() != pugi::node_cdata) continue;
    if (words.text.empty()) begin = child.offset_debug();
    words.text += child.value();
  }
  words.line = content_->line_at(begin);
  words.what = label(element) + ": the number";
  return words;
}

std::vector<double> DaeDocument::numbers(const xml_node& element) const {
  const Words words = this->words(element);
  std::vector<double> numbers;
  for (TextCursor cursor = words.cursor(); !cursor.at_end();) numbers.push_back(cursor.number(words.what));
  return numbers;
}

void DaeDocument::throw_error(const xml_node& element, const std::string& message) const {
  throw MeshError(content_->place(element.offset_debug()) + label(element) + ": " + message);
}

void DaeDocument::fail_unknown(const xml_node& element) const {
  fail(element, "cannot stand in <", element.parent().name(), ">");
}

}  // namespace touchmark::mesh_io
