// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/camera/camera_play.hpp"

#include <csignal>
#include <ctime>
#include <optional>

#include "host/runtime/now.hpp"
#include "tools/sim/camera/fake_helios.hpp"

namespace pharos::sim {
namespace {

constexpr double kNsPerSecond = 1e9;
constexpr long kLook_ns = 20'000'000;  // how often the camera's life is looked at

/// True once SIGINT or SIGTERM has come; waits a moment for one.
bool told_to_stop() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  const timespec wait{0, kLook_ns};
  return ::sigtimedwait(&signals, nullptr, &wait) > 0;
}

bool dead(const CameraPlay& play, double time_s) {
  for (const Outage& death : play.deaths) {
    if (death.holds(time_s)) return true;
  }
  return false;
}

}  // namespace

CameraPlaySummary serve_camera(const FrameSequence& sequence, const CameraPlay& play,
                               const std::function<void()>& ready) {
  std::optional<TruthRows> truth;
  if (!play.truth_file.empty()) truth.emplace(play.truth_file);
  const std::int64_t began_ns = host::monotonic_now_ns();
  std::optional<FakeHelios> camera;
  CameraPlaySummary summary;
  bool told_ready = false;
  do {
    summary.played_s = static_cast<double>(host::monotonic_now_ns() - began_ns) / kNsPerSecond;
    if (play.duration_s > 0.0 && summary.played_s >= play.duration_s) break;
    const bool is_dead = dead(play, summary.played_s);
    if (camera && is_dead) {
      summary.frames += camera->frames();
      camera.reset();
    } else if (!camera && !is_dead) {
      camera.emplace(sequence, play, truth ? &*truth : nullptr, began_ns);
    }
    if (!told_ready) ready();
    told_ready = true;
  } while (!told_to_stop());
  if (camera) summary.frames += camera->frames();
  return summary;
}

}  // namespace pharos::sim
