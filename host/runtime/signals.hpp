// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <optional>
#include <vector>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// Signals as a descriptor (signalfd) for the event loop: during the lifetime of this object they are queued and
/// interrupt nothing.
class Signals {
 public:
  /// Blocks `signals` for the calling thread and those it starts later. Throws std::system_error.
  explicit Signals(std::initializer_list<int> signals);
  int fd() const { return fd_.get(); }
  /// The next pending signal, if any: of several the one that was named first, so that no number of later ones holds it
  /// up.
  std::optional<int> take();

 private:
  UniqueFd fd_;                    // readable when any is pending
  std::vector<UniqueFd> each_fd_;  // one a signal, as named
};

}  // namespace pharos::host
