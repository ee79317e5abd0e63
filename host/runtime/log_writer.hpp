// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace pharos::host {

/// Writes log lines in a thread of its own, so that whoever logs never waits for whoever reads the log: a pipe that
/// nobody empties, a journal that hangs, a disk that is full of work.
///
/// At most kMaxLines wait; where there are more the oldest is dropped, counted, and told in the log as soon as that
/// takes lines again. The end waits for the writer for a limited time and then leaves its thread behind.
class LogWriter {
 public:
  /// Some seconds of a daemon that logs at every fault, each kind held to a few lines in ten seconds.
  static constexpr std::size_t kMaxLines = 1024;
  /// What a pipe takes in one piece (PIPE_BUF). Longer lines are cut.
  static constexpr std::size_t kMaxLine_bytes = 4096;

  struct Line {
    int priority = 0;  // of syslog(3)
    std::string text;  // with its line break, where the place wants one
  };
  /// Writes one line, and may take as long as it likes; false where the line is lost. Called in the writer's thread.
  using Write = std::function<bool(const Line&)>;
  /// The line that tells how many were dropped.
  using Note = std::function<Line(std::uint64_t dropped)>;

  LogWriter(Write write, Note note);
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  ~LogWriter();

  /// Never waits for the writer. After finish() the line is dropped.
  void push(Line line);
  /// What lines are written with from the next one on.
  void set_write(Write write);
  /// Waits until every line is written, `limit` at the most. No line is taken afterwards.
  void finish(std::chrono::milliseconds limit);
  /// Lines that found no room or could not be written, so far.
  std::uint64_t dropped() const;

 private:
  struct State;
  static void run(const std::shared_ptr<State>& state);

  std::shared_ptr<State> state_;  // the thread's too, which may outlive this
};

}  // namespace pharos::host
