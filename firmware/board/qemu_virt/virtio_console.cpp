// SPDX-License-Identifier: Apache-2.0
#include "firmware/board/qemu_virt/virtio_console.hpp"

#include "firmware/board/rv32/mmio.hpp"

namespace pharos::board {
namespace {

constexpr std::uintptr_t kFirstSlot = 0x10001000;
constexpr std::uintptr_t kSlotBytes = 0x1000;
constexpr int kSlots = 8;

// Registers of a slot.
constexpr std::uintptr_t kMagic = 0x000, kVersion = 0x004, kDevice = 0x008, kGuestFeatures = 0x020;
constexpr std::uintptr_t kGuestPageSize = 0x028, kQueueSelect = 0x030, kQueueSize = 0x038, kQueueAlign = 0x03C;
constexpr std::uintptr_t kQueuePage = 0x040, kQueueNotify = 0x050, kStatus = 0x070;
constexpr std::uint32_t kMagicValue = 0x74726976;  // "virt"
constexpr std::uint32_t kLegacy = 1;
constexpr std::uint32_t kConsole = 3;
constexpr std::uint32_t kAcknowledge = 1, kDriver = 2, kDriverOk = 4;
constexpr std::uint32_t kReceiveQueue = 0;

constexpr std::uint16_t kBuffers = 8;
constexpr std::size_t kBufferBytes = 512;
constexpr std::uint32_t kAlign = 16;
constexpr std::uint16_t kDeviceWrites = 2;

struct Descriptor {
  std::uint32_t address, address_high, size;
  std::uint16_t flags, next;
};
struct Used {
  std::uint32_t buffer, size;
};
// Laid out as the specification asks of a legacy queue aligned to kAlign.
struct Queue {
  Descriptor descriptors[kBuffers];
  std::uint16_t available_flags, available_count, available[kBuffers], available_event;
  alignas(kAlign) std::uint16_t used_flags;
  std::uint16_t used_count;
  Used used[kBuffers];
};

static_assert(offsetof(Queue, used) == 0xA4);

[[gnu::section(".device")]] alignas(kAlign) volatile Queue queue;
[[gnu::section(".device")]] volatile std::uint8_t buffers[kBuffers][kBufferBytes];

void memory_barrier() { asm volatile("fence" ::: "memory"); }
std::uint32_t address_of(const volatile void* object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object));
}

}  // namespace

bool VirtioConsole::start() {
  base_ = 0;
  for (int slot = 0; slot < kSlots; ++slot) {
    const std::uintptr_t base = kFirstSlot + static_cast<std::uintptr_t>(slot) * kSlotBytes;
    if (mmio32(base + kMagic) == kMagicValue && mmio32(base + kVersion) == kLegacy &&
        mmio32(base + kDevice) == kConsole) {
      base_ = base;
    }
  }
  if (base_ == 0) return false;
  mmio32(base_ + kStatus) = 0;
  mmio32(base_ + kStatus) = kAcknowledge | kDriver;
  mmio32(base_ + kGuestFeatures) = 0;
  mmio32(base_ + kGuestPageSize) = kAlign;
  mmio32(base_ + kQueueSelect) = kReceiveQueue;
  mmio32(base_ + kQueueSize) = kBuffers;
  mmio32(base_ + kQueueAlign) = kAlign;
  queue.available_flags = 0;
  queue.available_count = 0;
  queue.used_flags = 0;
  queue.used_count = 0;
  mmio32(base_ + kQueuePage) = address_of(&queue) / kAlign;
  mmio32(base_ + kStatus) = kAcknowledge | kDriver | kDriverOk;
  for (std::uint16_t buffer = 0; buffer < kBuffers; ++buffer) offer(buffer);
  return true;
}

void VirtioConsole::offer(std::uint16_t buffer) {
  volatile Descriptor& descriptor = queue.descriptors[buffer];
  descriptor.address = address_of(buffers[buffer]);
  descriptor.address_high = 0;
  descriptor.size = kBufferBytes;
  descriptor.flags = kDeviceWrites;
  descriptor.next = 0;
  const std::uint16_t count = queue.available_count;
  queue.available[count % kBuffers] = buffer;
  memory_barrier();
  queue.available_count = static_cast<std::uint16_t>(count + 1);
  memory_barrier();
  mmio32(base_ + kQueueNotify) = kReceiveQueue;
}

std::span<const volatile std::uint8_t> VirtioConsole::read(std::size_t maximum) {
  if (at_ == size_) {
    if (size_ != 0) offer(buffer_);
    size_ = at_ = 0;
    memory_barrier();
    if (base_ == 0 || queue.used_count == taken_) return {};
    const volatile Used& used = queue.used[taken_ % kBuffers];
    ++taken_;
    buffer_ = static_cast<std::uint16_t>(used.buffer);
    size_ = used.size;
  }
  const std::size_t begin = at_;
  at_ += size_ - at_ < maximum ? size_ - at_ : maximum;
  return std::span(buffers[buffer_]).subspan(begin, at_ - begin);
}

}  // namespace pharos::board
