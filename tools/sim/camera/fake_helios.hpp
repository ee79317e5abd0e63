// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "tools/sim/camera/camera_play.hpp"
#include "tools/sim/camera/truth_rows.hpp"

namespace pharos::sim {

/// A Helios on the network while this lives: answers GigE Vision's control channel and streams the reel to who controls
/// it. Everything of Aravis is in its .cpp file.
class FakeHelios {
 public:
  /// `reel`, `play` and `truth` (may be null) must outlive this. `began_ns`: monotonic time that intervals count from.
  /// Throws host::InputError where the address cannot be had.
  FakeHelios(const FrameSequence& sequence, const CameraPlay& play, TruthRows* truth, std::int64_t began_ns);
  ~FakeHelios();

  /// Frames sent so far.
  std::uint64_t frames() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pharos::sim
