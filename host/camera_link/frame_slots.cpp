// SPDX-License-Identifier: Apache-2.0
#include "host/camera_link/frame_slots.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace pharos::host {
namespace {

constexpr std::size_t kPage_bytes = 4096;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

std::size_t whole_pages(std::size_t bytes) { return (bytes + kPage_bytes - 1) / kPage_bytes * kPage_bytes; }

UniqueFd sealed_memory(std::size_t bytes) {
  UniqueFd fd(::memfd_create("pharos-camera", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!fd.valid() || ::ftruncate(fd.get(), static_cast<off_t>(bytes)) != 0) fail("shared memory for frames");
  if (::fcntl(fd.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0) fail("F_ADD_SEALS");
  return fd;
}

/// The descriptor, if its memory has at least `bytes`.
int checked(int fd, std::size_t bytes) {
  struct stat about {};
  if (::fstat(fd, &about) != 0) fail("shared memory for frames");
  if (about.st_size >= 0 && static_cast<std::size_t>(about.st_size) >= bytes) return fd;
  throw std::system_error(std::make_error_code(std::errc::invalid_argument), "shared memory is too small");
}

std::atomic_ref<std::uint64_t> sequence_at(std::byte* slot) {
  static_assert(std::atomic_ref<std::uint64_t>::is_always_lock_free);
  return std::atomic_ref(*reinterpret_cast<std::uint64_t*>(slot));
}

}  // namespace

std::size_t SlotLayout::slot_bytes() const {
  return kPage_bytes + whole_pages(pixels() * sizeof(std::uint16_t) * (has_depth ? 2 : 1));
}

SharedMapping::SharedMapping(int fd, std::size_t bytes, bool writable) : bytes_(bytes) {
  void* const start = ::mmap(nullptr, bytes, PROT_READ | (writable ? PROT_WRITE : 0), MAP_SHARED, fd, 0);
  if (start == MAP_FAILED) fail("mmap of frames");
  start_ = static_cast<std::byte*>(start);
}

SharedMapping::~SharedMapping() { ::munmap(start_, bytes_); }

FrameSlotWriter::FrameSlotWriter(int fd, const SlotLayout& layout)
    : layout_(layout), memory_(checked(fd, layout.bytes()), layout.bytes(), true) {}

FrameImages FrameSlotWriter::begin() {
  std::byte* const slot = memory_.at((sequence_ + 1) % SlotLayout::kSlots * layout_.slot_bytes());
  sequence_at(slot).store(0, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);  // pixels are written after the sequence is cleared
  auto* const pixels = reinterpret_cast<std::uint16_t*>(slot + kPage_bytes);
  const std::size_t depth_pixels = layout_.has_depth ? layout_.pixels() : 0;
  return {{pixels, depth_pixels}, {pixels + depth_pixels, layout_.pixels()}};
}

std::uint64_t FrameSlotWriter::publish() {
  ++sequence_;
  std::byte* const slot = memory_.at(sequence_ % SlotLayout::kSlots * layout_.slot_bytes());
  sequence_at(slot).store(sequence_, std::memory_order_release);
  return sequence_;
}

FrameSlotReader::FrameSlotReader(const SlotLayout& layout)
    : layout_(layout), fd_(sealed_memory(layout.bytes())), memory_(fd_.get(), layout.bytes(), false) {}

bool FrameSlotReader::copy(std::uint64_t sequence, DepthFrame& frame) const {
  std::byte* const slot = memory_.at(sequence % SlotLayout::kSlots * layout_.slot_bytes());
  const std::atomic_ref<std::uint64_t> holds = sequence_at(slot);
  if (sequence == 0 || holds.load(std::memory_order_acquire) != sequence) return false;
  if (layout_.has_depth) {
    frame.resize(layout_.width_px, layout_.height_px);
  } else {
    frame.resize_grey(layout_.width_px, layout_.height_px);
  }
  const std::byte* pixels = slot + kPage_bytes;
  for (std::vector<std::uint16_t>* image : {&frame.depth, &frame.intensity}) {
    const std::size_t bytes = image->size() * sizeof(std::uint16_t);
    if (bytes > 0) std::memcpy(image->data(), pixels, bytes);
    pixels += bytes;
  }
  std::atomic_thread_fence(std::memory_order_acquire);  // pixels are read before the sequence is checked again
  return holds.load(std::memory_order_relaxed) == sequence;
}

}  // namespace pharos::host
