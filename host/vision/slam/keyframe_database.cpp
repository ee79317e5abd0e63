// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/keyframe_database.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::slam {
namespace {

constexpr double kShareOfWords = 0.8;
constexpr double kShareOfScore = 0.75;
constexpr std::size_t kGroup = 10;

}  // namespace

WordVector KeyframeDatabase::words_of(const std::vector<Feature>& features) const {
  std::vector<Descriptor> descriptors;
  descriptors.reserve(features.size());
  for (const Feature& feature : features) descriptors.push_back(feature.descriptor);
  return vocabulary_.words_of(descriptors);
}

void KeyframeDatabase::add(const Keyframe& keyframe) {
  for (const auto& [word, weight] : keyframe.words) seen_in_[word].insert(keyframe.id);
}

void KeyframeDatabase::remove(const Keyframe& keyframe) {
  for (const auto& [word, weight] : keyframe.words) {
    const auto at = seen_in_.find(word);
    if (at == seen_in_.end()) continue;
    at->second.erase(keyframe.id);
    if (at->second.empty()) seen_in_.erase(at);
  }
}

double KeyframeDatabase::score(const WordVector& a, const WordVector& b) {
  // Of vectors of length 1: sum of |a| + |b| - |a - b| over common words, halved (Nister 2006).
  double sum = 0.0;
  for (auto x = a.begin(), y = b.begin(); x != a.end() && y != b.end();) {
    if (x->first < y->first) {
      ++x;
    } else if (y->first < x->first) {
      ++y;
    } else {
      sum += x->second + y->second - std::abs(x->second - y->second);
      ++x;
      ++y;
    }
  }
  return 0.5 * sum;
}

std::vector<KeyframeDatabase::KeyframeScore> KeyframeDatabase::detect_candidates(
    const WordVector& words, const Map& map, const std::set<KeyframeId>& but) const {
  std::map<KeyframeId, int> common;
  for (const auto& [word, weight] : words) {
    const auto at = seen_in_.find(word);
    if (at == seen_in_.end()) continue;
    for (const KeyframeId id : at->second) {
      if (!but.contains(id) && map.keyframes.contains(id)) ++common[id];
    }
  }
  int maximum = 0;
  for (const auto& [id, count] : common) maximum = std::max(maximum, count);
  std::map<KeyframeId, double> scores;
  for (const auto& [id, count] : common) {
    if (count >= kShareOfWords * maximum) scores[id] = score(words, map.keyframes.at(id).words);
  }
  std::map<KeyframeId, double> groups;
  double highest = 0.0;
  for (const auto& [id, own] : scores) {
    double sum = own, best = own;
    KeyframeId named = id;
    for (const KeyframeId other : map.best_neighbours(id, kGroup)) {
      const auto at = scores.find(other);
      if (at == scores.end()) continue;
      sum += at->second;
      if (at->second > best) {
        best = at->second;
        named = other;
      }
    }
    double& kept = groups[named];
    kept = std::max(kept, sum);
    highest = std::max(highest, sum);
  }
  std::vector<KeyframeScore> found;
  for (const auto& [id, sum] : groups) {
    if (sum >= kShareOfScore * highest) found.push_back({id, sum});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const KeyframeScore& a, const KeyframeScore& b) { return a.score > b.score; });
  return found;
}

}  // namespace pharos::slam
