// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/pseudo_terminal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "host/support/input_error.hpp"

namespace pharos::sim {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

// No echo, line editing or translation, independent of the settings of the program on the other side.
void make_raw(const std::string& path) {
  const host::UniqueFd slave(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  termios settings{};
  if (!slave.valid() || ::tcgetattr(slave.get(), &settings) != 0) fail("pseudo-terminal");
  ::cfmakeraw(&settings);
  if (::tcsetattr(slave.get(), TCSANOW, &settings) != 0) fail("pseudo-terminal");
}

}  // namespace

PseudoTerminal::PseudoTerminal(fs::path link) : link_(std::move(link)) { plug_in(); }

PseudoTerminal::~PseudoTerminal() { unplug(); }

void PseudoTerminal::plug_in() {
  master_.reset(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  char name[128];
  if (!master_.valid() || ::grantpt(master_.get()) != 0 || ::unlockpt(master_.get()) != 0 ||
      ::ptsname_r(master_.get(), name, sizeof name) != 0) {
    fail("pseudo-terminal");
  }
  path_ = name;
  make_raw(path_);  // after it was opened and closed once, the master can detect whether the port is open
  if (link_.empty()) return;
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(link_, error))) fs::remove(link_, error);
  fs::create_symlink(path_, link_, error);
  if (error) throw host::InputError(link_.string() + ": the link cannot be made: " + error.message());
}

void PseudoTerminal::unplug() {
  if (!master_.valid()) return;
  std::error_code error;
  if (!link_.empty() && fs::read_symlink(link_, error) == fs::path(path_)) fs::remove(link_, error);
  master_.reset();
  path_.clear();
}

bool PseudoTerminal::opened() const {
  if (!master_.valid()) return false;
  pollfd state{master_.get(), 0, 0};
  return ::poll(&state, 1, 0) == 0 || (state.revents & POLLHUP) == 0;
}

std::size_t PseudoTerminal::write(std::span<const std::uint8_t> bytes) {
  if (!opened()) return bytes.size();
  const ssize_t written = ::write(master_.get(), bytes.data(), bytes.size());
  return written > 0 ? static_cast<std::size_t>(written) : 0;
}

std::vector<std::uint8_t> PseudoTerminal::read() {
  std::vector<std::uint8_t> bytes(4096);
  const ssize_t size = opened() ? ::read(master_.get(), bytes.data(), bytes.size()) : 0;
  bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return bytes;
}

}  // namespace pharos::sim
