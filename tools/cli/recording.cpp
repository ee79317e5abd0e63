// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/recording.hpp"

#include <sys/stat.h>

#include <cinttypes>
#include <cstdio>
#include <utility>

#include "host/support/input_error.hpp"
#include "host/table/edges_reader.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "tools/cli/output.hpp"

namespace pharos::tools {

class Recording::Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;
  virtual std::optional<RecordingEvent> next() = 0;
  virtual const lighthouse::DecoderCounters& counters() const = 0;
  virtual std::vector<std::string> remarks() const = 0;
  virtual std::size_t items_read() const = 0;
};

namespace {

class TableSource final : public Recording::Source {
 public:
  explicit TableSource(host::ByteSource bytes) : reader_(std::move(bytes)) {}

  std::optional<RecordingEvent> next() override {
    for (;;) {
      if (std::optional<lighthouse::Sweep> sweep = decoder_.take_sweep()) return RecordingEvent{*sweep};
      if (std::optional<lighthouse::OotxPayload> payload = decoder_.take_ootx()) return RecordingEvent{*payload};
      if (flushed_) return std::nullopt;
      if (const std::optional<lighthouse::RawPulse> pulse = reader_.next()) {
        decoder_.push(*pulse);
        ++pulses_;
      } else {
        decoder_.flush();
        flushed_ = true;
      }
    }
  }

  const lighthouse::DecoderCounters& counters() const override { return decoder_.counters(); }

  std::vector<std::string> remarks() const override {
    if (!reader_.ended_unfinished()) return {};
    return {reader_.name() + ": ends in the middle of line " + std::to_string(reader_.line_number() + 1) +
            "; 1 unfinished line dropped, the rest used"};
  }

  std::size_t items_read() const override { return pulses_; }

 private:
  host::EdgesReader reader_;
  lighthouse::Decoder decoder_;
  std::size_t pulses_ = 0;
  bool flushed_ = false;
};

std::unique_ptr<Recording::Source> open_source(const std::string& path) {
  host::ByteSource bytes(path);
  return std::make_unique<TableSource>(std::move(bytes));
}

}  // namespace

Recording::Recording(const std::string& path) : source_(open_source(path)) {}
Recording::~Recording() = default;
std::optional<RecordingEvent> Recording::next() { return source_->next(); }
const lighthouse::DecoderCounters& Recording::counters() const { return source_->counters(); }
std::vector<std::string> Recording::remarks() const { return source_->remarks(); }
std::size_t Recording::items_read() const { return source_->items_read(); }

bool is_rereadable(const std::string& path) {
  struct stat status {};
  return path != "-" && ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

void print_statistics(const Recording& recording) {
  lighthouse::for_each_counter(recording.counters(), [](const char* name, std::uint32_t value, const char* text) {
    std::fprintf(stderr, "%-22s %10" PRIu32 "  %s\n", name, value, text);
  });
}

void print_remarks(const Recording& recording) {
  for (const std::string& remark : recording.remarks()) note(remark);
}

}  // namespace pharos::tools
