// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <vector>

#include "host/vision/slam/map.hpp"
#include "host/vision/slam/vocabulary.hpp"

namespace pharos::slam {

/// Place recognition: an inverted index from visual words to keyframes (Galvez-Lopez and Tardos 2012).
class KeyframeDatabase {
 public:
  explicit KeyframeDatabase(Vocabulary vocabulary) : vocabulary_(std::move(vocabulary)) {}

  WordVector words_of(const std::vector<Feature>& features) const;
  void add(const Keyframe& keyframe);
  void remove(const Keyframe& keyframe);

  struct KeyframeScore {
    KeyframeId keyframe = kNone;
    double score = 0.0;  ///< of it and its covisible keyframes together
  };
  /// Keyframes not in `but` that share at least 0.8 of the largest number of words that any shares; scores are summed
  /// over covisible neighbours, and the best of such a group is returned; at least 0.75 of the best score, best first.
  std::vector<KeyframeScore> detect_candidates(const WordVector& words, const Map& map,
                                               const std::set<KeyframeId>& but) const;

  /// 1 - half the sum of |a - b|: 1 for equal vectors, 0 for vectors without a common word.
  static double score(const WordVector& a, const WordVector& b);

 private:
  Vocabulary vocabulary_;
  std::map<int, std::set<KeyframeId>> seen_in_;
};

}  // namespace pharos::slam
