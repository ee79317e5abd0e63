// SPDX-License-Identifier: Apache-2.0
#include "host/receive/message_values.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "pharos/clock_exchange_t.hpp"
#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/spin_t.hpp"
#include "pharos/status_t.hpp"
#include "pharos/target_state_t.hpp"

namespace pharos::host {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

pose_t a_pose() {
  pose_t message{};
  message.valid = 1;
  message.orientation_wxyz[0] = 1.0;
  message.covariance[0] = message.covariance[35] = 1e-6;
  return message;
}

target_state_t a_state() {
  target_state_t message{};
  message.valid = 1;
  message.orientation_wxyz[2] = -1.0;
  message.sources.resize(1);
  message.source_count = 1;
  return message;
}

template <class Message>
void expect_impossible(const Message& sound, const std::vector<std::function<void(Message&)>>& damages) {
  EXPECT_TRUE(is_possible(sound));
  for (std::size_t k = 0; k < damages.size(); ++k) {
    Message message = sound;
    damages[k](message);
    EXPECT_FALSE(is_possible(message)) << "damage " << k;
  }
}

TEST(MessageValues, OfAPoseAreFiniteWithAUnitQuaternionAndVariances) {
  expect_impossible<pose_t>(a_pose(), {
                                          [](pose_t& m) { m.position_m[1] = kNan; },
                                          [](pose_t& m) { m.position_m[2] = -kInf; },
                                          [](pose_t& m) { m.position_m[0] = 1e30; },
                                          [](pose_t& m) { m.orientation_wxyz[0] = 0.0; },
                                          [](pose_t& m) { m.orientation_wxyz[3] = 0.2; },
                                          [](pose_t& m) { m.covariance[7] = -1e-9; },
                                          [](pose_t& m) { m.covariance[1] = kNan; },
                                          [](pose_t& m) { m.sigma_pos_m = -1.0; },
                                          [](pose_t& m) { m.sigma_rot_rad = kNan; },
                                          [](pose_t& m) { m.residual_rms_rad = kInf; },
                                          [](pose_t& m) { m.has_second = 1; },  // a quaternion of zeros
                                          [](pose_t& m) {
                                            m.has_second = 1;
                                            m.second_orientation_wxyz[0] = 1.0;
                                            m.second_delta_chi2 = kNan;
                                          },
                                          [](pose_t& m) { m.utime = -1; },
                                          [](pose_t& m) { m.utime = std::numeric_limits<std::int64_t>::max(); },
                                          [](pose_t& m) { m.sequence = -1; },
                                          [](pose_t& m) { m.source = std::string(1000, 'x'); },
                                      });
}

TEST(MessageValues, OfARefusalAreNotLookedAt) {
  pose_t message = a_pose();
  message.valid = 0;
  message.orientation_wxyz[0] = kNan;
  EXPECT_TRUE(is_possible(message));
}

TEST(MessageValues, OfAStateAreThoseOfAPoseWithRates) {
  expect_impossible<target_state_t>(a_state(), {
                                                   [](target_state_t& m) { m.position_m[0] = kNan; },
                                                   [](target_state_t& m) { m.velocity_m_s[0] = kInf; },
                                                   [](target_state_t& m) { m.angular_rate_rad_s[2] = kNan; },
                                                   [](target_state_t& m) { m.covariance[13 * 11] = -1.0; },
                                                   [](target_state_t& m) { m.position_protection_m = kNan; },
                                                   [](target_state_t& m) { m.sources[0].normalised_innovation = kNan; },
                                               });
}

TEST(MessageValues, OfTheOtherTypes) {
  pointing_t pointing{};
  pointing.valid = 1;
  expect_impossible<pointing_t>(
      pointing, {[](pointing_t& m) { m.axis_station[0] = kNan; }, [](pointing_t& m) { m.sigma_axis_rad = -1.0; }});
  spin_t spin{};
  spin.valid = 1;
  expect_impossible<spin_t>(spin,
                            {[](spin_t& m) { m.rate_rad_s[1] = kInf; }, [](spin_t& m) { m.sigma_rate_rad_s = kNan; }});
  status_t status{};
  status.sources.resize(1);
  status.source_count = 1;
  expect_impossible<status_t>(
      status, {[](status_t& m) { m.utime = -5; }, [](status_t& m) { m.sources[0].pose_rate_hz = kNan; }});
  clock_exchange_t clock{};
  clock.is_answer = 1;
  expect_impossible<clock_exchange_t>(clock, {[](clock_exchange_t& m) { m.answered_ns = -1'000'000; },
                                              [](clock_exchange_t& m) { m.sender = std::string(1000, 'x'); }});
}

}  // namespace
}  // namespace pharos::host
