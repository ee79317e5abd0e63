// SPDX-License-Identifier: Apache-2.0
#include "tools/convert/framed_turns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pharos::convert {
namespace {

// An angle is logged within three turns of its light, and its light's frame at most so long after it.
constexpr double kBefore_s = 0.07, kAfter_s = 0.003;
// Two turns of a plane are a turn apart.
constexpr double kNextTurn = 0.5;
constexpr std::size_t kMinVotes = 2;  // the angle that proposed a turn is one
// By chance two angles fit light of other sweeps, four do not: with so many a turn says when later ones begin. A rotor
// turns evenly to 20 us within a second.
constexpr std::size_t kSureVotes = 4;
constexpr double kEven_s = 20e-6, kEvenWithin_s = 1.0;

double since_s(const AngleKey& key, double angle_rad, double period_s) {
  return turns_of(2, key[1], angle_rad) * period_s;
}

/// What speaks for a turn: new angles count before those that were logged before.
struct Vote {
  std::size_t fresh = 0, all = 0;
  double begin_s = 0.0;  // the board's clock; of equals the latest

  bool operator<(const Vote& other) const {
    if (fresh != other.fresh) return fresh < other.fresh;
    if (all != other.all) return all < other.all;
    return begin_s < other.begin_s;
  }
};

/// A station's turns so far.
class Turns {
 public:
  Turns(const FrameClock& clock, double period_s) : clock_(clock), period_s_(period_s) {}

  double light_s(double begin_s, const AngleKey& key, double angle_rad) const {
    return begin_s + since_s(key, angle_rad, period_s_);
  }
  /// Whether an angle had its light in a turn after the last one of its plane.
  bool lit(double begin_s, const AngleKey& key, double angle_rad) const {
    return begin_s > last_s_[key[1]] + kNextTurn * period_s_ && clock_.saw(key[0], light_s(begin_s, key, angle_rad));
  }
  /// The turn of most votes, whole turns after the last sure one; empty where no light fits.
  std::optional<Vote> best(double logged_s, const Angles& fresh, const Angles& all) const {
    std::optional<Vote> best;
    for (const auto& [key, angle_rad] : all) {
      for (const double light_s : clock_.light_of(key[0], logged_s - kBefore_s, logged_s + kAfter_s)) {
        const double begin_s = light_s - since_s(key, angle_rad, period_s_);
        if (!even(begin_s)) continue;
        const Vote vote{votes(begin_s, fresh), votes(begin_s, all), begin_s};
        if (vote.all > 0 && (!best || *best < vote)) best = vote;
      }
    }
    return best;
  }
  void used(double begin_s, std::size_t hits, const std::array<bool, 2>& planes) {
    if (hits >= kSureVotes) sure_s_ = begin_s;
    for (std::size_t k = 0; k < planes.size(); ++k) {
      if (planes[k]) last_s_[k] = begin_s;
    }
  }

 private:
  bool even(double begin_s) const {
    const double apart_s = begin_s - sure_s_;
    if (std::abs(apart_s) > kEvenWithin_s) return true;
    return std::abs(apart_s - std::round(apart_s / period_s_) * period_s_) < kEven_s;
  }
  std::size_t votes(double begin_s, const Angles& angles) const {
    return static_cast<std::size_t>(std::count_if(
        angles.begin(), angles.end(), [&](const auto& angle) { return lit(begin_s, angle.first, angle.second); }));
  }

  const FrameClock& clock_;
  double period_s_;
  std::array<double, 2> last_s_ = {-1e300, -1e300};  // begin of each plane's last turn
  double sure_s_ = -1e300;
};

}  // namespace

std::vector<FramedHit> framed_hits(const FrameClock& clock, double period_s, const std::vector<Block>& blocks,
                                   std::size_t& untimed) {
  Turns turns(clock, period_s);
  std::vector<FramedHit> out;
  for (const Block& block : blocks) {
    Angles fresh = block.angles, all = block.logged;
    // A block may hold one plane of another turn: what the first turn leaves is asked again.
    for (int round = 0; round < 2 && !fresh.empty(); ++round) {
      const auto turn = turns.best(block.logged_s, fresh, round == 0 ? all : fresh);
      if (!turn || turn->fresh == 0 || turn->all < std::min(kMinVotes, block.logged.size())) break;
      std::array<bool, 2> planes{};
      const std::size_t before = out.size();
      std::erase_if(all, [&](const auto& angle) {
        const auto& [key, angle_rad] = angle;
        if (!turns.lit(turn->begin_s, key, angle_rad)) return false;
        out.push_back({clock.log_s(turns.light_s(turn->begin_s, key, angle_rad)), key, angle_rad});
        planes[key[1]] = true;
        fresh.erase(key);
        return true;
      });
      turns.used(turn->begin_s, out.size() - before, planes);
    }
    untimed += fresh.size();
  }
  return out;
}

}  // namespace pharos::convert
