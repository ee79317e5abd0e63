// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/directory_watch.hpp"

#include <sys/inotify.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace pharos::host {

DirectoryWatch::DirectoryWatch(std::filesystem::path directory)
    : directory_(std::move(directory)), inotify_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
  if (!inotify_.valid()) throw std::system_error(errno, std::generic_category(), "inotify");
  attend();
}

void DirectoryWatch::attend() {
  if (watching()) return;
  watch_ = ::inotify_add_watch(inotify_.get(), directory_.c_str(),
                               IN_CLOSE_WRITE | IN_MOVED_TO | IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR);
  error_ = watching() ? "" : directory_.string() + ": cannot be watched: " + std::strerror(errno);
}

std::vector<std::string> DirectoryWatch::take() {
  std::vector<std::string> names;
  alignas(inotify_event) std::array<char, 16384> buffer;
  ssize_t size = 0;
  while ((size = ::read(inotify_.get(), buffer.data(), buffer.size())) > 0) {
    for (ssize_t at = 0; at < size;) {
      inotify_event event{};
      std::memcpy(&event, buffer.data() + at, sizeof event);
      const char* name = buffer.data() + at + sizeof event;
      at += static_cast<ssize_t>(sizeof event + event.len);
      if ((event.mask & IN_Q_OVERFLOW) != 0) ++overflows_;
      if (event.wd != watch_) continue;
      if ((event.mask & (IN_CLOSE_WRITE | IN_MOVED_TO)) != 0 && event.len > 0 && (event.mask & IN_ISDIR) == 0 &&
          name[0] != '.') {
        names.emplace_back(name);
      }
      if ((event.mask & IN_MOVE_SELF) != 0) ::inotify_rm_watch(inotify_.get(), watch_);
      if ((event.mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED)) != 0) {
        watch_ = -1;
        error_ = directory_.string() + ": is gone";
      }
    }
  }
  return names;
}

}  // namespace pharos::host
