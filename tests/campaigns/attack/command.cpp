// SPDX-License-Identifier: Apache-2.0
#include "campaigns/attack/command.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "host/runtime/now.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {
namespace {

[[noreturn]] void become(const std::vector<std::string>& arguments, int output) {
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

}  // namespace

CommandResult run_command(const std::vector<std::string>& arguments, double seconds) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe2");
  const UniqueFd read_end(ends[0]);
  UniqueFd write_end(ends[1]);
  const pid_t process = ::fork();
  if (process < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (process == 0) become(arguments, write_end.get());
  write_end.reset();
  CommandResult result;
  const std::int64_t end_ns = monotonic_now_ns() + static_cast<std::int64_t>(seconds * 1e9);
  std::array<char, 4096> buffer{};
  for (bool open = true; open;) {
    const std::int64_t left_ms = (end_ns - monotonic_now_ns()) / 1'000'000;
    pollfd ready{read_end.get(), POLLIN, 0};
    if (left_ms <= 0 || ::poll(&ready, 1, static_cast<int>(left_ms)) <= 0) break;
    const ssize_t count = ::read(read_end.get(), buffer.data(), buffer.size());
    open = count > 0;
    if (open) result.text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  if (monotonic_now_ns() >= end_ns) ::kill(process, SIGKILL);
  int status = 0;
  rusage usage{};
  if (::wait4(process, &status, 0, &usage) != process) return result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.peak_mib = static_cast<double>(usage.ru_maxrss) / 1024.0;
  return result;
}

}  // namespace pharos::host
