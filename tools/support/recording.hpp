// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "pharos/lighthouse/lh2_sweep.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/report/reports.hpp"

namespace pharos::tools {

class RecordingSource;

/// One event of a decoded recording; of a target of Lighthouse 2.0 the last two.
using RecordingEvent =
    std::variant<lighthouse::Sweep, lighthouse::OotxPayload, lighthouse::Lh2Sweep, report::Lh2OotxReport>;

/// Whether an event is of Lighthouse 2.0.
inline bool is_lh2(const RecordingEvent& event) {
  return std::holds_alternative<lighthouse::Lh2Sweep>(event) || std::holds_alternative<report::Lh2OotxReport>(event);
}

/// A recording from start to end: a table of light pulses, which is decoded here, or a recorded serial stream, with
/// sweeps decoded by the target (or raw edges, in the diagnostic mode). The content determines the format.
class Recording {
 public:
  /// Throws InputError for a file that is neither.
  explicit Recording(const std::string& path);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// `show` is called whenever a live recording has no more data for now, before next() waits for it.
  void on_pause(std::function<void()> show);
  /// The next event in order of time; empty at the end. Throws InputError where a table is broken.
  std::optional<RecordingEvent> next();

  /// Whether it is a serial stream: only its first event tells the generation. A table of pulses is Lighthouse 1.0.
  bool is_serial() const;

  /// For messages: the path, or "standard input".
  const std::string& name() const { return name_; }

  /// Every counter on standard error, one a line: name, value, what it counts.
  void print_statistics() const;
  /// Notes for the user at the end, on standard error: an unfinished last line, lost bytes.
  void print_remarks() const;

 private:
  std::string name_;
  std::shared_ptr<std::function<void()>> show_;
  std::unique_ptr<RecordingSource> source_;
};

/// Whether `path` can be read twice: an ordinary file, not standard input or a pipe.
bool is_rereadable(const std::string& path);

}  // namespace pharos::tools
