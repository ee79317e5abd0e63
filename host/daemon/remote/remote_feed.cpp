// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/remote/remote_feed.hpp"

#include <chrono>
#include <random>

#include "host/receive/message_shape.hpp"
#include "host/support/time_units.hpp"
#include "pharos/clock_exchange_t.hpp"
#include "pharos/pose_t.hpp"

namespace pharos::host {
namespace {

// Of this start; not secret.
std::int64_t new_session() {
  std::random_device random;
  return static_cast<std::int64_t>(std::uint64_t{random()} << 31U ^ random());
}

}  // namespace

RemoteFeed::Remote::Remote(const RemoteConfig& remote, PeerClock* clock)
    : config(remote), peer(clock), intake(remote), log("remote/" + remote.name) {}

RemoteFeed::RemoteFeed(const SourceContext& context)
    : context_(context), session_(new_session()), receiver_(context.open_receiver(context.config.lcm.url)) {
  for (const RemoteConfig& config : context.config.remotes) {
    PeerClock* peer = nullptr;
    if (!config.daemon.empty()) {
      peer = &peers_.try_emplace(config.daemon, context.config.source, session_, config.daemon).first->second;
    }
    remotes_.push_back(std::make_unique<Remote>(config, peer));
    receiver_->subscribe(config.channel, [this, remote = remotes_.back().get()](std::span<const std::uint8_t> message) {
      take_pose(*remote, message);
    });
  }
  receiver_->subscribe(context.config.lcm.clock_channel,
                       [this](std::span<const std::uint8_t> message) { take_clock(message); });
  if (receiver_->fd() >= 0) context_.loop.watch(receiver_->fd(), [this] { receiver_->take(); });
  context_.loop.watch(timer_.fd(), [this] {
    timer_.take_expiries();
    ask();
  });
  if (!peers_.empty()) timer_.start_every(std::chrono::nanoseconds(kNsPerSecond / kAsksPerSecond));
}

RemoteFeed::~RemoteFeed() {
  context_.loop.forget(timer_.fd());
  if (receiver_->fd() >= 0) context_.loop.forget(receiver_->fd());
}

void RemoteFeed::ask() {
  for (auto& [name, peer] : peers_) {
    const clock_exchange_t question = peer.ask(context_.clock.monotonic_ns());
    context_.publisher.publish_clock(context_.config.lcm.clock_channel, question);
  }
}

void RemoteFeed::take_pose(Remote& remote, std::span<const std::uint8_t> message) {
  const std::int64_t now_ns = context_.clock.monotonic_ns();
  const std::optional<pose_t> pose = remote.intake.take(message, remote.peer, context_.clock);
  const RemoteOutcome outcome = remote.intake.last();
  if (outcome == RemoteOutcome::poses_other || outcome == RemoteOutcome::messages_damaged) return;
  remote.rate.on_data(now_ns);
  if (outcome != RemoteOutcome::poses_repeated) remote.poses.add({1, 0}, now_ns);
  if (!pose) return;
  remote.rate.on_pose(now_ns);
  context_.publisher.hand_over(*pose);
}

void RemoteFeed::take_clock(std::span<const std::uint8_t> message) {
  const std::int64_t now_ns = context_.clock.monotonic_ns();
  clock_exchange_t exchange{};
  constexpr std::size_t kMaxBytes = 1024;  // names are at most 32 characters
  if (message.size() > kMaxBytes || !decode(exchange, message.data(), static_cast<int>(message.size()))) {
    ++damaged_;
    return;
  }
  if (exchange.recipient != context_.config.source) return;
  if (exchange.is_answer == 0) {
    answer(exchange);
  } else if (const auto peer = peers_.find(exchange.sender); peer != peers_.end()) {
    peer->second.take(exchange, now_ns);
  }
}

void RemoteFeed::answer(const clock_exchange_t& question) {
  const std::int64_t received_ns = context_.clock.utc_ns();
  const std::int64_t second = context_.clock.monotonic_ns() / kNsPerSecond;
  if (second != answered_second_) answered_in_second_ = 0;
  answered_second_ = second;
  if (!context_.config.lcm.answer_clock || ++answered_in_second_ > kMaxAnswersPerSecond) {
    ++not_answered_;
    return;
  }
  clock_exchange_t out{};
  out.sender = context_.config.source;
  out.recipient = question.sender;
  out.session = session_;
  out.sequence = question.sequence;
  out.is_answer = 1;
  out.asked_session = question.session;
  out.received_ns = received_ns;
  out.answered_ns = std::max(received_ns, context_.clock.utc_ns());
  if (context_.publisher.publish_clock(context_.config.lcm.clock_channel, out)) ++answers_;
}

NamedCounts RemoteFeed::daemon_counters() const {
  return {{"clock_answers", answers_}, {"clock_not_answered", not_answered_}, {"clock_damaged", damaged_}};
}

std::size_t open_remote_feed(const SourceContext& context, SourceList& sources) {
  const std::size_t remotes = context.config.remotes.size();
  if (remotes > 0 || context.config.lcm.answer_clock) sources.push_back(std::make_unique<RemoteFeed>(context));
  return remotes;
}

}  // namespace pharos::host
