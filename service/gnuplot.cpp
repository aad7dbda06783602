#include "gridcull/service/gnuplot.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <string_view>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gridcull/core/error.h"

extern char** environ;

namespace gridcull {
namespace {

/// The first line of what came through a pipe; the rest is read and left.
std::string first_line(int from) {
  std::string text;
  std::array<char, 512> buffer{};
  for (ssize_t count = 0; (count = read(from, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  const std::size_t begin = text.find_first_not_of(" \n");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

std::string find_gnuplot() {
  const char* path = std::getenv("PATH");
  std::string_view rest = path == nullptr ? "" : path;
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const std::string candidate = std::string(rest.substr(0, colon)) + "/gnuplot";
    if (access(candidate.c_str(), X_OK) == 0) return candidate;
    rest = colon == std::string_view::npos ? "" : rest.substr(colon + 1);
  }
  return {};
}

void run_gnuplot(const std::string& gnuplot, const std::string& script, const std::string& arg1,
                 const std::string& arg2) {
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) throw Error(ErrorCode::io, gnuplot + ": no pipe to hear it by");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
  std::string flag = "-c", program = gnuplot, file = script, one = arg1, two = arg2;
  std::array<char*, 6> arguments{program.data(), flag.data(), file.data(), one.data(), two.data(), nullptr};
  pid_t child = 0;
  const int fault = posix_spawn(&child, gnuplot.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  const std::string said = fault == 0 ? first_line(pipe_ends[0]) : std::string();
  close(pipe_ends[0]);
  int status = 0;
  if (fault == 0) {
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  }
  if (fault != 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw Error(ErrorCode::io, gnuplot + ": could not draw " + script + (said.empty() ? "" : ": " + said));
  }
}

}  // namespace gridcull
