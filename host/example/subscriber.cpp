// SPDX-License-Identifier: Apache-2.0
// A program of your own that follows a target: copy this file and begin here. Build it against installed Pharos with
//   g++ -std=c++17 subscriber.cpp -I/usr/include/pharos_lcm -llcm -o subscriber
// (types: lcm-gen -x --cpp-std c++11 --cpp-hpath DIR /usr/share/pharos/lcm/*.lcm makes them anew).
#include <chrono>
#include <cmath>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "pharos/pose_t.hpp"
#include "pharos/status_t.hpp"

namespace {

constexpr double kMmPerM = 1000.0;
constexpr double kDegPerRad = 57.29577951308232;
// Older than this is no basis for steering; pick your own.
constexpr double kTooOld_s = 0.5;

// Flags of a pose that holds but is no basis for steering: a station whose own errors are unknown yet, a target whose
// data contradict themselves, times that may have gone back. The stated sigmas say the first too; see README.
constexpr const char* kNotForSteering[] = {"uncalibrated", "suspect", "clock_set"};

// Whether `word` is one of the flags, which are words joined by '|'.
bool has_flag(const std::string& flags, const std::string& word) {
  return ('|' + flags + '|').find('|' + word + '|') != std::string::npos;
}

double seconds_since(std::int64_t utime) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<double>(std::chrono::duration_cast<std::chrono::microseconds>(now).count() - utime) * 1e-6;
}

// Whether it is a pose: anyone who can reach LCM can send numbers that are not finite, or no rotation.
bool is_pose(const pharos::pose_t& pose) {
  double sum = 0.0;
  for (const double value : pose.position_m) sum += value;
  for (const double value : pose.covariance) sum += value;
  const double* q = pose.orientation_wxyz;
  const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  return std::isfinite(sum) && std::abs(norm - 1.0) < 1e-3;
}

class Subscriber {
 public:
  void on_pose(const lcm::ReceiveBuffer*, const std::string&, const pharos::pose_t* pose) {
    if (pose->valid == 0) {  // a refused cycle: status says why, the pose is all zero
      std::printf("%s: %s\n", pose->target.c_str(), pose->status.c_str());
      return;
    }
    if (!is_pose(*pose)) {
      std::printf("%s: a message that no pharosd sends\n", pose->target.c_str());
      return;
    }
    if (seconds_since(pose->utime) > kTooOld_s) return;  // the network held it back
    bool steer = pose->status == "ok";                   // not "ambiguous": a second pose fits nearly as well
    for (const char* word : kNotForSteering) steer = steer && !has_flag(pose->flags, word);
    const double* t = pose->position_m;
    std::printf("%s: %.1f mm away (sigma %.1f mm, %.2f deg) %s%s%s%s\n", pose->target.c_str(),
                kMmPerM * std::hypot(t[0], t[1], t[2]), kMmPerM * pose->sigma_pos_m, kDegPerRad * pose->sigma_rot_rad,
                pose->status.c_str(), pose->flags.empty() ? "" : " ", pose->flags.c_str(),
                steer ? "" : ", NOT for steering");
  }

  void on_status(const lcm::ReceiveBuffer*, const std::string&, const pharos::status_t* status) {
    if (status->state != "ok") std::printf("pharosd: %s: %s\n", status->state.c_str(), status->message.c_str());
    for (const pharos::source_status_t& source : status->sources) {
      if (source.state != "ok") {
        std::printf("%s: %s: %s\n", source.source.c_str(), source.state.c_str(), source.message.c_str());
      }
    }
  }
};

}  // namespace

int main() {
  lcm::LCM lcm("udpm://239.255.76.67:7667?ttl=0");  // as `url` in pharosd.toml
  if (!lcm.good()) return 1;
  Subscriber subscriber;
  lcm.subscribe("PHAROS_LIGHTHOUSE_POSE", &Subscriber::on_pose, &subscriber);
  lcm.subscribe("PHAROS_STATUS", &Subscriber::on_status, &subscriber);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  while (lcm.handle() == 0) {
  }
  return 1;
}
