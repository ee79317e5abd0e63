// SPDX-License-Identifier: Apache-2.0
#include "integration/child_process.hpp"

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

namespace pharos::host {
namespace {

constexpr int kSlice_ms = 20;

std::int64_t deadline_ns(double seconds) { return monotonic_now_ns() + static_cast<std::int64_t>(seconds * 1e9); }

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, unsigned long file_size_limit) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe2");
  output_.reset(ends[0]);
  UniqueFd child_end(ends[1]);
  ::fcntl(output_.get(), F_SETFL, O_NONBLOCK);
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_ = ::fork();
  if (pid_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (pid_ > 0) return;
  ::dup2(child_end.get(), STDOUT_FILENO);
  ::dup2(child_end.get(), STDERR_FILENO);
  if (file_size_limit != 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{file_size_limit, file_size_limit};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

ChildProcess::~ChildProcess() {
  if (exit_code_ >= 0) return;
  signal(SIGKILL);
  wait_exit();
}

void ChildProcess::read_available(int timeout_ms) {
  pollfd ready{output_.get(), POLLIN, 0};
  ::poll(&ready, 1, timeout_ms);
  std::array<char, 4096> buffer{};
  for (ssize_t count = 0; (count = ::read(output_.get(), buffer.data(), buffer.size())) > 0;) {
    text_.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

const std::string& ChildProcess::text() {
  read_available(0);
  return text_;
}

bool ChildProcess::wait_for(const std::string& words, double seconds) {
  const std::int64_t deadline = deadline_ns(seconds);
  while (text().find(words) == std::string::npos) {
    if (monotonic_now_ns() > deadline) return false;
    if (wait_exit(0.0) >= 0) return text().find(words) != std::string::npos;
    read_available(kSlice_ms);
  }
  return true;
}

void ChildProcess::signal(int number) const {
  if (exit_code_ < 0) ::kill(pid_, number);
}

bool ChildProcess::has_ended() {
  int status = 0;
  if (exit_code_ >= 0) return true;
  if (::waitpid(pid_, &status, WNOHANG) != pid_) return false;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return true;
}

int ChildProcess::wait_exit_unread(double seconds) {
  const std::int64_t deadline = deadline_ns(seconds);
  while (!has_ended()) {
    if (monotonic_now_ns() > deadline) return -1;
    ::poll(nullptr, 0, kSlice_ms);
  }
  return exit_code_;
}

int ChildProcess::wait_exit(double seconds) {
  const std::int64_t deadline = deadline_ns(seconds);
  while (!has_ended()) {
    if (monotonic_now_ns() > deadline) return -1;
    read_available(seconds > 0.0 ? kSlice_ms : 0);
  }
  read_available(0);
  return exit_code_;
}

bool ChildProcess::fill_standard_error() const {
  const std::string path = "/proc/" + std::to_string(pid_) + "/fd/2";
  const UniqueFd end(::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
  if (!end.valid()) return false;
  const std::string bytes(4096, '-');
  while (::write(end.get(), bytes.data(), bytes.size()) > 0) {
  }
  while (::write(end.get(), bytes.data(), 1) > 0) {
  }
  return true;
}

}  // namespace pharos::host
