// SPDX-License-Identifier: Apache-2.0
#include "tools/support/progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace pharos::tools {
namespace {

constexpr std::chrono::milliseconds kRenewal{500};
// Reading the clock costs more than processing a pulse; once in so many steps suffices when the total is unknown and
// more than so many were done: fewer may take long each.
constexpr std::size_t kStepsPerLook = 4096;

}  // namespace

Progress::Progress(std::string what, std::string units, std::size_t total)
    : what_(std::move(what)),
      units_(std::move(units)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      next_(std::chrono::steady_clock::now() + kRenewal) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::step(std::size_t count) {
  done_ += count;
  if (!terminal_) return;
  if (total_ == 0 && done_ > kStepsPerLook && done_ - looked_at_clock_ < kStepsPerLook) return;
  looked_at_clock_ = done_;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kRenewal;
  show();
}

void Progress::show() {
  shown_ = true;
  if (total_ > 0) {
    std::fprintf(stderr, "\r\033[K%s: %zu of %zu %s", what_.c_str(), done_, total_, units_.c_str());
  } else {
    std::fprintf(stderr, "\r\033[K%s: %zu %s", what_.c_str(), done_, units_.c_str());
  }
  std::fflush(stderr);
}

}  // namespace pharos::tools
