// SPDX-License-Identifier: Apache-2.0
#include "host/gige/stream_filter.hpp"

#include <sys/socket.h>

#include <algorithm>

namespace pharos::host {
namespace {

// A UDP socket's filter sees the UDP header first; the IP header is found through SKF_NET_OFF.
constexpr std::uint32_t kUdp_bytes = 8;
constexpr std::uint32_t kIp_bytes = 20;
constexpr auto kSourceAddressAt = static_cast<std::uint32_t>(SKF_NET_OFF) + 12;
constexpr std::uint32_t kSourcePortAt = 0;
// GVSP header: status u16, block u16, extended-id bit and content type u8, packet u24; with extended ids also block u64
// and packet u32.
constexpr std::uint32_t kStatusAt = kUdp_bytes;
constexpr std::uint32_t kBlockAt = kUdp_bytes + 2;
constexpr std::uint32_t kTypeAt = kUdp_bytes + 4;
constexpr std::uint32_t kHead_bytes = 8;
constexpr std::uint32_t kExtendedHead_bytes = 20;
constexpr std::uint32_t kExtendedPacketAt = kUdp_bytes + 16;
constexpr std::uint32_t kExtendedBit = 0x80;
constexpr std::uint32_t kPacketMask = 0xFFFFFF;
constexpr std::uint32_t kLeader = 1;
constexpr std::uint32_t kTrailer = 2;
constexpr std::uint32_t kData = 3;
constexpr std::uint32_t kLeader_bytes = 36;  // of an image
constexpr std::uint32_t kPayloadTypeInLeaderAt = 2;
constexpr std::uint32_t kImage = 1;
constexpr std::uint32_t kResent = 0x0100;
constexpr std::uint32_t kRefusal = 0x8000;  // of a resend: 0x800C and similar codes
constexpr std::uint32_t kRefusalMask = 0xFFE0;
constexpr std::uint16_t kControlPort = 3956;
constexpr std::uint32_t kMaxControl_bytes = 1024;  // Aravis' buffer

/// Builds a classic BPF program; a condition that does not hold jumps to the end, which drops the datagram.
class Filter {
 public:
  void load_word(std::uint32_t at) { add(BPF_LD | BPF_W | BPF_ABS, at); }
  void load_half(std::uint32_t at) { add(BPF_LD | BPF_H | BPF_ABS, at); }
  void load_byte(std::uint32_t at) { add(BPF_LD | BPF_B | BPF_ABS, at); }
  void load_length() { add(BPF_LD | BPF_W | BPF_LEN, 0); }
  void mask(std::uint32_t bits) { add(BPF_ALU | BPF_AND | BPF_K, bits); }
  void accept() { add(BPF_RET | BPF_K, 0xFFFFFFFF); }

  void require_equal(std::uint32_t value) { add(BPF_JMP | BPF_JEQ | BPF_K, value, 0, kDrop); }
  void require_not(std::uint32_t value) { add(BPF_JMP | BPF_JEQ | BPF_K, value, kDrop, 0); }
  void require_min(std::uint32_t value) { add(BPF_JMP | BPF_JGE | BPF_K, value, 0, kDrop); }
  void require_max(std::uint32_t value) { add(BPF_JMP | BPF_JGT | BPF_K, value, kDrop, 0); }
  void require_bits(std::uint32_t bits, bool set) {
    add(BPF_JMP | BPF_JSET | BPF_K, bits, set ? 0 : kDrop, set ? kDrop : 0);
  }
  /// If the loaded number is `value`, runs the instructions that `then` adds, which must end in accept(); otherwise
  /// continues after them.
  template <class Then>
  void if_equal(std::uint32_t value, Then then) {
    conditional(BPF_JEQ, value, then);
  }
  template <class Then>
  void if_bits(std::uint32_t bits, Then then) {
    conditional(BPF_JSET, bits, then);
  }

  std::vector<sock_filter> finish() {
    const std::size_t drop = code_.size();
    for (std::size_t i = 0; i < drop; ++i) {
      if (BPF_CLASS(code_[i].code) != BPF_JMP) continue;
      for (std::uint8_t* jump : {&code_[i].jt, &code_[i].jf}) {
        if (*jump == kDrop) *jump = static_cast<std::uint8_t>(drop - i - 1);
      }
    }
    add(BPF_RET | BPF_K, 0);
    return std::move(code_);
  }

 private:
  static constexpr std::uint8_t kDrop = 0xFF;  // programs are far shorter than 255 instructions

  void add(int code, std::uint32_t value, std::uint8_t yes = 0, std::uint8_t no = 0) {
    code_.push_back({static_cast<std::uint16_t>(code), yes, no, value});
  }
  template <class Then>
  void conditional(int test, std::uint32_t value, Then then) {
    const std::size_t jump = code_.size();
    add(BPF_JMP | test | BPF_K, value, 0, 0);
    then();
    code_[jump].jf = static_cast<std::uint8_t>(code_.size() - jump - 1);
  }

  std::vector<sock_filter> code_;
};

/// Checks for one kind of header; `load_packet` loads the packet's number.
template <class LoadPacket>
void check_packets(Filter& filter, const StreamRule& rule, std::uint32_t head_bytes, LoadPacket load_packet) {
  const auto block_bytes = static_cast<std::uint32_t>(rule.packet_size) - kIp_bytes - kUdp_bytes - head_bytes;
  const auto packets = static_cast<std::uint32_t>((rule.payload_bytes + block_bytes - 1) / block_bytes);
  const std::uint32_t data_at = kUdp_bytes + head_bytes;
  filter.load_length();
  filter.require_min(data_at);
  filter.require_max(data_at + std::max(block_bytes, kLeader_bytes));
  filter.load_half(kStatusAt);
  filter.mask(kRefusalMask);
  filter.if_equal(kRefusal, [&] {
    load_packet();
    filter.require_max(packets + 1);
    filter.accept();
  });
  filter.load_half(kStatusAt);
  filter.mask(~kResent);
  filter.require_equal(0);
  filter.load_byte(kTypeAt);
  filter.mask(~kExtendedBit);
  filter.if_equal(kLeader, [&] {
    load_packet();
    filter.require_equal(0);
    filter.load_length();
    filter.require_min(data_at + kLeader_bytes);
    filter.load_half(data_at + kPayloadTypeInLeaderAt);
    filter.require_equal(kImage);
    filter.accept();
  });
  filter.if_equal(kTrailer, [&] {
    load_packet();
    filter.require_min(1);
    filter.require_max(packets + 1);
    filter.accept();
  });
  filter.require_equal(kData);
  load_packet();
  filter.require_min(1);
  filter.require_max(packets);
  filter.load_length();
  filter.require_min(data_at + 1);
  filter.require_max(data_at + block_bytes);
  filter.accept();
}

}  // namespace

std::vector<sock_filter> stream_filter(const StreamRule& rule) {
  Filter filter;
  filter.load_word(kSourceAddressAt);
  filter.require_equal(rule.camera_address);
  if (rule.source_port) {
    filter.load_half(kSourcePortAt);
    filter.require_equal(*rule.source_port);
  }
  filter.load_length();
  filter.require_min(kUdp_bytes + kHead_bytes);
  filter.load_byte(kTypeAt);
  if (rule.extended_ids) filter.require_bits(kExtendedBit, *rule.extended_ids);
  if (rule.extended_ids.value_or(true)) {
    filter.if_bits(kExtendedBit, [&] {
      check_packets(filter, rule, kExtendedHead_bytes, [&] { filter.load_word(kExtendedPacketAt); });
    });
  }
  filter.load_half(kBlockAt);
  filter.require_not(0);
  check_packets(filter, rule, kHead_bytes, [&] {
    filter.load_word(kTypeAt);
    filter.mask(kPacketMask);
  });
  return filter.finish();
}

std::vector<sock_filter> control_filter(std::uint32_t camera_address) {
  Filter filter;
  filter.load_word(kSourceAddressAt);
  filter.require_equal(camera_address);
  filter.load_half(kSourcePortAt);
  filter.require_equal(kControlPort);
  filter.load_length();
  filter.require_max(kUdp_bytes + kMaxControl_bytes);
  filter.accept();
  return filter.finish();
}

bool attach_filter(int socket, std::vector<sock_filter> filter) {
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  return ::setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) == 0;
}

}  // namespace pharos::host
