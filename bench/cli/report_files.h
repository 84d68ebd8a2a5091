/// Files for other programs beside --out: JUnit's XML and a summary in Markdown.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/support/files/atomic_file.h"

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

/// As the command line gave them; empty: none.
struct ReportSelectors {
  std::string junit, markdown;
};

void add_junit(CLI::App& command, ReportSelectors& selectors);
void add_markdown(CLI::App& command, ReportSelectors& selectors);

/// A file that was asked for, or none. It is opened before the work, so that a name that cannot be written is
/// known at once, and appears when it is written.
class ReportFile {
 public:
  /// Throws ResourceError.
  explicit ReportFile(const std::string& path) {
    if (!path.empty()) file_.emplace(path);
  }

  bool wanted() const noexcept { return file_.has_value(); }
  /// Once, and only where it is wanted. Throws ResourceError.
  void write(std::string_view text) {
    file_->write(text);
    file_->commit();
  }

 private:
  std::optional<support::AtomicFile> file_;
};

/// Returns the text as it stands, for Markdown: nothing for none.
std::string code_block(const std::string& text);

}  // namespace touchmark::bench::cli
