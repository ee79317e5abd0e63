// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <deque>
#include <random>
#include <set>

#include "host/support/input_error.hpp"
#include "host/vision/slam/vocabulary.hpp"

namespace pharos::slam {
namespace {

constexpr int kRounds = 8;  // of k-medians; changes are rare afterwards

using Members = std::vector<const Descriptor*>;

// Median descriptor: each bit by majority.
Descriptor median_of(const Members& members) {
  Descriptor median;
  for (std::size_t bit = 0; bit < 256; ++bit) {
    std::size_t set = 0;
    for (const Descriptor* member : members) set += (member->bits[bit / 64] >> (bit % 64)) & 1U;
    if (2 * set > members.size()) median.bits[bit / 64] |= std::uint64_t{1} << (bit % 64);
  }
  return median;
}

std::vector<Descriptor> start_centres(const Members& members, int branches, std::mt19937_64& random) {
  std::vector<Descriptor> centres{*members[random() % members.size()]};
  std::vector<double> nearest(members.size(), 1e9);
  while (static_cast<int>(centres.size()) < branches) {
    double sum = 0.0;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const double d = distance(*members[k], centres.back());
      nearest[k] = std::min(nearest[k], d * d);
      sum += nearest[k];
    }
    if (!(sum > 0.0)) break;
    double drawn = static_cast<double>(random() >> 11) * 0x1p-53 * sum;
    std::size_t k = 0;
    while (k + 1 < members.size() && (drawn -= nearest[k]) >= 0.0) ++k;
    centres.push_back(*members[k]);
  }
  return centres;
}

std::size_t nearest_of(const Descriptor& descriptor, const std::vector<Descriptor>& centres) {
  std::size_t best = 0;
  for (std::size_t c = 1; c < centres.size(); ++c) {
    if (distance(descriptor, centres[c]) < distance(descriptor, centres[best])) best = c;
  }
  return best;
}

struct Cluster {
  Descriptor centre;
  Members members;
};

std::vector<Cluster> clusters_of(const Members& members, int branches, std::mt19937_64& random) {
  std::vector<Descriptor> centres = start_centres(members, branches, random);
  std::vector<Cluster> clusters;
  for (int round = 0; round < kRounds; ++round) {
    clusters.assign(centres.size(), {});
    for (const Descriptor* member : members) clusters[nearest_of(*member, centres)].members.push_back(member);
    std::erase_if(clusters, [](const Cluster& cluster) { return cluster.members.empty(); });
    std::vector<Descriptor> next;
    for (Cluster& cluster : clusters) {
      cluster.centre = median_of(cluster.members);
      next.push_back(cluster.centre);
    }
    if (next == centres) break;
    centres = std::move(next);
  }
  return clusters;
}

}  // namespace

Vocabulary Vocabulary::train(const std::vector<std::vector<Descriptor>>& images, int branches, int depth,
                             std::uint64_t seed) {
  struct Open {
    std::size_t node;
    int level;
    Members members;
  };
  Vocabulary vocabulary;
  Members all;
  for (const auto& image : images) {
    for (const Descriptor& descriptor : image) all.push_back(&descriptor);
  }
  if (all.empty()) throw host::InputError("the images have no features to train a vocabulary with");
  std::mt19937_64 random(seed);
  vocabulary.nodes_.push_back({median_of(all), -1, 0, 0.0F});
  // Breadth first: the children of a node are contiguous, after those of the nodes before it.
  std::deque<Open> open{{0, 0, std::move(all)}};
  for (; !open.empty(); open.pop_front()) {
    const Open& at = open.front();
    if (at.level == depth || at.members.size() < 2) continue;
    std::vector<Cluster> clusters = clusters_of(at.members, branches, random);
    if (clusters.size() < 2) continue;
    vocabulary.nodes_[at.node].first_child = static_cast<std::int32_t>(vocabulary.nodes_.size());
    vocabulary.nodes_[at.node].children = static_cast<std::int32_t>(clusters.size());
    for (Cluster& cluster : clusters) {
      open.push_back({vocabulary.nodes_.size(), at.level + 1, std::move(cluster.members)});
      vocabulary.nodes_.push_back({cluster.centre, -1, 0, 0.0F});
    }
  }
  std::map<int, std::size_t> shown;
  for (const auto& image : images) {
    std::set<int> words;
    for (const Descriptor& descriptor : image) words.insert(vocabulary.word_of(descriptor));
    for (const int word : words) ++shown[word];
  }
  for (const auto& [word, count] : shown) {
    vocabulary.nodes_[static_cast<std::size_t>(word)].weight =
        static_cast<float>(std::log(static_cast<double>(images.size()) / static_cast<double>(count)));
  }
  return vocabulary;
}

}  // namespace pharos::slam
