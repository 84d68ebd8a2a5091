#include "bench/workers/line_channel.h"

#include <array>
#include <cerrno>

#include <poll.h>
#include <sys/socket.h>

namespace touchmark::bench::workers {

bool LineChannel::send(std::string line) const {
  line += '\n';
  for (std::size_t sent = 0; sent < line.size();) {
    const ssize_t count = ::send(descriptor_, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

bool LineChannel::take_line(std::string& line) {
  const std::size_t end = received_.find('\n');
  if (end == std::string::npos) return false;
  line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return true;
}

bool LineChannel::wait_for_bytes() const {
  pollfd waiting{descriptor_, POLLIN, 0};
  return poll(&waiting, 1, 100) > 0;
}

bool LineChannel::read_some() {
  std::array<char, 4096> buffer;
  const ssize_t count = recv(descriptor_, buffer.data(), buffer.size(), 0);
  if (count < 0) return errno == EINTR;
  received_.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0;
}

}  // namespace touchmark::bench::workers
