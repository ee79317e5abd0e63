// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/vision/slam/descriptor.hpp"

namespace pharos::slam {

/// A tree of visual words: each node's descriptor is the median of those below it; a leaf is a word, weighted by its
/// rarity in images (TF-IDF). After Galvez-Lopez and Tardos 2012, Nister and Stewenius 2006.
class Vocabulary {
 public:
  static constexpr int kMaxBranches = 32;
  static constexpr int kMaxDepth = 8;
  static constexpr std::size_t kMaxNodes = std::size_t{1} << 20;

  struct Node {
    Descriptor descriptor;
    std::int32_t first_child = -1;  ///< children are contiguous; -1: a word
    std::int32_t children = 0;
    float weight = 0.0F;  ///< of a word: log(images / images that contain it)
  };

  /// By k-medians with the start values of k-means++ (Arthur 2007): the descriptors of each image; `branches` children
  /// a node, `depth` levels. Deterministic for the same input and seed.
  static Vocabulary train(const std::vector<std::vector<Descriptor>>& images, int branches, int depth,
                          std::uint64_t seed);
  /// Throws InputError for bytes that are not a complete vocabulary: truncated, too long, damaged (checked by a
  /// CRC-32). `name` is for messages.
  static Vocabulary parse(std::span<const std::uint8_t> bytes, const std::string& name);
  static Vocabulary read(const std::string& path);
  std::vector<std::uint8_t> bytes() const;

  /// The word of a descriptor: its leaf's number among all nodes.
  int word_of(const Descriptor& descriptor) const;
  /// Weights of the words of an image, scaled to a sum of 1. Words with weight 0 are omitted.
  std::map<int, double> words_of(std::span<const Descriptor> descriptors) const;
  std::size_t words() const;
  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  std::vector<Node> nodes_;
};

/// The vocabulary that ships with Pharos: beside the program's build tree or where it is installed.
std::string shipped_vocabulary_path();

}  // namespace pharos::slam
