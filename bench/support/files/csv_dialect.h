/// How a table of another program is written: comments, separators of columns, numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace touchmark::bench::support {

/// Returns the text without blanks and tabs at its ends.
std::string_view trimmed(std::string_view text) noexcept;

/// True if the text has letters other than the e of numbers.
bool has_words(std::string_view text) noexcept;

/// Reads a decimal number as std::from_chars does. A + may stand before it, and where no comma separates
/// columns it may have a decimal comma.
std::errc parse_decimal(std::string_view text, char separator, double& value);

/// True if the field is a number, "nan" and "inf" included.
bool is_number(std::string_view field, char separator);

/// Returns the text behind the mark of a comment (#, % or //), or nothing for a line that is no comment.
std::optional<std::string_view> comment_in(std::string_view line) noexcept;

/// Returns a line's fields, without quotes and blanks around them. Where blanks separate, so do tabs, and a
/// run of them is one separator.
std::vector<std::string> split_fields(std::string_view line, char separator);

/// Returns what separates the columns of a file that begins with `text`: a comma, tab, semicolon or blank.
/// It is the one that gives at least one line three numbers, and most lines the same number of fields. If
/// none gives three numbers, it is the one that gives the first line most fields, blanks last.
char separator_of(std::string_view text);

}  // namespace touchmark::bench::support
