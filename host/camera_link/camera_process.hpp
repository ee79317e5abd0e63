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

/// Descriptor numbers in the camera's process: its end of the socket, and the memory for frames.
inline constexpr int kCameraSocketFd = 3;
inline constexpr int kCameraMemoryFd = 4;

/// Path of pharos-camera: beside this program, in ../libexec/pharos when installed, or in ../bin for the tests of a
/// build tree. PATH is not searched. Throws InputError with the path that is missing.
std::string camera_program();

/// A running pharos-camera and the socket to it. The process ends with this object, and by PR_SET_PDEATHSIG with the
/// thread that started it.
class CameraProcess {
 public:
  /// Starts `program` with the shared memory and an environment that holds TMPDIR only. Standard output and error are
  /// /dev/null, so that a blocked reader cannot block the process. Throws std::system_error.
  CameraProcess(const std::string& program, int memory_fd);
  /// Closes the socket; the process then releases the camera and exits. It is killed after kPatience.
  ~CameraProcess();
  CameraProcess(const CameraProcess&) = delete;
  CameraProcess& operator=(const CameraProcess&) = delete;

  static constexpr std::chrono::milliseconds kPatience{400};

  pid_t pid() const { return pid_; }
  /// Readable when a message can be received or the process has ended.
  int fd() const { return socket_.get(); }
  bool send(std::span<const std::uint8_t> bytes) const;
  /// The next message; empty if none is pending. `ended` becomes true when no further message can come.
  std::optional<std::vector<std::uint8_t>> receive(bool& ended) const;
  /// Ends the process at once and returns a readable cause: "signal 9 (Killed)", "exit code 2".
  std::string kill_and_describe();

 private:
  bool reaped(std::chrono::milliseconds patience);

  pid_t pid_ = -1;
  UniqueFd socket_;
  int wait_status_ = 0;
  bool reaped_ = false;
};

}  // namespace pharos::host
