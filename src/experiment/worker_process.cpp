#include "experiment/worker_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "nbvopt/core/error.hpp"

namespace nbvopt::experiment {
namespace {

std::pair<Descriptor, Descriptor> make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "no pipe to a worker");
  }
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

}  // namespace

WorkerProcess::WorkerProcess(const std::vector<std::string>& command, const sigset_t& signals) {
  auto [their_in, our_out] = make_pipe();
  auto [our_in, their_out] = make_pipe();
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, their_in.get(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, their_out.get(), STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setsigmask(&attributes, &signals);
  const int error =
      ::posix_spawnp(&pid_, argv.front(), &files, &attributes, argv.data(), ::environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) {
    throw InputError(command.front() +
                     ": cannot be started: " + std::generic_category().message(error));
  }
  to_ = std::move(our_out);
  from_ = std::move(our_in);
  lines_ = LineReader(from_.get());
}

WorkerProcess::~WorkerProcess() {
  if (!has_ended_) end();
}

void WorkerProcess::send(const std::string& line) {
  try {
    write_line(to_.get(), line);
  } catch (const std::system_error&) {
    // It has ended.
  }
}

std::string WorkerProcess::end() {
  // One that is on its way out by itself keeps the status that it has.
  ::kill(-pid_, SIGKILL);
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  has_ended_ = true;
  if (WIFSIGNALED(status)) return ::strsignal(WTERMSIG(status));
  return "exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace nbvopt::experiment
