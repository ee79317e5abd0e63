// SPDX-License-Identifier: Apache-2.0
#include "tools/support/recording.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <utility>

#include "host/record/stream_reader.hpp"
#include "host/support/input_error.hpp"
#include "host/table/table_reader.hpp"
#include "pharos/wire/frame.hpp"
#include "tools/support/output.hpp"
#include "tools/support/recording_source.hpp"

namespace pharos::tools {
namespace {

constexpr std::size_t kSniffBytes = host::StreamReader::kHeaderBytes;

// A table begins with names; control characters and bytes beyond ASCII (except a byte order mark) mean another format.
bool looks_like_text(std::string_view first_bytes) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (first_bytes.starts_with(kByteOrderMark)) first_bytes.remove_prefix(kByteOrderMark.size());
  return std::all_of(first_bytes.begin(), first_bytes.end(), [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code >= 0x20 && code < 0x7F) || c == '\n' || c == '\r' || c == '\t';
  });
}

std::unique_ptr<RecordingSource> open_source(const std::string& path, std::function<void()> on_pause) {
  host::ByteSource bytes(path);
  bytes.on_pause(std::move(on_pause));
  const std::string_view first_bytes = bytes.peek(kSniffBytes).substr(0, kSniffBytes);
  if (host::StreamReader::looks_like(first_bytes)) return open_serial_stream(std::move(bytes));
  if (first_bytes.starts_with(wire::kFrameDelimiter)) return open_line_bytes(std::move(bytes));
  if (looks_like_text(first_bytes)) return open_pulse_table(std::move(bytes));
  throw host::InputError(bytes.name() + ": neither a table sensor,rise_ticks,fall_ticks nor a recorded serial stream " +
                         "(it begins with " + host::quoted(first_bytes) + "); give a recording");
}

}  // namespace

Recording::Recording(const std::string& path)
    : name_(path == "-" ? "standard input" : path),
      show_(std::make_shared<std::function<void()>>()),
      source_(open_source(path, [show = show_] {
        if (*show) (*show)();
      })) {}
Recording::~Recording() = default;
void Recording::on_pause(std::function<void()> show) { *show_ = std::move(show); }
std::optional<RecordingEvent> Recording::next() { return source_->next(); }
bool Recording::is_serial() const { return source_->is_serial(); }

void Recording::print_statistics() const {
  source_->visit_counters([](const char* name, std::uint64_t value, const char* text) {
    std::fprintf(stderr, "%-22s %10" PRIu64 "  %s\n", name, value, text);
  });
}

void Recording::print_remarks() const {
  for (const std::string& remark : source_->remarks()) note(remark);
}

bool is_rereadable(const std::string& path) {
  struct stat status {};
  return path != "-" && ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace pharos::tools
