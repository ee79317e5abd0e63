// SPDX-License-Identifier: Apache-2.0
#include "host/camera_link/camera_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>

#include "host/camera_link/camera_message.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

using std::chrono::milliseconds;

void require(int error, const char* what) {
  if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

/// A duplicate above all descriptor numbers that the child uses, so that none is overwritten before it is copied.
UniqueFd moved_up(int fd) {
  UniqueFd moved(::fcntl(fd, F_DUPFD_CLOEXEC, kCameraMemoryFd + 1));
  require(moved.valid() ? 0 : errno, "fcntl F_DUPFD_CLOEXEC");
  return moved;
}

/// Owner of posix_spawn's file actions and attributes.
struct SpawnPlan {
  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
  SpawnPlan() {
    require(::posix_spawn_file_actions_init(&actions), "posix_spawn_file_actions_init");
    require(::posix_spawnattr_init(&attributes), "posix_spawnattr_init");
  }
  ~SpawnPlan() {
    ::posix_spawn_file_actions_destroy(&actions);
    ::posix_spawnattr_destroy(&attributes);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
};

void plan_files(posix_spawn_file_actions_t& actions, int socket, int memory) {
  require(::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDWR, 0), "addopen");
  require(::posix_spawn_file_actions_adddup2(&actions, STDIN_FILENO, STDOUT_FILENO), "adddup2");
  require(::posix_spawn_file_actions_adddup2(&actions, STDIN_FILENO, STDERR_FILENO), "adddup2");
  require(::posix_spawn_file_actions_adddup2(&actions, socket, kCameraSocketFd), "adddup2");
  require(::posix_spawn_file_actions_adddup2(&actions, memory, kCameraMemoryFd), "adddup2");
  // The child must not inherit serial ports, recordings and other cameras' memory.
  require(::posix_spawn_file_actions_addclosefrom_np(&actions, kCameraMemoryFd + 1), "addclosefrom");
}

// The child has its own process group, so that Ctrl-C goes to the daemon only, which then ends the child in order. The
// daemon's signal mask is not inherited.
void plan_signals(posix_spawnattr_t& attributes) {
  sigset_t none;
  sigset_t all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  require(::posix_spawnattr_setsigmask(&attributes, &none), "setsigmask");
  require(::posix_spawnattr_setsigdefault(&attributes, &all), "setsigdefault");
  require(::posix_spawnattr_setpgroup(&attributes, 0), "setpgroup");
  require(
      ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP),
      "setflags");
}

}  // namespace

std::string camera_program() {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  constexpr const char* kName = "pharos-camera";
  for (const fs::path& place : {folder, folder.parent_path() / "libexec" / "pharos", folder.parent_path() / "bin"}) {
    if (::access((place / kName).c_str(), X_OK) == 0) return (place / kName).string();
  }
  throw InputError(std::string(kName) + " is neither in " + folder.string() + " nor in " +
                   (folder.parent_path() / "libexec" / "pharos").string() +
                   ": a camera on the network needs it; install all of Pharos");
}

CameraProcess::CameraProcess(const std::string& program, int memory_fd) {
  std::array<int, 2> ends{};
  require(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()) == 0 ? 0 : errno,
          "socketpair");
  socket_.reset(ends[0]);
  const UniqueFd far_end(ends[1]);
  const UniqueFd socket = moved_up(far_end.get());
  const UniqueFd memory = moved_up(memory_fd);
  SpawnPlan plan;
  plan_files(plan.actions, socket.get(), memory.get());
  plan_signals(plan.attributes);
  const std::array<char*, 2> arguments{const_cast<char*>(program.c_str()), nullptr};
  const char* const folder = ::getenv("TMPDIR");
  std::string temporary = std::string("TMPDIR=") + (folder == nullptr ? "/tmp" : folder);
  const std::array<char*, 2> environment{temporary.data(), nullptr};
  require(::posix_spawn(&pid_, program.c_str(), &plan.actions, &plan.attributes, arguments.data(), environment.data()),
          program.c_str());
}

CameraProcess::~CameraProcess() {
  socket_.reset();
  if (reaped(kPatience)) return;
  ::kill(pid_, SIGKILL);
  reaped(kPatience);
}

bool CameraProcess::send(std::span<const std::uint8_t> bytes) const {
  return ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
}

std::optional<std::vector<std::uint8_t>> CameraProcess::receive(bool& ended) const {
  std::array<std::uint8_t, kMaxCameraMessage_bytes + 1> buffer{};  // one byte more, to detect longer messages
  const ssize_t count = ::recv(socket_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (count > 0) return std::vector<std::uint8_t>(buffer.begin(), buffer.begin() + count);
  ended = count == 0 || (errno != EAGAIN && errno != EINTR);
  return std::nullopt;
}

bool CameraProcess::reaped(milliseconds patience) {
  constexpr milliseconds kSlice{5};
  for (milliseconds waited{0}; !reaped_; waited += kSlice) {
    const pid_t answer = ::waitpid(pid_, &wait_status_, WNOHANG);
    reaped_ = answer == pid_ || (answer < 0 && errno != EINTR);
    if (reaped_ || waited >= patience) break;
    std::this_thread::sleep_for(kSlice);
  }
  return reaped_;
}

std::string CameraProcess::kill_and_describe() {
  constexpr milliseconds kUsualEnd{20};  // time to exit after its socket closed, so that its own exit code is reported
  if (!reaped(kUsualEnd)) ::kill(pid_, SIGKILL);
  if (!reaped(kPatience)) return "no signal reaches it";
  if (WIFEXITED(wait_status_)) return "exit code " + std::to_string(WEXITSTATUS(wait_status_));
  const int signal = WTERMSIG(wait_status_);
  return "signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
}

}  // namespace pharos::host
