// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "host/clock/round_trip_clock.hpp"

namespace pharos {
class clock_exchange_t;
}

namespace pharos::host {

/// This daemon's questions to one other daemon about its clock, and what its answers tell. Without I/O; times are
/// monotonic.
class PeerClock {
 public:
  PeerClock(std::string own_name, std::int64_t own_session, std::string peer);

  /// The next question, sent now.
  clock_exchange_t ask(std::int64_t now_ns);
  /// An answer of any daemon to any; those of the peer to this one's questions are used.
  void take(const clock_exchange_t& answer, std::int64_t now_ns);

  /// Empty while the relation is not known, and while two daemons answer.
  std::optional<OwnTime> own_time(std::int64_t peer_ns, std::int64_t now_ns) const;
  /// Two daemons answer under this name.
  bool doubled(std::int64_t now_ns) const { return now_ns < doubled_until_ns_; }

  const std::string& peer() const { return peer_; }
  const RoundTripClock& relation() const { return relation_; }
  std::int64_t asked() const { return asked_; }
  std::int64_t answered() const { return answered_; }
  /// Answers to nothing that was asked, or with impossible times.
  std::int64_t refused() const { return refused_; }
  /// New starts of the peer.
  std::int64_t restarts() const { return restarts_; }

  static constexpr std::int64_t kDoubled_ns = 5'000'000'000;

 private:
  struct Question {
    std::int64_t sequence = -1;
    std::int64_t asked_ns = 0;
    bool answered = false;
  };
  bool is_believed(std::int64_t session, std::int64_t now_ns);

  std::string own_name_;
  std::int64_t own_session_;
  std::string peer_;
  std::array<Question, 16> questions_{};
  RoundTripClock relation_;
  std::optional<std::int64_t> session_;
  // Of another session that answers.
  std::int64_t other_session_ = 0;
  int other_answers_ = 0;
  int other_run_ = 0;            // of them without one of session_ between
  int answers_since_other_ = 0;  // of session_
  std::int64_t doubled_until_ns_ = 0;
  std::int64_t asked_ = 0, answered_ = 0, refused_ = 0, restarts_ = 0;
};

}  // namespace pharos::host
