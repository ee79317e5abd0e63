// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <deque>
#include <span>
#include <utility>

#include "host/record/stream_reader.hpp"
#include "host/support/input_error.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "pharos/report/link_decoder.hpp"
#include "tools/support/recording_source.hpp"

namespace pharos::tools {
namespace {

// A target in the diagnostic mode may send raw edges and the sweeps decoded from them. The kind received first is used
// and the other ignored, so that nothing counts twice.
enum class Content : std::uint8_t { kUnknown, kDecoded, kRawEdges };

// A recording made by StreamRecorder.
class RecordedBytes {
 public:
  explicit RecordedBytes(host::ByteSource bytes) : reader_(std::move(bytes)) {}

  const std::string& name() const { return reader_.name(); }
  std::optional<std::span<const std::uint8_t>> next() {
    const std::optional<host::StreamChunk> chunk = reader_.next();
    if (!chunk) return std::nullopt;
    return chunk->bytes;
  }
  std::vector<std::string> remarks() const {
    std::vector<std::string> out;
    if (reader_.cut_off()) out.push_back(name() + ": cut off in the middle of a chunk; all before it used");
    if (reader_.dropped_bytes() > 0) {
      out.push_back(name() + ": " + std::to_string(reader_.dropped_bytes()) + " bytes of the file damaged and dropped");
    }
    if (reader_.lost_bytes() > 0) {
      out.push_back(name() + ": " + std::to_string(reader_.lost_bytes()) + " bytes of the stream were never recorded");
    }
    return out;
  }

 private:
  host::StreamReader reader_;
};

// The raw bytes of a serial line.
class LineBytes {
 public:
  explicit LineBytes(host::ByteSource bytes) : source_(std::move(bytes)) {}

  const std::string& name() const { return source_.name(); }
  std::optional<std::span<const std::uint8_t>> next() {
    const std::size_t count = source_.read(buffer_);
    if (count == 0) return std::nullopt;
    return std::span(reinterpret_cast<const std::uint8_t*>(buffer_.data()), count);
  }
  std::vector<std::string> remarks() const { return {}; }

 private:
  host::ByteSource source_;
  std::array<char, 4096> buffer_{};
};

template <class Bytes>
class SerialStreamSource final : public RecordingSource {
 public:
  explicit SerialStreamSource(host::ByteSource bytes) : bytes_(std::move(bytes)) {}

  bool is_serial() const override { return true; }
  std::optional<RecordingEvent> next() override {
    while (ready_.empty() && !ended_) {
      if (const auto bytes = bytes_.next()) {
        for (const std::uint8_t byte : *bytes) {
          if (const auto event = link_.push(byte)) take(*event);
        }
      } else {
        end();
      }
    }
    if (ready_.empty()) return std::nullopt;
    const RecordingEvent event = ready_.front();
    ready_.pop_front();
    return event;
  }

  void visit_counters(const CounterVisitor& visit) const override {
    wire::for_each_counter(link_.counters(), visit);
    lighthouse::for_each_counter(content_ == Content::kRawEdges ? decoder_.counters() : target_counters_, visit);
  }

  std::vector<std::string> remarks() const override { return bytes_.remarks(); }

 private:
  void take(const report::LinkEvent& event) {
    if (const auto* sweep = std::get_if<lighthouse::Sweep>(&event)) {
      if (is(Content::kDecoded)) ready_.emplace_back(*sweep);
    } else if (const auto* payload = std::get_if<lighthouse::OotxPayload>(&event)) {
      if (is(Content::kDecoded)) ready_.emplace_back(*payload);
    } else if (const auto* lh2_sweep = std::get_if<lighthouse::Lh2Sweep>(&event)) {
      if (is(Content::kDecoded)) ready_.emplace_back(*lh2_sweep);
    } else if (const auto* lh2_payload = std::get_if<report::Lh2OotxReport>(&event)) {
      if (is(Content::kDecoded)) ready_.emplace_back(*lh2_payload);
    } else if (const auto* edges = std::get_if<report::EdgesReport>(&event)) {
      if (is(Content::kRawEdges)) take_edges(*edges);
    } else if (const auto* counters = std::get_if<report::DecoderReport>(&event)) {
      target_counters_ = counters->counters;
    }
  }

  bool is(Content content) {
    if (content_ == Content::kUnknown) content_ = content;
    return content_ == content;
  }

  void take_edges(const report::EdgesReport& report) {
    for (const lighthouse::Edge& edge : report.edges) {
      decoder_.push(edge);
      take_decoded();
    }
  }

  void take_decoded() {
    while (const auto sweep = decoder_.take_sweep()) ready_.emplace_back(*sweep);
    while (const auto payload = decoder_.take_ootx()) ready_.emplace_back(*payload);
  }

  void end() {
    ended_ = true;
    decoder_.flush();
    take_decoded();
    if (link_.counters().frames > 0 || !link_.unsupported_version()) return;
    throw host::InputError(bytes_.name() + ": every frame has protocol version " +
                           std::to_string(*link_.unsupported_version()) +
                           ", this program has another; use a matching one");
  }

  Bytes bytes_;
  report::LinkDecoder link_;
  lighthouse::Decoder decoder_;
  lighthouse::DecoderCounters target_counters_;
  std::deque<RecordingEvent> ready_;
  Content content_ = Content::kUnknown;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<RecordingSource> open_serial_stream(host::ByteSource bytes) {
  return std::make_unique<SerialStreamSource<RecordedBytes>>(std::move(bytes));
}

std::unique_ptr<RecordingSource> open_line_bytes(host::ByteSource bytes) {
  return std::make_unique<SerialStreamSource<LineBytes>>(std::move(bytes));
}

}  // namespace pharos::tools
