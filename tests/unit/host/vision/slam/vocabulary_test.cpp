// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/vocabulary.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "host/support/input_error.hpp"
#include "host/vision/slam/keyframe_database.hpp"

namespace pharos::slam {
namespace {

using Image = std::vector<Descriptor>;

// A descriptor with `flips` of its bits flipped.
Descriptor near(Descriptor descriptor, int flips, std::mt19937_64& random) {
  for (int k = 0; k < flips; ++k) {
    const std::size_t bit = random() % 256;
    descriptor.bits[bit / 64] ^= std::uint64_t{1} << (bit % 64);
  }
  return descriptor;
}

// Images of 20 out of 64 objects, every object a little different each time.
class VocabularyTree : public ::testing::Test {
 protected:
  VocabularyTree() {
    for (int k = 0; k < 64; ++k) things_.push_back({{random_(), random_(), random_(), random_()}});
    for (int k = 0; k < 40; ++k) images_.push_back(image(k));
  }
  Image image(int first) {
    Image out;
    for (int k = 0; k < 20; ++k) out.push_back(near(things_[static_cast<std::size_t>((first + k) % 64)], 6, random_));
    return out;
  }

  std::mt19937_64 random_{1};
  std::vector<Descriptor> things_;
  std::vector<Image> images_;
};

TEST_F(VocabularyTree, ViewsOfOneThingAreOneWord) {
  const Vocabulary vocabulary = Vocabulary::train(images_, 8, 2, 1);
  EXPECT_GT(vocabulary.words(), 30U);
  int alike = 0, tried = 0;
  for (const Descriptor& thing : things_) {
    for (int k = 0; k < 5; ++k, ++tried) {
      alike += vocabulary.word_of(near(thing, 6, random_)) == vocabulary.word_of(near(thing, 6, random_)) ? 1 : 0;
    }
  }
  // By chance it would be one in fifty.
  EXPECT_GT(alike, 3 * tried / 4);
}

TEST_F(VocabularyTree, ImagesOfTheSameThingsScoreHigher) {
  const Vocabulary vocabulary = Vocabulary::train(images_, 8, 2, 1);
  const auto words = [&](int first) { return vocabulary.words_of(image(first)); };
  const WordVector ten = words(10);
  EXPECT_NEAR(KeyframeDatabase::score(ten, ten), 1.0, 1e-12);
  const double again = KeyframeDatabase::score(ten, words(10)), near_by = KeyframeDatabase::score(ten, words(20)),
               far_off = KeyframeDatabase::score(ten, words(42));
  EXPECT_GT(again, near_by);
  EXPECT_GT(near_by, far_off);
  EXPECT_GE(far_off, 0.0);
}

TEST_F(VocabularyTree, ARareWordWeighsMore) {
  Image common = images_[0];
  std::vector<Image> images(10, {common[0]});
  images[3].push_back(common[1]);
  const Vocabulary vocabulary = Vocabulary::train(images, 2, 1, 1);
  const auto weight = [&](const Descriptor& thing) {
    return vocabulary.nodes()[static_cast<std::size_t>(vocabulary.word_of(thing))].weight;
  };
  EXPECT_EQ(weight(common[0]), 0.0F);
  EXPECT_NEAR(weight(common[1]), std::log(10.0), 1e-5);
}

TEST_F(VocabularyTree, TrainsAlikeFromOneSeedAndReadsBackBitByBit) {
  const auto bytes = Vocabulary::train(images_, 8, 2, 5).bytes();
  EXPECT_EQ(Vocabulary::train(images_, 8, 2, 5).bytes(), bytes);
  EXPECT_EQ(Vocabulary::parse(bytes, "it").bytes(), bytes);
}

TEST_F(VocabularyTree, AFileCutShortSaysSo) {
  const auto bytes = Vocabulary::train(images_, 4, 2, 1).bytes();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    try {
      Vocabulary::parse(std::span(bytes).first(size), "orb.words");
      FAIL() << size << " bytes were taken";
    } catch (const host::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("orb.words"), std::string::npos);
      if (size > 20) {
        EXPECT_NE(std::string(error.what()).find("cut short"), std::string::npos) << error.what();
      }
    }
  }
}

TEST_F(VocabularyTree, NoDamagedByteGoesUnnoticed) {
  auto bytes = Vocabulary::train(images_, 4, 2, 1).bytes();
  for (std::size_t k = 0; k < bytes.size(); k += 7) {
    bytes[k] ^= 0x10U;
    EXPECT_THROW(Vocabulary::parse(bytes, "it"), host::InputError) << "byte " << k;
    bytes[k] ^= 0x10U;
  }
}

TEST(Vocabulary, ThatIsMissingSaysWhatToDo) {
  try {
    Vocabulary::read("/nowhere/orb.words");
    FAIL();
  } catch (const host::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("pharos vocabulary"), std::string::npos);
  }
}

}  // namespace
}  // namespace pharos::slam
