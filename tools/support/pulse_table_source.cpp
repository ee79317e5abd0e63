// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "host/table/edges_reader.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "tools/support/recording_source.hpp"

namespace pharos::tools {
namespace {

class PulseTableSource final : public RecordingSource {
 public:
  explicit PulseTableSource(host::ByteSource bytes) : reader_(std::move(bytes)) {}

  bool is_serial() const override { return false; }
  std::optional<RecordingEvent> next() override {
    for (;;) {
      if (const auto sweep = decoder_.take_sweep()) return RecordingEvent{*sweep};
      if (const auto payload = decoder_.take_ootx()) return RecordingEvent{*payload};
      if (flushed_) return std::nullopt;
      if (const std::optional<lighthouse::RawPulse> pulse = reader_.next()) {
        decoder_.push(*pulse);
      } else {
        decoder_.flush();
        flushed_ = true;
      }
    }
  }

  void visit_counters(const CounterVisitor& visit) const override {
    visit("lines_unfinished", reader_.ended_unfinished() ? 1 : 0, "last lines dropped: cut off in writing");
    lighthouse::for_each_counter(decoder_.counters(), visit);
  }

  std::vector<std::string> remarks() const override {
    if (!reader_.ended_unfinished()) return {};
    return {reader_.name() + ": ends in the middle of line " + std::to_string(reader_.line_number() + 1) +
            ": 1 unfinished line dropped, all before it used"};
  }

 private:
  host::EdgesReader reader_;
  lighthouse::Decoder decoder_;
  bool flushed_ = false;
};

}  // namespace

std::unique_ptr<RecordingSource> open_pulse_table(host::ByteSource bytes) {
  return std::make_unique<PulseTableSource>(std::move(bytes));
}

}  // namespace pharos::tools
