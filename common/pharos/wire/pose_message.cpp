// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/pose_message.hpp"

#include "pharos/base/capacity.hpp"

namespace pharos::wire {
namespace {

// The fields after the head.
constexpr std::uint8_t kHasResult = 1;
constexpr std::uint8_t kHasSecond = 2;

template <class T>
void put_finite(T value, ByteWriter& out) {
  if (!std::isfinite(value)) out.fail();
  out.put(value);
}

void write_fields(const PoseFields& pose, ByteWriter& out) {
  for (const double value : pose.orientation_wxyz) put_finite(value, out);
  for (const double value : pose.position_m) put_finite(value, out);
}

void read_fields(ByteReader& in, PoseFields& pose) {
  for (double& value : pose.orientation_wxyz) value = in.get_finite<double>();
  for (double& value : pose.position_m) value = in.get_finite<double>();
}

void write_result(const PoseResult& answer, ByteWriter& out) {
  write_fields(answer.pose, out);
  for (const float value : answer.covariance) put_finite(value, out);
  put_finite(answer.residual_rms_rad, out);
  put_finite(answer.adop_deg_per_rad, out);
  put_finite(answer.pdop_m_per_rad, out);
  out.put(answer.iterations);
  if (!answer.second) return;
  write_fields(answer.second->pose, out);
  put_finite(answer.second->delta_chi2, out);
}

void read_result(ByteReader& in, bool has_second, PoseResult& answer) {
  read_fields(in, answer.pose);
  for (float& value : answer.covariance) value = in.get_finite<float>();
  answer.residual_rms_rad = in.get_finite<float>();
  answer.adop_deg_per_rad = in.get_finite<float>();
  answer.pdop_m_per_rad = in.get_finite<float>();
  answer.iterations = in.get<std::uint8_t>();
  if (!has_second) return;
  answer.second.emplace();
  read_fields(in, answer.second->pose);
  answer.second->delta_chi2 = in.get_finite<float>();
}

}  // namespace

void write(const Pose& message, ByteWriter& out) {
  if (message.station >= kMaxStations || message.answer.has_value() != (message.refusal == 0)) out.fail();
  const bool has_second = message.answer && message.answer->second;
  out.put_ticks(message.time_ticks);
  out.put(message.station);
  out.put(message.flags);
  out.put(message.refusal);
  out.put(static_cast<std::uint8_t>((message.answer ? kHasResult : 0) | (has_second ? kHasSecond : 0)));
  out.put(message.observations);
  if (message.answer) write_result(*message.answer, out);
}

void read(ByteReader& in, Pose& message) {
  message.time_ticks = in.get_ticks();
  message.station = in.get<std::uint8_t>();
  message.flags = in.get<std::uint8_t>();
  message.refusal = in.get<std::uint8_t>();
  const auto content = in.get<std::uint8_t>();
  message.observations = in.get<std::uint16_t>();
  const bool has_answer = (content & kHasResult) != 0;
  const bool has_second = (content & kHasSecond) != 0;
  in.refuse_if(message.station >= kMaxStations || content > (kHasResult | kHasSecond) || (has_second && !has_answer) ||
               has_answer != (message.refusal == 0));
  if (has_answer) read_result(in, has_second, message.answer.emplace());
}

}  // namespace pharos::wire
