// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace pharos::host {

/// Whose the messages of one source on one channel are: of one publisher, of its next start, or of two at once. LCM
/// does not tell the sender; sequence numbers and times do.
///
/// A message continues the series if its number is at most kMaxGap ahead and its number was not seen with another time.
/// What does not continue it may be a second series: the series is replaced (a restart) when the first one stays away
/// while the second one goes on, and both are two publishers when both go on. None is believed then.
class MessageSeries {
 public:
  enum class Verdict : std::uint8_t {
    kNext,      // of the publisher; late ones of it too
    kRepeated,  // the same message once more: the network doubled it
    kUnproven,  // of a publisher that is not known (yet)
    kDoubled,   // two publishers send under one name
  };

  /// `now_ns`: monotonic.
  Verdict take(std::int64_t sequence, std::int64_t utime_us, std::int64_t now_ns);

  bool doubled(std::int64_t now_ns) const { return now_ns < doubled_until_ns_; }
  std::int64_t lost() const { return lost_; }
  std::int64_t restarts() const { return restarts_; }

  static constexpr std::int64_t kMaxGap = 1000;
  /// Messages of a second series that prove it.
  static constexpr int kProof = 5;
  /// Without evidence of two publishers for so long there is one again.
  static constexpr std::int64_t kDoubled_ns = 5'000'000'000;

 private:
  struct Message {
    std::int64_t sequence = -1;
    std::int64_t utime_us = 0;
  };
  struct Series {
    Message newest;
    std::array<Message, 32> recent{};
    std::size_t next = 0;
    std::int64_t last_ns = 0;
    int messages = 0;
    void add(const Message& message, std::int64_t now_ns);
  };
  enum class Relation : std::uint8_t { kContinues, kLate, kRepeats, kForeign };
  static Relation relation(const Series& series, const Message& message);
  Verdict take_other(const Message& message, std::int64_t now_ns);

  std::optional<Series> series_, other_;
  int advances_ = 0;     // of the series, since the other one began
  int other_alone_ = 0;  // messages of the other one since the series' last
  std::int64_t doubled_until_ns_ = 0;
  std::int64_t lost_ = 0;
  std::int64_t restarts_ = 0;
};

}  // namespace pharos::host
