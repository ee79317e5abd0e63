// SPDX-License-Identifier: Apache-2.0
// Any bytes as a vocabulary: one that finds a word for every descriptor and is read back bit by bit, or an error.
#include <cstdlib>
#include <vector>

#include "host/support/input_error.hpp"
#include "host/vision/slam/vocabulary.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using pharos::slam::Vocabulary;
  const std::vector<std::uint8_t> bytes(data, data + size);
  try {
    const Vocabulary vocabulary = Vocabulary::parse(bytes, "input");
    const auto word = static_cast<std::size_t>(vocabulary.word_of({{1, 2, 3, 4}}));
    if (word >= vocabulary.nodes().size() || vocabulary.bytes() != bytes) std::abort();
  } catch (const pharos::host::InputError&) {
  }
  return 0;
}
