// SPDX-License-Identifier: Apache-2.0
// Ten minutes (PHAROS_CAMERA_SECONDS: another time) of a camera at full rate with an approaching satellite. Every frame
// that the camera sent must be in the counters; rates and latencies are printed, not checked.
#include <cstdio>
#include <cstdlib>

#include "integration/camera/pharosd_tof_fixture.hpp"

namespace pharos::host {
namespace {

const ::testing::Environment* const kNetwork = ::testing::AddGlobalTestEnvironment(new NetworkNamespace);

class PharosdTofCampaign : public PharosdTofTest {
 protected:
  std::int64_t of_camera(const char* name) { return daemon.counter(name, "client"); }
  std::int64_t arrived() {
    return of_camera("device.frames_received") + of_camera("device.frames_incomplete") +
           of_camera("device.frames_missing") + of_camera("device.frames_wrong_size");
  }
  std::int64_t answered() {
    std::int64_t sum = 0;
    for (const char* name : {"frames_ok", "frames_ambiguous", "frames_refused", "frames_stale", "frames_no_clock",
                             "frames_time_back", "frames_wrong_size", "frames_not_finite"}) {
      sum += of_camera(name);
    }
    return sum;
  }
  std::int64_t of_daemon(const char* name) const {
    for (const counter_t& counter : daemon.status()->counters) {
      if (counter.name == name) return counter.value;
    }
    return -1;
  }
};

TEST_F(PharosdTofCampaign, LosesNoFrameSilently) {
  const char* asked = std::getenv("PHAROS_CAMERA_SECONDS");
  const double seconds = asked == nullptr ? 600.0 : std::atof(asked);
  render("tof_approach.toml", 60);
  serve();
  start(kByAddress);
  daemon.wait([] { return false; }, seconds);
  const std::int64_t sent = static_cast<std::int64_t>(camera->frames());
  camera.reset();
  ASSERT_TRUE(daemon.wait([&] { return daemon.source("client")->state != "ok"; }, kTimeout_s));
  // The frame in transmission when the camera was removed was sent in part, if at all.
  constexpr std::int64_t kInTheAir = 2;
  EXPECT_GE(arrived(), sent - kInTheAir);
  EXPECT_LE(arrived(), static_cast<std::int64_t>(sent + kInTheAir));
  EXPECT_EQ(answered(), of_camera("device.frames_received") - of_camera("device.frames_dropped"));
  EXPECT_GT(of_camera("frames_ok"), 0);
  std::printf(
      "%.0f s: %lld frames sent, %lld whole, %lld incomplete, %lld missing, %lld dropped, %lld stale, %lld refused, "
      "%lld poses (%.2f/s)\n",
      seconds, static_cast<long long>(sent), static_cast<long long>(of_camera("device.frames_received")),
      static_cast<long long>(of_camera("device.frames_incomplete")),
      static_cast<long long>(of_camera("device.frames_missing")),
      static_cast<long long>(of_camera("device.frames_dropped")), static_cast<long long>(of_camera("frames_stale")),
      static_cast<long long>(of_camera("frames_refused")), static_cast<long long>(of_camera("frames_ok")),
      static_cast<double>(of_camera("frames_ok")) / seconds);
  for (const char* stage : {"transport", "waiting", "estimator", "latency"}) {
    std::printf("%-9s p50 %6.1f ms, p99 %6.1f ms\n", stage,
                static_cast<double>(of_camera((std::string(stage) + "_p50_us").c_str())) * 1e-3,
                static_cast<double>(of_camera((std::string(stage) + "_p99_us").c_str())) * 1e-3);
  }
  std::printf("pharosd: %.1f %% of one core, %lld KiB\n",
              static_cast<double>(of_daemon("process_cpu_us")) * 1e-4 / seconds,
              static_cast<long long>(of_daemon("process_resident_kib")));
}

}  // namespace
}  // namespace pharos::host
