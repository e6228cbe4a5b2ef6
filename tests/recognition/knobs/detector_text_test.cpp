// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "recognition/knobs/knob_detector.h"
#include "tests/support/config_rules_check.h"
#include "tests/support/expect_error.h"

namespace oikos::recognition {
namespace {

std::string goodText() {
  DetectorModel model;
  for (int i = 0; i < kDescriptorSize; ++i) {
    model.weights.push_back(0.25F * static_cast<float>(i % 7) - 0.5F);
  }
  model.bias = -1.5F;
  model.threshold = 0.25F;
  return writeDetector(model);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

void expectRefused(const std::string& text, const std::vector<std::string>& parts) {
  test::expectError(base::ErrorCode::kInput, parts, [&] { (void)parseDetector(text, "model.txt"); });
}

TEST(DetectorText, ReadsWhatItWrites) {
  const DetectorModel model = parseDetector(goodText(), "model.txt");
  EXPECT_EQ(model.bias, -1.5F);
  EXPECT_EQ(model.threshold, 0.25F);
  EXPECT_EQ(model.weights[8], -0.25F);
  EXPECT_EQ(writeDetector(model), goodText());
}

TEST(DetectorText, TheShippedOneIsWhatItsFileSays) {
  EXPECT_EQ(static_cast<int>(shippedDetector().weights.size()), kDescriptorSize);
  EXPECT_EQ(writeDetector(parseDetector(writeDetector(shippedDetector()), "shipped")), writeDetector(shippedDetector()));
}

TEST(DetectorText, EachFieldIsChecked) {
  expectRefused(replaced(goodText(), "oikos-knob-detector", "something"), {"model.txt:1", "'something'", "'oikos-knob-detector'"});
  expectRefused(replaced(goodText(), "detector 1", "detector 2"), {"model.txt:1", "'2'", "'1'"});
  expectRefused(replaced(goodText(), "weights 576", "weights 575"), {"model.txt:2", "'575'", "'576'"});
  expectRefused(replaced(goodText(), "bias -1.5", "bias x1.5"), {"model.txt:3", "x1.5", "a number"});
  expectRefused(replaced(goodText(), "threshold 0.25000", "threshold nan"), {"model.txt:4", "nan", "a number"});
  expectRefused(replaced(goodText(), "-0.50000", "1e9"), {"model.txt:5", "1e9", "a number"});
  expectRefused(goodText() + "0.1\n", {"model.txt:69", "'0.1'", "the end of the file"});
  expectRefused(goodText().substr(0, 200), {"model.txt", "a number"});
  expectRefused("", {"model.txt:1", "the end of the file"});
}

TEST(DetectorConfig, RefusesWhatMakesNoSense) {
  test::checkConfigRules<DetectorConfig>({{"search_m", "0", "must be from 0.001 to 0.5"},
                                          {"search_m", "nan", "must be from 0.001 to 0.5"},
                                          {"layer_ratio", "0.9", "must be from 1 to 2"},
                                          {"min_score", "11", "must be from -10 to 10"}});
}

}  // namespace
}  // namespace oikos::recognition
