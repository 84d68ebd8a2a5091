#include "bench/workers/worker_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <string_view>
#include <thread>
#include <type_traits>
#include <variant>

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/support/failures.h"
#include "bench/support/system/beside_this_program.h"
#include "bench/support/system/interrupt.h"
#include "bench/support/system/system_limit.h"

namespace touchmark::bench::workers {
namespace {

/// The exit status of a program that could not be loaded, as the dynamic loader and shells have it.
constexpr int not_loaded = 127;
// NotStarted, as line_of has it.
constexpr std::string_view start_error_begin = "[0,{\"error\":", start_error_end = "}]\n";
static_assert(std::is_same_v<std::variant_alternative_t<0, Reply>, NotStarted>);

/// Everything the child needs, prepared before fork: after it only async-signal-safe calls are allowed.
struct Exec {
  std::string path;
  std::vector<std::string> arguments;
  std::vector<char*> argv;

  explicit Exec(const WorkerLaunch& launch) : path(support::beside_this_program(launch.program)) {
    arguments = launch.under;
    arguments.push_back(path);
    path = arguments.front();
    arguments.insert(arguments.end(), launch.flags.begin(), launch.flags.end());
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
  }
};

/// The three descriptors at their agreed numbers. Moved up first, so that none is overwritten by another.
bool place_descriptors(int control, int input, int output) {
  constexpr int above = std::max({worker_control, worker_input, worker_output}) + 1;
  const std::array<int, 3> from{fcntl(control, F_DUPFD_CLOEXEC, above), fcntl(input, F_DUPFD_CLOEXEC, above),
                                fcntl(output, F_DUPFD_CLOEXEC, above)};
  constexpr std::array<int, 3> to{worker_control, worker_input, worker_output};
  for (std::size_t i = 0; i < from.size(); ++i)
    if (from[i] < 0 || dup2(from[i], to[i]) < 0) return false;
  return true;
}

/// In place of the worker that could not be started, its first reply. Only what a child may do before exec.
void tell_start_error(int control, int error) {
  std::array<char, 32> line{};
  std::size_t begin = line.size();
  const auto prepend = [&](std::string_view text) {
    for (std::size_t i = text.size(); i > 0; --i) line[--begin] = text[i - 1];
  };
  prepend(start_error_end);
  do {
    line[--begin] = static_cast<char>('0' + error % 10);
    error /= 10;
  } while (error > 0);
  prepend(start_error_begin);
  const ssize_t ignored = send(control, line.data() + begin, line.size() - begin, MSG_NOSIGNAL);
  static_cast<void>(ignored);
}

void silence_output() {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

void restrict_to_core(int core) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<unsigned>(core), &cores);
  sched_setaffinity(0, sizeof cores, &cores);  // if refused, the worker runs anywhere
}

[[noreturn]] void become_worker(const WorkerLaunch& launch, const Exec& exec, int control, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(support::exit_resources);  // it died before the line above
  // Ctrl-C goes to the whole foreground group; the program decides what it means.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_IGN);
  if (!launch.show_output) silence_output();
  if (launch.core) restrict_to_core(*launch.core);
  // The control is moved first, so that it is there to tell by whatever fails after it.
  if (place_descriptors(control, launch.input, launch.output)) execv(exec.path.c_str(), exec.argv.data());
  // F_DUPFD says EINVAL where the limit on descriptors does not admit the number.
  tell_start_error(control, errno == EINVAL ? EMFILE : errno);
  _exit(not_loaded);
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) {
    const char* name = sigabbrev_np(WTERMSIG(status));
    return name != nullptr ? fmt::format("crashed:SIG{}", name) : fmt::format("crashed:{}", WTERMSIG(status));
  }
  return fmt::format("crashed:exit {}", WEXITSTATUS(status));
}

}  // namespace

bool worker_program_exists(const std::string& program) {
  return access(support::beside_this_program(program).c_str(), X_OK) == 0;
}

WorkerProcess::WorkerProcess(const WorkerLaunch& launch) : program_(launch.program) {
  if (!worker_program_exists(launch.program))
    throw support::ResourceError(fmt::format("the program {} is not beside this one", launch.program));
  std::array<int, 2> sockets{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    throw support::ResourceError(
        fmt::format("cannot talk to a worker: {}", support::described_with_limit(errno)));
  const Exec exec(launch);
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) become_worker(launch, exec, sockets[1], parent);
  const int error = errno;
  close(sockets[1]);
  if (process_ < 0) {
    close(sockets[0]);
    throw support::ResourceError(
        fmt::format("cannot start a worker: {}", support::described_with_limit(error)));
  }
  control_ = sockets[0];
  channel_ = LineChannel(control_);
}

WorkerProcess::~WorkerProcess() {
  if (process_ > 0) kill(process_, SIGKILL);
  end();
}

WorkerProcess::Ending WorkerProcess::end() {
  if (control_ >= 0) close(std::exchange(control_, -1));
  if (process_ <= 0) return {};
  Ending ending;
  rusage used{};
  // Closing the socket ends an orderly worker; one that lingers is killed.
  for (int waited_ms = 0; wait4(process_, &ending.status, WNOHANG, &used) == 0; ++waited_ms) {
    if (waited_ms == 2000) kill(process_, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  process_ = -1;
  ending.out_of_time = WIFSIGNALED(ending.status) && support::used_up_its_time(used);
  return ending;
}

void WorkerProcess::explain(const Ending& ending) const {
  if (ending.out_of_time)
    throw support::ResourceError(fmt::format("{}: {}", program_, support::time_limit()));
  const std::string how = how_it_ended(ending.status);
  const bool not_started = WIFEXITED(ending.status) && WEXITSTATUS(ending.status) == not_loaded;
  if (replied_ || (loads_plugin_ && !not_started)) throw WorkerFailure(how);
  if (not_started)
    throw support::ResourceError(
        fmt::format("{} cannot be loaded: a library is missing, or there is too little memory{}", program_,
                    support::memory_limit()));
  throw support::ResourceError(
      fmt::format("{} ended before it knew whom to run: {}{}", program_, how, support::memory_limit()));
}

Reply WorkerProcess::ask(const Request& request, std::chrono::milliseconds timeout) {
  if (process_ <= 0) throw WorkerFailure("ended");
  loads_plugin_ = std::holds_alternative<request::Describe>(request) ||
                  std::holds_alternative<request::Reproduce>(request);
  channel_.send(line_of(request));  // one that is gone may have left a reply that says why
  std::string line;
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  switch (channel_.receive(line, deadline, support::check_for_interrupt)) {
    case LineChannel::Outcome::line:
      break;
    case LineChannel::Outcome::closed:
      explain(end());
    case LineChannel::Outcome::late:
      kill(process_, SIGKILL);
      end();
      throw WorkerFailure("timeout");
  }
  Reply reply = reply_in(line);
  if (const auto* failed = std::get_if<NotStarted>(&reply)) {
    end();
    throw support::ResourceError(
        fmt::format("cannot start {}: {}", program_, support::described_with_limit(failed->error)));
  }
  if (const auto* exhausted = std::get_if<OutOfResources>(&reply)) {
    end();
    throw support::ResourceError(fmt::format("{}: {}", program_, exhausted->what));
  }
  if (const auto* broken = std::get_if<Broken>(&reply)) {
    end();
    throw WorkerFailure("crashed:" + broken->why);
  }
  replied_ = true;
  return reply;
}

}  // namespace touchmark::bench::workers
