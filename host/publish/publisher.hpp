// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/publish/health.hpp"
#include "host/publish/message_sink.hpp"

namespace pharos {
class bearings_t;
class clock_exchange_t;
class pointing_t;
class pose_t;
class preview_t;
class spin_t;
class status_t;
class target_state_t;
}  // namespace pharos

namespace pharos::host {

/// Messages sent, by kind.
struct PublishCounters {
  std::int64_t poses = 0;
  std::int64_t bearings = 0;
  std::int64_t pointings = 0;
  std::int64_t spins = 0;
  std::int64_t states = 0;
  std::int64_t status = 0;
  std::int64_t clock = 0;  // questions and answers
  std::int64_t previews = 0;
  std::int64_t bytes = 0;
  std::int64_t failed = 0;  // messages that the sink could not send

  std::int64_t& of(const pose_t&) { return poses; }
  std::int64_t& of(const bearings_t&) { return bearings; }
  std::int64_t& of(const pointing_t&) { return pointings; }
  std::int64_t& of(const spin_t&) { return spins; }
  std::int64_t& of(const target_state_t&) { return states; }
  std::int64_t& of(const status_t&) { return status; }
  std::int64_t& of(const preview_t&) { return previews; }
};

/// Sends LCM messages at once and counts them. Measurements go through a PublishGate.
class Publisher {
 public:
  /// `sink` must outlive this. Channels are `prefix` + LIGHTHOUSE_POSE, …
  Publisher(MessageSink& sink, std::string prefix);

  /// status_t.
  bool publish_health(const DaemonHealth& health);
  /// On `channel` as it is, without the prefix.
  bool publish_clock(const std::string& channel, const clock_exchange_t& message);
  /// A picture for people: no measurement, so that no gate checks it.
  bool publish_preview(const preview_t& message);

  /// Gets every pose after it was sent (or could not be), with its channel behind the prefix.
  using PoseListener = std::function<void(const char* channel, const pose_t& message)>;
  void set_pose_listener(PoseListener listener) { pose_listener_ = std::move(listener); }
  /// Gives the listener a pose of another daemon, which is not sent again; with an empty channel.
  void hand_over(const pose_t& message) const { announce("", message); }

  const PublishCounters& counters() const { return counters_; }

 private:
  friend class PublishGate;

  template <class Message>
  bool send(const char* channel, const Message& message) {
    channel_ = prefix_;
    channel_ += channel;
    const bool sent = send_buffer(encode(message), counters_.of(message));
    announce(channel, message);
    return sent;
  }
  template <class Message>
  bool encode(const Message& message) {
    const int size = message.getEncodedSize();
    buffer_.resize(static_cast<std::size_t>(size));
    return message.encode(buffer_.data(), 0, size) == size;
  }
  template <class Message>
  void announce(const char*, const Message&) const {}
  void announce(const char* channel, const pose_t& message) const {
    if (pose_listener_) pose_listener_(channel, message);
  }
  // To channel_.
  bool send_buffer(bool encoded, std::int64_t& count);

  MessageSink& sink_;
  std::string prefix_;
  std::string channel_;
  PoseListener pose_listener_;
  std::vector<std::uint8_t> buffer_;
  std::int64_t status_sequence_ = 0;
  PublishCounters counters_;
};

}  // namespace pharos::host
