// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace pharos::host {

/// Writes log lines in a thread of its own, so that logging never blocks: not on a pipe without a reader, a journal
/// that hangs or a busy disk.
///
/// At most kMaxLines wait; if there are more the oldest is dropped, counted, and reported in the log as soon as lines
/// can be written again. finish() waits for the thread for a limited time and then detaches it.
class LogWriter {
 public:
  /// Some seconds of a daemon with many faults, each kind of line limited to a few in ten seconds.
  static constexpr std::size_t kMaxLines = 1024;
  /// The size of an atomic write to a pipe (PIPE_BUF). Longer lines are truncated.
  static constexpr std::size_t kMaxLine_bytes = 4096;

  struct Line {
    int priority = 0;  // of syslog(3)
    std::string text;  // with a line break, if the destination needs one
  };
  /// Writes one line and may block; false if the line is lost. Called in the writer's thread.
  using Write = std::function<bool(const Line&)>;
  /// The line that reports how many were dropped.
  using Note = std::function<Line(std::uint64_t dropped)>;

  LogWriter(Write write, Note note);
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  ~LogWriter();

  /// Never blocks. After finish() the line is dropped.
  void push(Line line);
  /// Replaces the function that writes lines, from the next line on.
  void set_write(Write write);
  /// Waits until every line is written, at most for `limit`. No line is accepted afterwards.
  void finish(std::chrono::milliseconds limit);
  /// Lines so far that were dropped from a full queue or could not be written.
  std::uint64_t dropped() const;

 private:
  struct State;
  static void run(const std::shared_ptr<State>& state);

  std::shared_ptr<State> state_;  // shared with the thread, which may outlive this object
};

}  // namespace pharos::host
