// SPDX-License-Identifier: Apache-2.0
// The loader's rules about signatures and versions, with the model board's stand-in for a signature.
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/boot/host.hpp"

namespace pharos::boot::test {
namespace {

class Signing : public ::testing::Test {
 protected:
  bool is_running(const Bytes& image) const {
    const Bytes body = body_of(image);
    return target.runs_application() && std::equal(body.begin(), body.end(), target.machine.memory.begin());
  }

  VirtualTarget target;
  Host host{target};
  const Bytes old_image = make_image(1, {.version = {1, 2, 3}});
  const Bytes new_image = make_image(2, {.body_bytes = 3000, .version = {1, 3, 0}});
};

/// The response to the last step of a flashing.
Reply verified(Host& host, const Bytes& image) {
  if (!host.enter() || !host.begin(image).ack || !host.all_data(image).ack) return {};
  return host.ask(wire::LoaderVerify{});
}

TEST_F(Signing, RefusesAForgedImageAndOneChangedAfterItWasSigned) {
  start_with(target, host, old_image);
  Bytes forged = new_image;
  forged[100] ^= 1;  // a byte of the signature
  EXPECT_EQ(verified(host, forged).nak, wire::NakReason::kBadSignature);
  const Bytes other = make_image(3, {.body_bytes = 3000, .version = {1, 3, 0}});
  Bytes mixed = other;
  std::copy_n(new_image.begin() + 96, 64, mixed.begin() + 96);  // the signature of another image
  EXPECT_EQ(verified(host, mixed).nak, wire::NakReason::kBadSignature);
  target.power_off();
  target.power_on();
  target.run(kTicksPerSecond);
  EXPECT_TRUE(is_running(old_image));
}

TEST_F(Signing, ARefusedImageCostsTheFallbackNothing) {
  start_with(target, host, old_image);
  ASSERT_TRUE(host.flash(new_image));
  target.run(kTicksPerSecond);
  Bytes forged = make_image(3, {.body_bytes = 3000, .version = {1, 4, 0}});
  forged[100] ^= 1;
  for (int attempt = 0; attempt < 5; ++attempt) {
    EXPECT_EQ(verified(host, forged).nak, wire::NakReason::kBadSignature);
    target.reset();
    target.run(kTicksPerSecond);
    EXPECT_TRUE(is_running(new_image));
  }
  // The newest image rots: the one before it is still there.
  target.power_off();
  target.machine.flash.bytes[ModelBoard::slot_offset(1) + 2000] ^= 0x10;
  target.power_on();
  target.run(kTicksPerSecond);
  EXPECT_TRUE(is_running(old_image));
}

TEST_F(Signing, TakesAnImageWithoutSignatureOnlyWithTheJumper) {
  start_with(target, host, old_image);
  const Bytes bare = make_image(3, {.version = {1, 4, 0}, .is_signed = false});
  EXPECT_EQ(verified(host, bare).nak, wire::NakReason::kNotSigned);
  target.machine.development = true;
  ASSERT_TRUE(host.flash(bare));
  target.run(kTicksPerSecond);
  EXPECT_TRUE(is_running(bare));
  Bytes forged = new_image;
  forged[100] ^= 1;
  EXPECT_EQ(verified(host, forged).nak, wire::NakReason::kBadSignature) << "the jumper allows none, not a wrong one";
  target.power_off();
  target.machine.development = false;
  target.power_on();
  target.run(kTicksPerSecond);
  EXPECT_TRUE(!target.runs_application() || !is_running(bare)) << "the jumper is gone";
}

TEST_F(Signing, MarksNothingWithoutAVerifier) {
  start_with(target, host, old_image);
  target.machine.has_verifier = false;
  EXPECT_EQ(verified(host, new_image).nak, wire::NakReason::kNoVerifier);
  target.reset();
  target.run(kTicksPerSecond);
  EXPECT_TRUE(is_running(old_image)) << "what was verified before still starts";
}

TEST_F(Signing, RefusesWhatIsOlderThanTheFallbackOfAConfirmedImage) {
  const Bytes newest = make_image(3, {.version = {1, 4, 0}});
  start_with(target, host, old_image);
  ASSERT_TRUE(host.flash(new_image));
  target.run(kTicksPerSecond);
  ASSERT_TRUE(host.flash(newest));
  target.run(kTicksPerSecond);
  const Reply reply = verified(host, old_image);
  EXPECT_EQ(reply.nak, wire::NakReason::kTooOld);
  EXPECT_EQ(reply.nak_value, 0x010300u);
  target.machine.development = true;
  EXPECT_TRUE(verified(host, old_image).ack) << "with the jumper any";
  target.machine.development = false;
  EXPECT_TRUE(host.flash(new_image)) << "the fallback itself may be written again";
  target.run(kTicksPerSecond);
  EXPECT_TRUE(is_running(new_image));
}

TEST_F(Signing, KeepsTheFloorUntilTheNewestImageIsConfirmed) {
  start_with(target, host, old_image);
  target.silent_patch = 7;
  ASSERT_TRUE(host.flash(make_image(3, {.version = {1, 4, 7}})));
  const Bytes floor_before(target.machine.flash.bytes.begin() + ModelBoard::kFloorOffset,
                           target.machine.flash.bytes.end());
  for (int reset = 0; reset <= Retained::kMaxBootAttempts; ++reset) {
    target.run(kTicksPerSecond);
    target.reset();
  }
  target.run(kTicksPerSecond);
  EXPECT_TRUE(is_running(old_image));
  target.reset();
  EXPECT_TRUE(std::equal(floor_before.begin(), floor_before.end(),
                         target.machine.flash.bytes.begin() + ModelBoard::kFloorOffset));
}

}  // namespace
}  // namespace pharos::boot::test
