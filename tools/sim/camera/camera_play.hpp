// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/sim/camera/frame_sequence.hpp"
#include "tools/sim/camera/helios_description.hpp"

namespace pharos::sim {

/// From `at_s` for `for_s` seconds, of the time since the camera came up.
struct Outage {
  double at_s = 0.0;
  double for_s = 0.0;
  bool holds(double time_s) const { return time_s >= at_s && time_s < at_s + for_s; }
};

/// How the simulated camera behaves.
struct CameraPlay {
  std::string address = "127.0.0.1";
  std::string serial = "233300001";
  double frame_rate_hz = 30.0;
  std::string mode = "Distance5000mmMultiFreq";
  bool depth_and_intensity_apart = false;
  /// One of a rig's cameras: Mono8 and Mono16, triggered at the beats of `frame_rate_hz` in UTC, so that several show
  /// the frames of one instant (FrameSequence::at the beat's number).
  bool grey = false;
  /// Depth counts on the wire in the modes up to 3000 mm, which a real camera may give finer than the others.
  double fine_scale_m = 0.0001;
  double scale_m = 0.00025;

  double loss = 0.0;            // share of packets
  std::vector<Outage> stalls;   // no packet goes out; the camera still answers
  std::vector<Outage> deaths;   // no camera is there
  std::vector<Outage> freezes;  // the same picture and the same time again and again

  double clock_start_s = 1000.0;  // what its clock shows at its start
  double clock_ppm = 0.0;         // how much it runs fast
  double clock_jitter_s = 0.0;    // sigma of what its times are off, each on its own
  bool ptp = false;               // it follows UTC once it is told to, if there is a master
  PtpNames ptp_names = PtpNames::kNew;
  bool ptp_refused = false;            // an order to follow PTP is an error
  std::vector<Outage> ptp_masterless;  // no master is on the network: its clock runs on by its own rate

  double duration_s = 0.0;  // 0: until SIGINT or SIGTERM
  std::string truth_file;   // true poses as they are shown; empty: none
};

struct CameraPlaySummary {
  std::uint64_t frames = 0;  // sent, whole or in part
  double played_s = 0.0;
};

/// Serves `reel` until the end. Throws host::InputError where no camera can be had at that address. SIGINT and SIGTERM
/// must be blocked in every thread. `ready` is called once the camera is there (or would be but for a death at 0 s).
CameraPlaySummary serve_camera(const FrameSequence& sequence, const CameraPlay& play,
                               const std::function<void()>& ready);

}  // namespace pharos::sim
