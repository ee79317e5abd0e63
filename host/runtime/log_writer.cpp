// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/log_writer.hpp"

#include <condition_variable>
#include <csignal>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

namespace pharos::host {

struct LogWriter::State {
  std::mutex mutex;
  std::condition_variable lines_came;
  std::condition_variable all_written;
  std::deque<Line> lines;
  std::shared_ptr<const Write> write;  // the thread holds a copy while it uses it
  Note note;
  std::uint64_t dropped = 0;
  std::uint64_t dropped_unreported = 0;
  bool writing = false;
  bool finished = false;

  void drop_one() {
    ++dropped;
    ++dropped_unreported;
  }
};

LogWriter::LogWriter(Write write, Note note) : state_(std::make_shared<State>()) {
  state_->write = std::make_shared<const Write>(std::move(write));
  state_->note = std::move(note);
  // Signals are handled by the event loop: a thread inherits the signal mask of its creator.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread([state = state_] { run(state); }).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

LogWriter::~LogWriter() { finish(std::chrono::milliseconds(0)); }

void LogWriter::push(Line line) {
  if (line.text.size() > kMaxLine_bytes) {
    const bool has_break = line.text.back() == '\n';
    line.text.resize(kMaxLine_bytes - 4);
    line.text += has_break ? "...\n" : "...";
  }
  const std::lock_guard lock(state_->mutex);
  if (state_->finished) return state_->drop_one();
  if (state_->lines.size() == kMaxLines) {
    state_->lines.pop_front();
    state_->drop_one();
  }
  state_->lines.push_back(std::move(line));
  state_->lines_came.notify_one();
}

void LogWriter::set_write(Write write) {
  const std::lock_guard lock(state_->mutex);
  state_->write = std::make_shared<const Write>(std::move(write));
}

void LogWriter::finish(std::chrono::milliseconds limit) {
  std::unique_lock lock(state_->mutex);
  state_->all_written.wait_for(lock, limit, [&] { return state_->lines.empty() && !state_->writing; });
  state_->finished = true;
  state_->lines_came.notify_one();
}

std::uint64_t LogWriter::dropped() const {
  const std::lock_guard lock(state_->mutex);
  return state_->dropped;
}

void LogWriter::run(const std::shared_ptr<State>& state) {
  std::unique_lock lock(state->mutex);
  while (true) {
    state->lines_came.wait(lock, [&] { return state->finished || !state->lines.empty(); });
    if (state->finished) return;  // the remaining lines were not written in time
    const std::uint64_t unreported = std::exchange(state->dropped_unreported, 0);
    Line line = std::move(state->lines.front());
    state->lines.pop_front();
    const std::shared_ptr<const Write> write = state->write;
    state->writing = true;
    lock.unlock();
    const bool reported = unreported == 0 || (*write)(state->note(unreported));
    const bool written = (*write)(line);
    lock.lock();
    state->writing = false;
    if (!reported) state->dropped_unreported += unreported;
    if (!written) state->drop_one();
    if (state->lines.empty()) state->all_written.notify_all();
  }
}

}  // namespace pharos::host
