// SPDX-License-Identifier: Apache-2.0
// `pharos reproduce fusion` as it is published: a thousand runs of each kind of fault, a hundred without.
#include "tools/evaluation/reproduce/fusion/fusion_campaign.hpp"

#include <gtest/gtest.h>

namespace pharos {
namespace {

TEST(FusionCampaign, TruthStaysWithinTheLevelWhateverTheFault) {
  tools::FusionCampaign campaign;
  for (const tools::ComparisonRow& row : tools::run_fusion_campaign(campaign, [] {})) {
    if (row.what.find("outside the level") != std::string::npos) {
      EXPECT_EQ(row.ours, 0.0) << row.item << ": " << row.remark;
    }
    if (row.what.find("NEES") != std::string::npos) {
      EXPECT_GE(row.ours, 0.9) << row.what;
      EXPECT_LE(row.ours, 1.1) << row.what;
    }
    if (row.what == "largest step at a hand-over") {
      EXPECT_LE(row.ours, 1.0);
    }
  }
}

}  // namespace
}  // namespace pharos
