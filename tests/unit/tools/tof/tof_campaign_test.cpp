// SPDX-License-Identifier: Apache-2.0
// Random poses of either ring, with and without a third of it hidden. TOF_CAMPAIGN_FRAMES of each class.
#include <gtest/gtest.h>

#include <string>

#include "tools/cli/reproduce/tof/success_campaign.hpp"

namespace pharos::tools {
namespace {

struct Class {
  const char* name;
  CampaignOptions options;
};

CampaignOptions large(bool hidden) { return {1.1, 2.5, 6.0, TOF_CAMPAIGN_FRAMES, TOF_CAMPAIGN_SEED, hidden}; }
CampaignOptions small(bool hidden) { return {0.6, 1.5, 4.0, TOF_CAMPAIGN_FRAMES, TOF_CAMPAIGN_SEED, hidden}; }

std::string text_of(const CampaignResult& result) {
  std::string text = "errors over covariance " + std::to_string(result.mean_nees / 6.0);
  for (const auto& [outcome, count] : result.outcomes) text += ", " + std::to_string(count) + ' ' + outcome;
  return text;
}

class TofCampaign : public testing::TestWithParam<Class> {};

TEST_P(TofCampaign, FramesAreAnsweredAndNonePretends) {
  const CampaignResult result = run_campaign(GetParam().options, [](const CampaignFrame&) {});
  RecordProperty("result", text_of(result));
  EXPECT_EQ(result.wrong, 0) << text_of(result);
  EXPECT_GE(result.good, TOF_CAMPAIGN_SUCCESS * result.frames) << text_of(result);
  EXPECT_GT(result.mean_nees / 6.0, TOF_CAMPAIGN_LEAST_NEES) << text_of(result);
  EXPECT_LT(result.mean_nees / 6.0, TOF_CAMPAIGN_MOST_NEES) << text_of(result);
}

INSTANTIATE_TEST_SUITE_P(Classes, TofCampaign,
                         testing::Values(Class{"large", large(false)}, Class{"large_hidden", large(true)},
                                         Class{"small", small(false)}, Class{"small_hidden", small(true)}),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace pharos::tools
