// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// What the camera's process finds where: its end of the socket, and the memory for frames.
inline constexpr int kCameraSocketFd = 3;
inline constexpr int kCameraMemoryFd = 4;

/// Where pharos-camera is: beside this program, in ../libexec/pharos where it is installed, or in ../bin for the tests
/// of a build tree; never looked for in PATH. Throws InputError saying what is missing.
std::string camera_program();

/// A running pharos-camera and the socket to it. Ends with this object, and by PR_SET_PDEATHSIG with the thread that
/// started it.
class CameraProcess {
 public:
  /// Starts `program` with the shared memory and an empty environment but for TMPDIR; standard output and error go
  /// nowhere (a reader that hangs must not hold a camera up). Throws std::system_error.
  CameraProcess(const std::string& program, int memory_fd);
  /// Closes the socket, upon which the process gives the camera back and ends; after kPatience it is killed.
  ~CameraProcess();
  CameraProcess(const CameraProcess&) = delete;
  CameraProcess& operator=(const CameraProcess&) = delete;

  static constexpr std::chrono::milliseconds kPatience{400};

  pid_t pid() const { return pid_; }
  /// Readable when there is something to receive(), or it has ended.
  int fd() const { return socket_.get(); }
  bool send(std::span<const std::uint8_t> bytes) const;
  /// The next message; empty where none waits. `ended` becomes true where none will come any more.
  std::optional<std::vector<std::uint8_t>> receive(bool& ended) const;
  /// Ends it at once and says how it ended, for people: "signal 9 (Killed)", "exit code 2".
  std::string kill_and_describe();

 private:
  bool reaped(std::chrono::milliseconds patience);

  pid_t pid_ = -1;
  UniqueFd socket_;
  int wait_status_ = 0;
  bool reaped_ = false;
};

}  // namespace pharos::host
