// SPDX-License-Identifier: Apache-2.0
// Any bytes as an image file, or as the content of a slot. First byte of the input: which.
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "pharos/boot_image/slot.hpp"
#include "pharos/signature/sha2.hpp"
#include "support/require.hpp"

namespace {

using pharos::test::require;
using namespace pharos::boot_image;
using Input = std::span<const std::uint8_t>;

/// An accepted image equals the result of sealing it again.
void check_file(Input file) {
  const auto header = check_image(file);
  if (!header) return;
  const Input body = file.subspan(kPageBytes);
  require(header->body_bytes == body.size());
  require(header->entry_address - header->load_address < header->body_bytes);
  const BootImageHeader again = sealed(*header, body);
  require(std::memcmp(&again, file.data(), sizeof again) == 0);
}

/// Any header and body, sealed: a file that is accepted, unless a field is invalid.
void check_sealed(Input input) {
  BootImageHeader header;
  if (input.size() < sizeof header + 4) return;
  std::memcpy(&header, input.data(), sizeof header);
  Input body = input.subspan(sizeof header);
  body = body.first(body.size() / 4 * 4);
  header.load_address &= ~3u;
  header.entry_address = header.load_address;
  header = sealed(header, body);
  std::vector<std::uint8_t> file(kPageBytes, 0xFF);
  SealedHeader image{header, {pharos::signature::sha256(body), {}}};
  std::memcpy(file.data(), &image, sizeof image);
  file.insert(file.end(), body.begin(), body.end());
  const BootImageError fault = check_image(file).error();
  require(fault == BootImageError::kNone || fault == BootImageError::kBadHeader);
  SlotHead head{image, make_mark(image, 7)};
  require(sequence_of(head) == 7);
  head.mark.sequence ^= 1;
  require(sequence_of(head) == 0);
}

void check_slot(Input input) {
  SlotHead head;
  if (input.size() < sizeof head) return;
  std::memcpy(&head, input.data(), sizeof head);
  const std::uint32_t sequence = sequence_of(head);
  if (sequence != 0) require(make_mark(head.image, sequence).check == head.mark.check);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Input input(data, size);
  if (input.empty()) return 0;
  const Input rest = input.subspan(1);
  switch (input.front() % 3) {
    case 0:
      check_file(rest);
      break;
    case 1:
      check_sealed(rest);
      break;
    default:
      check_slot(rest);
  }
  return 0;
}
