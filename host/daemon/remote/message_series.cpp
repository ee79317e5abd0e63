// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/remote/message_series.hpp"

namespace pharos::host {
namespace {

// A second series without a message for so long was none.
constexpr std::int64_t kForgotten_ns = 2'000'000'000;
// Both series go on: messages of the second one, and of the first one since.
constexpr int kBothMessages = 3;
constexpr int kBothAdvances = 2;

}  // namespace

void MessageSeries::Series::add(const Message& message, std::int64_t now_ns) {
  recent[next] = message;
  next = (next + 1) % recent.size();
  if (message.sequence > newest.sequence) newest = message;
  last_ns = now_ns;
  ++messages;
}

// A late message has the time that belongs to its number.
MessageSeries::Relation MessageSeries::relation(const Series& series, const Message& message) {
  for (const Message& seen : series.recent) {
    if (seen.sequence != message.sequence) continue;
    return seen.utime_us == message.utime_us ? Relation::kRepeats : Relation::kForeign;
  }
  if (message.sequence > series.newest.sequence) {
    return message.sequence - series.newest.sequence <= kMaxGap ? Relation::kContinues : Relation::kForeign;
  }
  const bool near = series.newest.sequence - message.sequence < static_cast<std::int64_t>(series.recent.size());
  const bool late = near && message.utime_us < series.newest.utime_us;
  return late ? Relation::kLate : Relation::kForeign;
}

MessageSeries::Verdict MessageSeries::take(std::int64_t sequence, std::int64_t utime_us, std::int64_t now_ns) {
  const Message message{sequence, utime_us};
  if (sequence < 0) return Verdict::kUnproven;
  if (other_ && now_ns - other_->last_ns > kForgotten_ns) other_.reset();
  if (!series_) {
    series_ = Series{};
    series_->newest = message;
    series_->add(message, now_ns);
    return Verdict::kNext;
  }
  switch (relation(*series_, message)) {
    case Relation::kRepeats:
      return Verdict::kRepeated;
    case Relation::kForeign:
      return take_other(message, now_ns);
    case Relation::kContinues:
      lost_ += sequence - series_->newest.sequence - 1;
      break;
    case Relation::kLate:
      --lost_;
      break;
  }
  series_->add(message, now_ns);
  other_alone_ = 0;
  if (other_) ++advances_;
  return doubled(now_ns) ? Verdict::kDoubled : Verdict::kNext;
}

MessageSeries::Verdict MessageSeries::take_other(const Message& message, std::int64_t now_ns) {
  const Relation relation_to_other = other_ ? relation(*other_, message) : Relation::kForeign;
  if (relation_to_other == Relation::kRepeats) return Verdict::kRepeated;
  if (relation_to_other == Relation::kForeign) {
    other_ = Series{};
    other_->newest = message;
    advances_ = other_alone_ = 0;
  }
  other_->add(message, now_ns);
  ++other_alone_;
  if (other_->messages >= kBothMessages && advances_ >= kBothAdvances) doubled_until_ns_ = now_ns + kDoubled_ns;
  if (doubled(now_ns)) return Verdict::kDoubled;
  if (other_alone_ < kProof) return Verdict::kUnproven;
  series_ = other_;
  other_.reset();
  ++restarts_;
  return Verdict::kNext;
}

}  // namespace pharos::host
