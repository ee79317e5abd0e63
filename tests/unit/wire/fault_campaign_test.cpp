// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "pharos/wire/frame_decoder.hpp"
#include "unit/wire/random_messages.hpp"

namespace pharos::wire {
namespace {

using test::Bytes;
using test::RandomMessages;

/// A stream of frames as a target sends it, with the position of each.
struct Stream {
  Bytes line;
  struct Sent {
    std::size_t begin = 0;
    std::size_t end = 0;
    MessageType type{};
    Bytes payload;
  };
  std::vector<Sent> frames;
};

Stream make_stream(RandomMessages& random, std::size_t frames) {
  Stream stream;
  FrameEncoder encoder;
  for (std::size_t i = 0; i < frames; ++i) {
    Stream::Sent sent;
    std::size_t pick = random.below(test::AllMessages::kSize);
    test::AllMessages::for_each([&](auto example) {
      if (pick-- != 0) return;
      sent.type = decltype(example)::kType;
      sent.payload = random.payload_of<decltype(example)>();
    });
    const Bytes bytes = test::frame_bytes(encoder, sent.type, sent.payload);
    sent.begin = stream.line.size();
    stream.line.insert(stream.line.end(), bytes.begin(), bytes.end());
    sent.end = stream.line.size();
    stream.frames.push_back(std::move(sent));
  }
  return stream;
}

/// The stream with faults, and for each frame whether it is intact: unchanged, with a delimiter before and after it.
struct Broken {
  Bytes line;
  std::vector<bool> whole;
  std::size_t faults = 0;  // bytes flipped, dropped, inserted, doubled, cut off or moved
};

class FrameCorruptor {
 public:
  FrameCorruptor(RandomMessages& random, const Stream& stream, std::size_t bytes_between_faults)
      : random_(random), stream_(stream), gap_(bytes_between_faults) {
    out_.whole.assign(stream.frames.size(), true);
  }

  Broken run() {
    std::size_t at = 0;
    while (at < stream_.line.size()) {
      const std::size_t next = std::min(stream_.line.size(), at + 1 + random_.below(2 * gap_));
      copy(at, next);
      at = next;
      if (at < stream_.line.size()) at = break_at(at);
    }
    return std::move(out_);
  }

 private:
  void copy(std::size_t begin, std::size_t end) {
    out_.line.insert(out_.line.end(), stream_.line.begin() + static_cast<std::ptrdiff_t>(begin),
                     stream_.line.begin() + static_cast<std::ptrdiff_t>(end));
  }
  /// Marks the frames that have a byte in [begin, end) as hit.
  void hit(std::size_t begin, std::size_t end) {
    auto first = std::upper_bound(stream_.frames.begin(), stream_.frames.end(), begin,
                                  [](std::size_t value, const Stream::Sent& sent) { return value < sent.end; });
    for (; first != stream_.frames.end() && first->begin < end; ++first) {
      out_.whole[static_cast<std::size_t>(first - stream_.frames.begin())] = false;
    }
  }
  std::size_t frame_at(std::size_t at) const {
    const auto frame = std::upper_bound(stream_.frames.begin(), stream_.frames.end(), at,
                                        [](std::size_t value, const Stream::Sent& sent) { return value < sent.end; });
    return static_cast<std::size_t>(frame - stream_.frames.begin());
  }

  std::size_t break_at(std::size_t at) {
    const std::size_t left = stream_.line.size() - at;
    const std::size_t run = 1 + random_.below(std::min<std::size_t>(left, random_.below(8) == 0 ? 60 : 3));
    switch (random_.below(6)) {
      case 0:  // flip bits
        hit(at, at + run);
        for (std::size_t i = 0; i < run; ++i) {
          out_.line.push_back(stream_.line[at + i] ^ static_cast<std::uint8_t>(1 + random_.below(255)));
        }
        out_.faults += run;
        return at + run;
      case 1:  // drop bytes
        hit(at, at + run);
        out_.faults += run;
        return at + run;
      case 2:  // insert bytes; between two frames both stay intact
        if (stream_.frames[frame_at(at)].begin != at) hit(at, at + 1);
        for (std::size_t i = 0; i < run; ++i) out_.line.push_back(random_.integer<std::uint8_t>());
        out_.faults += run;
        return at;
      case 3:  // double bytes
        hit(at, at + run);
        copy(at, at + run);
        copy(at, at + run);
        out_.faults += run;
        return at + run;
      case 4: {  // cut a frame short
        const std::size_t end = stream_.frames[frame_at(at)].end;
        hit(at, end);
        out_.faults += end - at;
        return end;
      }
      default: {  // exchange two runs of bytes
        const std::size_t second = std::min(at + 2 * run, stream_.line.size());
        hit(at, second);
        copy(at + run, second);
        copy(at, at + run);
        out_.faults += second - at;
        return second;
      }
    }
  }

  RandomMessages& random_;
  const Stream& stream_;
  std::size_t gap_;
  Broken out_;
};

struct Outcome {
  std::size_t faults = 0;
  std::size_t sent = 0;
  std::size_t whole = 0;
  std::size_t decoded = 0;
  std::size_t decoded_whole = 0;
  std::uint64_t lost = 0;
  std::uint64_t true_loss = 0;
};

/// Decodes one stream: no false frame may be decoded, and every intact frame must be.
Outcome run_campaign(std::uint64_t seed, std::size_t frames, std::size_t bytes_between_faults) {
  RandomMessages random(seed);
  const Stream stream = make_stream(random, frames);
  const Broken broken = FrameCorruptor(random, stream, bytes_between_faults).run();
  FrameDecoder decoder;
  std::vector<bool> seen(frames, false);
  std::size_t first = frames;
  std::size_t last = 0;
  for (const std::uint8_t byte : broken.line) {
    const auto frame = decoder.push(byte);
    if (!frame) continue;
    const std::size_t number = frame->sequence;  // streams are shorter than 65,536 frames
    if (number >= frames) {
      ADD_FAILURE() << "a frame that was never sent: number " << number;
      continue;
    }
    const Stream::Sent& sent = stream.frames[number];
    EXPECT_EQ(frame->type, sent.type) << "false frame " << number;
    EXPECT_TRUE(std::equal(frame->payload.begin(), frame->payload.end(), sent.payload.begin(), sent.payload.end()))
        << "false frame " << number;
    EXPECT_FALSE(seen[number]) << "frame " << number << " came twice";
    seen[number] = true;
    first = std::min(first, number);
    last = std::max(last, number);
  }
  Outcome outcome;
  outcome.faults = broken.faults;
  outcome.sent = frames;
  for (std::size_t i = 0; i < frames; ++i) {
    outcome.decoded += seen[i] ? 1u : 0u;
    outcome.whole += broken.whole[i] ? 1u : 0u;
    outcome.decoded_whole += seen[i] && broken.whole[i] ? 1u : 0u;
    outcome.true_loss += i > first && i < last && !seen[i] ? 1u : 0u;
  }
  outcome.lost = decoder.counters().frames_lost;
  EXPECT_EQ(decoder.counters().bytes, broken.line.size());
  EXPECT_EQ(decoder.counters().frames, outcome.decoded);
  return outcome;
}

void expect_sound(const Outcome& outcome) {
  EXPECT_EQ(outcome.decoded_whole, outcome.whole) << "a frame that came whole was not decoded";
  EXPECT_EQ(outcome.lost, outcome.true_loss) << "frames lost between the first and the last decoded";
  EXPECT_GE(outcome.decoded, outcome.whole);
}

TEST(FaultCampaign, TenMillionBrokenBytesBringNoFalseFrameAndHideNoGoodOne) {
  Outcome total;
  for (std::uint64_t seed = 1; total.faults < 10'000'000; ++seed) {
    // From a fault every few bytes to one in several frames.
    const std::size_t gap = std::size_t{20} << (seed % 7);
    const Outcome outcome = run_campaign(seed, 20'000, gap);
    expect_sound(outcome);
    if (HasFailure()) FAIL() << "seed " << seed;
    total.faults += outcome.faults;
    total.sent += outcome.sent;
    total.decoded += outcome.decoded;
    total.lost += outcome.lost;
  }
  RecordProperty("faults", std::to_string(total.faults));
  std::printf("%zu broken bytes; %zu frames sent, %zu decoded, %llu counted as lost, 0 false\n", total.faults,
              total.sent, total.decoded, static_cast<unsigned long long>(total.lost));
  EXPECT_GT(total.decoded, total.sent / 4);
}

TEST(FaultCampaign, RandomBytesAloneGiveNoFrame) {
  RandomMessages random(99);
  FrameDecoder decoder;
  for (int i = 0; i < 4'000'000; ++i) {
    // Many zeros, so that many short candidates reach the CRC check.
    const auto byte = random.below(16) == 0 ? std::uint8_t{0} : random.integer<std::uint8_t>();
    ASSERT_FALSE(decoder.push(byte).has_value());
  }
  EXPECT_GT(decoder.counters().bad_crc + decoder.counters().bad_stuffing, 100'000u);
}

TEST(FaultCampaign, PayloadsThatMeanNothingAreRefused) {
  // A faulty sender with a correct CRC: random payloads never crash and never decode to other bytes.
  RandomMessages random(98);
  for (int i = 0; i < 200'000; ++i) {
    Bytes payload(random.below(80));
    for (auto& byte : payload) byte = random.integer<std::uint8_t>();
    test::AllMessages::for_each([&](auto example) {
      const auto message = decode_payload<decltype(example)>(payload);
      if (!message) return;
      Bytes again(kMaxPayload);
      again.resize(encode_payload(*message, again));
      ASSERT_EQ(again, payload);
    });
  }
}

}  // namespace
}  // namespace pharos::wire
