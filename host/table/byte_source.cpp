// SPDX-License-Identifier: Apache-2.0
#include "host/table/byte_source.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

constexpr std::size_t kChunk = 128 * 1024;
// Window bits of inflateInit2: 15 (the largest window) plus 16 for a gzip header.
constexpr int kGzipWindowBits = 15 + 16;

bool has_gzip_magic(std::string_view bytes) { return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b'; }

}  // namespace

class ByteSource::Impl {
 public:
  explicit Impl(const std::string& path) : name_(path == "-" ? "standard input" : path), chunk_(kChunk) {
    fd_ = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd_ < 0) throw InputError(name_ + ": cannot be opened: " + std::strerror(errno) + "; check the path");
    load_first_bytes();
    if (!has_gzip_magic(raw_)) return;
    gzip_ = true;
    if (inflateInit2(&stream_, kGzipWindowBits) != Z_OK) throw InputError(name_ + ": no memory to unpack it");
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (gzip_) inflateEnd(&stream_);
    if (fd_ > STDIN_FILENO) ::close(fd_);
  }

  std::size_t read(std::span<char> out) {
    if (!pending_.empty()) {
      const std::size_t count = std::min(out.size(), pending_.size());
      std::copy_n(pending_.begin(), count, out.begin());
      pending_.erase(0, count);
      return count;
    }
    return gzip_ ? inflate_some(out) : plain_some(out);
  }

  std::string_view peek(std::size_t count) {
    std::array<char, 4096> bytes;
    std::string head = std::move(pending_);
    pending_.clear();
    while (head.size() < count) {
      const std::size_t got = read(bytes);
      if (got == 0) break;
      head.append(bytes.data(), got);
    }
    pending_ = std::move(head);
    return pending_;
  }

  std::int64_t skip(std::int64_t count) {
    std::array<char, 65536> bytes;
    std::int64_t skipped = 0;
    while (skipped < count) {
      // Behind what was read already a plain file's place is moved; a pipe has none.
      const bool at_file = !gzip_ && pending_.empty() && raw_.empty();
      if (at_file && ::lseek(fd_, count - skipped, SEEK_CUR) >= 0) return count;
      const auto wanted = static_cast<std::size_t>(std::min<std::int64_t>(count - skipped, bytes.size()));
      const std::size_t got = read(std::span(bytes).first(wanted));
      if (got == 0) break;
      skipped += static_cast<std::int64_t>(got);
    }
    return skipped;
  }

  void on_pause(std::function<void()> before_waiting) { before_waiting_ = std::move(before_waiting); }
  bool cut_off() const { return cut_off_; }
  const std::string& name() const { return name_; }

 private:
  bool would_wait() const {
    pollfd input{fd_, POLLIN, 0};
    return ::poll(&input, 1, 0) == 0;
  }

  std::size_t read_fd(char* out, std::size_t size) {
    if (before_waiting_ && would_wait()) before_waiting_();
    for (;;) {
      const ssize_t got = ::read(fd_, out, size);
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR)
        throw InputError(name_ + ": cannot be read: " + std::strerror(errno) + "; give a readable file");
    }
  }

  // Two bytes identify gzip; a pipe may deliver them one by one.
  void load_first_bytes() {
    std::size_t have = 0;
    while (have < 2) {
      const std::size_t got = read_fd(chunk_.data() + have, chunk_.size() - have);
      if (got == 0) break;
      have += got;
    }
    raw_ = {chunk_.data(), have};
  }

  std::size_t plain_some(std::span<char> out) {
    if (raw_.empty()) return read_fd(out.data(), out.size());
    const std::size_t count = std::min(out.size(), raw_.size());
    std::copy_n(raw_.begin(), count, out.begin());
    raw_.remove_prefix(count);
    return count;
  }

  bool refill() {
    if (!raw_.empty()) return true;
    const std::size_t got = read_fd(chunk_.data(), chunk_.size());
    raw_ = {chunk_.data(), got};
    return got > 0;
  }

  std::size_t inflate_some(std::span<char> out) {
    stream_.next_out = reinterpret_cast<Bytef*>(out.data());
    stream_.avail_out = static_cast<uInt>(out.size());
    while (stream_.avail_out == out.size() && !ended_) {
      if (!refill()) {
        cut_off_ = inside_member_;
        ended_ = true;
        break;
      }
      inflate_step();
    }
    return out.size() - stream_.avail_out;
  }

  void inflate_step() {
    // A gzip file may hold several members one after the other (cat a.gz b.gz).
    if (!inside_member_) inflateReset(&stream_);
    inside_member_ = true;
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(raw_.data()));
    stream_.avail_in = static_cast<uInt>(raw_.size());
    const int status = inflate(&stream_, Z_NO_FLUSH);
    raw_ = raw_.substr(raw_.size() - stream_.avail_in);
    if (status == Z_STREAM_END) {
      inside_member_ = false;
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      throw InputError(name_ + ": broken gzip data; check the file with gzip -t");
    }
  }

  std::string name_;
  int fd_ = -1;
  std::function<void()> before_waiting_;
  std::vector<char> chunk_;
  std::string_view raw_;  // into chunk_: read from the file, not yet returned or inflated
  std::string pending_;   // peeked
  z_stream stream_{};
  bool gzip_ = false;
  bool inside_member_ = false;
  bool ended_ = false;
  bool cut_off_ = false;
};

ByteSource::ByteSource(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
ByteSource::~ByteSource() = default;
ByteSource::ByteSource(ByteSource&&) noexcept = default;
ByteSource& ByteSource::operator=(ByteSource&&) noexcept = default;
std::size_t ByteSource::read(std::span<char> out) { return impl_->read(out); }
std::int64_t ByteSource::skip(std::int64_t count) { return impl_->skip(count); }
std::string_view ByteSource::peek(std::size_t count) { return impl_->peek(count); }
void ByteSource::on_pause(std::function<void()> before_waiting) { impl_->on_pause(std::move(before_waiting)); }
bool ByteSource::cut_off() const { return impl_->cut_off(); }
const std::string& ByteSource::name() const { return impl_->name(); }

}  // namespace pharos::host
