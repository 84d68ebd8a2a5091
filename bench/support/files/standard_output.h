/// What a command prints for other programs to read: nothing of it is lost unnoticed.
#pragma once

#include <string_view>

namespace touchmark::bench::support {

class StandardOutput {
 public:
  /// From now on a reader that has gone is an error of the write, not a signal that ends the program.
  StandardOutput();

  /// False when nobody reads any more (`| head`): the command has nothing left to do, and no reason to
  /// complain. Throws ResourceError when the disk is full or fails.
  bool write(std::string_view text);
  /// Call it at the end: only now is all of it out. As write.
  bool finish();
};

}  // namespace touchmark::bench::support
