// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/remote/peer_clock.hpp"

#include <algorithm>
#include <utility>

#include "pharos/clock_exchange_t.hpp"

namespace pharos::host {
namespace {

// So many answers in a row of another session, and none of the one before, are a new start.
constexpr int kProof = 5;
// Both sessions answer: two daemons.
constexpr int kBoth = 2;

}  // namespace

PeerClock::PeerClock(std::string own_name, std::int64_t own_session, std::string peer)
    : own_name_(std::move(own_name)), own_session_(own_session), peer_(std::move(peer)) {}

clock_exchange_t PeerClock::ask(std::int64_t now_ns) {
  clock_exchange_t question{};
  question.sender = own_name_;
  question.recipient = peer_;
  question.session = own_session_;
  question.sequence = asked_++;
  questions_[static_cast<std::size_t>(question.sequence) % questions_.size()] = {question.sequence, now_ns, false};
  return question;
}

bool PeerClock::is_believed(std::int64_t session, std::int64_t now_ns) {
  if (!session_) session_ = session;
  const bool known = session == *session_;
  if (!known && (other_answers_ == 0 || session != other_session_)) {
    other_session_ = session;
    other_answers_ = other_run_ = answers_since_other_ = 0;
  }
  ++(known ? answers_since_other_ : other_answers_);
  other_run_ = known ? 0 : other_run_ + 1;
  if (other_answers_ >= kBoth && answers_since_other_ >= kBoth) {
    doubled_until_ns_ = now_ns + kDoubled_ns;
    other_answers_ = other_run_ = answers_since_other_ = 0;  // to be proved anew
  }
  if (known || other_run_ < kProof) return known;
  session_ = session;
  other_answers_ = other_run_ = 0;
  relation_.restart();
  ++restarts_;
  return true;
}

void PeerClock::take(const clock_exchange_t& answer, std::int64_t now_ns) {
  if (answer.is_answer == 0 || answer.sender != peer_ || answer.recipient != own_name_) return;
  const auto asked = std::find_if(questions_.begin(), questions_.end(), [&](const Question& question) {
    return question.sequence >= 0 && question.sequence == answer.sequence;
  });
  if (answer.asked_session != own_session_ || asked == questions_.end()) {
    ++refused_;
    return;
  }
  if (!is_believed(answer.session, now_ns) || asked->answered) return;
  asked->answered = true;
  const RoundTrip trip{asked->asked_ns, answer.received_ns, answer.answered_ns, now_ns};
  ++(relation_.add(trip) == RoundTripClock::Result::kImpossible ? refused_ : answered_);
}

std::optional<OwnTime> PeerClock::own_time(std::int64_t peer_ns, std::int64_t now_ns) const {
  if (doubled(now_ns)) return std::nullopt;
  return relation_.own_time(peer_ns, now_ns);
}

}  // namespace pharos::host
