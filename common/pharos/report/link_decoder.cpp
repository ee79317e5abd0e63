// SPDX-License-Identifier: Apache-2.0
#include "pharos/report/link_decoder.hpp"

#include <algorithm>

#include "pharos/report/convert.hpp"
#include "pharos/wire/codec.hpp"

namespace pharos::report {
namespace {

using wire::MessageType;

template <class M>
std::optional<LinkEvent> as_it_is(const wire::Frame& frame) {
  const auto message = wire::decode_payload<M>(frame.payload);
  if (!message) return std::nullopt;
  return LinkEvent(*message);
}

template <class M>
std::optional<LinkEvent> converted(const wire::Frame& frame) {
  const auto message = wire::decode_payload<M>(frame.payload);
  if (!message) return std::nullopt;
  return LinkEvent(from_wire(*message));
}

std::optional<LinkEvent> pose_event(const wire::Frame& frame) {
  const auto message = wire::decode_payload<wire::Pose>(frame.payload);
  if (!message) return std::nullopt;
  const auto report = from_wire(*message);
  if (!report) return std::nullopt;
  return LinkEvent(*report);
}

std::optional<LinkEvent> counters_event(const wire::Frame& frame) {
  const auto message = wire::decode_payload<wire::Counters>(frame.payload);
  if (!message) return std::nullopt;
  switch (message->group) {
    case wire::CounterGroup::kDecoder:
      return LinkEvent(decoder_report(*message));
    case wire::CounterGroup::kDevice:
      return LinkEvent(device_report(*message));
  }
  return std::nullopt;
}

// One overload for each kind of event that has a time.
struct NewestTicks {
  std::optional<std::int64_t> operator()(const lighthouse::Sweep& sweep) const {
    std::int64_t after_half_ticks = 2 * std::int64_t{sweep.flash.length_ticks};
    for (const lighthouse::Hit& hit : sweep.hits) {
      after_half_ticks = std::max(after_half_ticks, std::int64_t{hit.centre_half_ticks} + hit.width_ticks);
    }
    return sweep.flash.start_ticks + after_half_ticks / 2;
  }
  std::optional<std::int64_t> operator()(const lighthouse::OotxPayload& payload) const { return payload.time_ticks; }
  std::optional<std::int64_t> operator()(const lighthouse::Lh2Sweep& sweep) const {
    std::int64_t after_sixths = 0;
    for (const lighthouse::Lh2Hit& hit : sweep.hits)
      after_sixths = std::max(after_sixths, std::int64_t{hit.centre_sixths});
    return (sweep.sync_sixths + after_sixths) / lighthouse::kSixthsPerTick;
  }
  std::optional<std::int64_t> operator()(const Lh2OotxReport& report) const { return report.payload.time_ticks; }
  std::optional<std::int64_t> operator()(const PoseReport& report) const { return report.time_ticks; }
  std::optional<std::int64_t> operator()(const DecoderReport& report) const { return report.time_ticks; }
  std::optional<std::int64_t> operator()(const DeviceReport& report) const { return report.time_ticks; }
  std::optional<std::int64_t> operator()(const EdgesReport& report) const {
    if (report.edges.empty()) return std::nullopt;
    return report.edges.back().stamp_ticks;
  }
  std::optional<std::int64_t> operator()(const wire::Time& message) const { return message.time_ticks; }
  std::optional<std::int64_t> operator()(const wire::Hello& message) const { return message.time_ticks; }
  template <class Other>
  std::optional<std::int64_t> operator()(const Other&) const {
    return std::nullopt;
  }
};

}  // namespace

std::optional<LinkEvent> decode_event(const wire::Frame& frame) {
  switch (frame.type) {
    case MessageType::kSweep:
      return converted<wire::Sweep>(frame);
    case MessageType::kOotx:
      return converted<wire::Ootx>(frame);
    case MessageType::kLh2Sweep:
      return converted<wire::Lh2Sweep>(frame);
    case MessageType::kLh2Ootx:
      return converted<wire::Lh2Ootx>(frame);
    case MessageType::kPose:
      return pose_event(frame);
    case MessageType::kCounters:
      return counters_event(frame);
    case MessageType::kRawEdges:
      return converted<wire::RawEdges>(frame);
    case MessageType::kTime:
      return as_it_is<wire::Time>(frame);
    case MessageType::kHello:
      return as_it_is<wire::Hello>(frame);
    case MessageType::kCommand:
      return as_it_is<wire::Command>(frame);
    case MessageType::kAck:
      return as_it_is<wire::Ack>(frame);
    case MessageType::kNak:
      return as_it_is<wire::Nak>(frame);
    case MessageType::kLoaderQuery:
      return as_it_is<wire::LoaderQuery>(frame);
    case MessageType::kLoaderInfo:
      return as_it_is<wire::LoaderInfo>(frame);
    case MessageType::kLoaderBegin:
      return as_it_is<wire::LoaderBegin>(frame);
    case MessageType::kLoaderData:
      return as_it_is<wire::LoaderData>(frame);
    case MessageType::kLoaderVerify:
      return as_it_is<wire::LoaderVerify>(frame);
    case MessageType::kLoaderStart:
      return as_it_is<wire::LoaderStart>(frame);
  }
  return std::nullopt;
}

std::optional<std::int64_t> newest_ticks(const LinkEvent& event) { return std::visit(NewestTicks{}, event); }

std::optional<LinkEvent> LinkDecoder::push(std::uint8_t byte) {
  const auto frame = frames_.push(byte);
  if (!frame) return std::nullopt;
  auto event = decode_event(*frame);
  if (!event) frames_.count_bad_payload();
  return event;
}

}  // namespace pharos::report
