// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/vocabulary.hpp"

#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "host/support/input_error.hpp"

namespace pharos::slam {
namespace {

// "PHAROSVW", version, number of nodes; nodes; CRC-32 of all before. Little-endian.
constexpr std::array<char, 8> kMagic{'P', 'H', 'A', 'R', 'O', 'S', 'V', 'W'};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeader = 16;
constexpr std::size_t kNode = 32 + 4 + 4 + 4;
constexpr std::size_t kCrc = 4;
static_assert(std::endian::native == std::endian::little);

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw host::InputError(name + ": " + what + "; train one with `pharos vocabulary`, or install Pharos again");
}

template <class Value>
void put(std::vector<std::uint8_t>& out, const Value& value) {
  std::array<std::uint8_t, sizeof(Value)> raw{};
  std::memcpy(raw.data(), &value, sizeof(value));
  for (const std::uint8_t byte : raw) out.push_back(byte);
}

template <class Value>
Value take(std::span<const std::uint8_t> bytes, std::size_t& at) {
  Value value{};
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  at += sizeof(value);
  return value;
}

std::uint32_t crc_of(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(crc32(0L, bytes.data(), static_cast<uInt>(bytes.size())));
}

// Children follow their parent and every node has one parent, so that each descent ends.
void check_tree(const std::vector<Vocabulary::Node>& nodes, const std::string& name) {
  std::int64_t next = 1;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vocabulary::Node& node = nodes[k];
    if (!std::isfinite(node.weight) || node.weight < 0.0F) refuse(name, "a word's weight is no number");
    if (node.first_child < 0) continue;
    if (node.first_child != next || node.children < 1 || node.children > Vocabulary::kMaxBranches ||
        node.first_child <= static_cast<std::int64_t>(k)) {
      refuse(name, "the tree of words is damaged");
    }
    next += node.children;
  }
  if (next != static_cast<std::int64_t>(nodes.size())) refuse(name, "the tree of words is damaged");
}

}  // namespace

std::vector<std::uint8_t> Vocabulary::bytes() const {
  std::vector<std::uint8_t> out;
  out.reserve(kHeader + nodes_.size() * kNode + kCrc);
  for (const char letter : kMagic) out.push_back(static_cast<std::uint8_t>(letter));
  put(out, kVersion);
  put(out, static_cast<std::uint32_t>(nodes_.size()));
  for (const Node& node : nodes_) {
    put(out, node.descriptor.bits);
    put(out, node.first_child);
    put(out, node.children);
    put(out, node.weight);
  }
  put(out, crc_of(out));
  return out;
}

Vocabulary Vocabulary::parse(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.size() < kHeader + kCrc || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) {
    refuse(name, "no vocabulary of visual words");
  }
  std::size_t at = kMagic.size();
  if (take<std::uint32_t>(bytes, at) != kVersion) refuse(name, "a vocabulary of another version");
  const auto count = static_cast<std::size_t>(take<std::uint32_t>(bytes, at));
  if (count == 0 || count > kMaxNodes) refuse(name, "the number of words is out of range");
  const std::size_t whole = kHeader + count * kNode + kCrc;
  if (bytes.size() != whole) {
    refuse(name, (bytes.size() < whole ? "cut short: " : "too long: ") + std::to_string(bytes.size()) + " bytes of " +
                     std::to_string(whole));
  }
  std::size_t end = whole - kCrc;
  if (take<std::uint32_t>(bytes, end) != crc_of(bytes.first(whole - kCrc))) refuse(name, "damaged (its CRC is wrong)");
  Vocabulary vocabulary;
  for (std::size_t k = 0; k < count; ++k) {
    Node node;
    node.descriptor.bits = take<std::array<std::uint64_t, 4>>(bytes, at);
    node.first_child = take<std::int32_t>(bytes, at);
    node.children = take<std::int32_t>(bytes, at);
    node.weight = take<float>(bytes, at);
    vocabulary.nodes_.push_back(node);
  }
  check_tree(vocabulary.nodes_, name);
  return vocabulary;
}

Vocabulary Vocabulary::read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, "cannot be read");
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return parse(bytes, path);
}

int Vocabulary::word_of(const Descriptor& descriptor) const {
  std::int32_t at = 0;
  while (nodes_[static_cast<std::size_t>(at)].first_child >= 0) {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    int minimum = 257;
    for (std::int32_t child = node.first_child; child < node.first_child + node.children; ++child) {
      const int d = distance(descriptor, nodes_[static_cast<std::size_t>(child)].descriptor);
      if (d < minimum) {
        minimum = d;
        at = child;
      }
    }
  }
  return at;
}

std::map<int, double> Vocabulary::words_of(std::span<const Descriptor> descriptors) const {
  std::map<int, double> words;
  double sum = 0.0;
  for (const Descriptor& descriptor : descriptors) {
    const int word = word_of(descriptor);
    const auto weight = static_cast<double>(nodes_[static_cast<std::size_t>(word)].weight);
    if (weight <= 0.0) continue;
    words[word] += weight;
    sum += weight;
  }
  for (auto& [word, weight] : words) weight /= sum;
  return words;
}

std::size_t Vocabulary::words() const {
  std::size_t count = 0;
  for (const Node& node : nodes_) count += node.first_child < 0 ? 1U : 0U;
  return count;
}

std::string shipped_vocabulary_path() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const std::filesystem::path& place :
       {folder, folder.parent_path() / "share" / "pharos", folder.parent_path() / "bin"}) {
    if (std::filesystem::exists(place / "orb.words", error)) return (place / "orb.words").string();
  }
  return (folder / "orb.words").string();
}

}  // namespace pharos::slam
