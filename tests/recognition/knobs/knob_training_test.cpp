// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/error.h"
#include "recognition/knobs/knob.h"
#include "recognition/knobs/training/angle_models.h"
#include "recognition/knobs/training/detector_training.h"
#include "tests/support/config_rules_check.h"

namespace oikos::recognition {
namespace {

DetectorTrainingConfig smallTraining() {
  DetectorTrainingConfig config;
  config.panels = 60;
  config.rounds = 1;
  return config;
}

TEST(KnobTraining, IsTheSameForAnyNumberOfThreads) {
  const TrainedDetector one = trainDetector(trainingLook(), smallTraining(), {3, 1, {}});
  const TrainedDetector two = trainDetector(trainingLook(), smallTraining(), {3, 2, {}});
  EXPECT_EQ(writeDetector(one.model), writeDetector(two.model));
  EXPECT_EQ(one.negatives, two.negatives);
}

TEST(KnobTraining, TellsKnobsFromTheRest) {
  const TrainedDetector trained = trainDetector(trainingLook(), smallTraining(), {4, 2, {}});
  EXPECT_GT(trained.positives, 30);
  Random random(99);
  int right = 0;
  constexpr int kScenes = 20;
  for (int i = 0; i < kScenes; ++i) {
    const DetectionScene scene = drawDetectionScene(trainingLook(), 1, random);
    const FaceImage image{scene.color, scene.camera, scene.view, scene.radius_m};
    const auto score = [&](const Eigen::Vector2d& centre_patch) { return scoreWindow(image, centre_patch, trained.model); };
    right += score(scene.centres_patch[0]) > score(scene.centres_patch[0] + 1.5 * scene.radius_m * Eigen::Vector2d(1.0, 0.0)) ? 1 : 0;
  }
  EXPECT_GE(right, 17);  // by chance 10
}

/// One number a cell: how much of ours there is in all.
std::vector<HogCells> describeBySums(const cv::Mat& patch, const std::vector<cv::Point>& starts) {
  std::vector<HogCells> all = describeByHog(patch, starts);
  for (HogCells& cells : all) {
    HogCells sums{cells.columns, cells.rows, 1, {}};
    for (std::size_t i = 0; i < cells.values.size(); i += 9) {
      sums.values.push_back(std::accumulate(&cells.values[i], &cells.values[i] + 9, 0.0F));
    }
    cells = sums;
  }
  return all;
}

TEST(KnobTraining, LearnsByOtherNumbersThanOurs) {
  const TrainedDetector trained = trainDetector(trainingLook(), smallTraining(), {4, 2, {}}, describeBySums);
  EXPECT_EQ(trained.model.weights.size(), static_cast<std::size_t>(kWindowCells * kWindowCells));
  Random random(99);
  const DetectionScene scene = drawDetectionScene(trainingLook(), 1, random);
  const FaceImage image{scene.color, scene.camera, scene.view, scene.radius_m};
  DetectorConfig all;
  all.min_score = -10.0;
  const std::vector<KnobDetection> found = detectKnobs(image, trained.model, all);
  ASSERT_FALSE(found.empty());
  // A window as detection sees it has the score that its descriptor has, but for how both are resampled.
  FaceImage sized = image;
  sized.radius_m = found.front().radius_m;
  EXPECT_NEAR(scoreWindow(sized, found.front().centre_patch, trained.model), found.front().score, 0.15);
}

TEST(KnobTraining, RefusesWeightsForOtherNumbers) {
  DetectorModel model;
  model.weights.assign(kWindowCells * kWindowCells, 0.0F);
  Random random(99);
  const DetectionScene scene = drawDetectionScene(trainingLook(), 1, random);
  const FaceImage image{scene.color, scene.camera, scene.view, scene.radius_m};
  EXPECT_THROW((void)detectKnobs(image, model, {}), base::ContractViolation);
  EXPECT_THROW((void)writeDetector(model), base::ContractViolation);
}

TEST(KnobTraining, EveryFamilyIsASoundMeshOfItsSize) {
  for (std::size_t i = 0; i < trainingKnobs().size(); ++i) {
    Random random(i);
    KnobDescription knob;
    knob.mesh_knob = std::make_shared<const model::TriangleMesh>(
        trainingKnobs()[i]({.radius_m = 0.02F, .height_m = 0.018F, .mark_scale = 1.0F}, random));
    EXPECT_TRUE(model::validate(*knob.mesh_knob).empty()) << i;
    const KnobFace face = findFace(knob);
    EXPECT_NEAR(face.radius_m, 0.02, 0.001) << i;
    EXPECT_NEAR(face.height_m, 0.018, 0.001) << i;
    EXPECT_EQ(face.turn_sign, 1.0);
  }
}

TEST(KnobTraining, LearntAnglesAreBetterThanChance) {
  AngleTrainingConfig config;
  config.renders = 400;
  config.trees = 20;
  config.classes = 12;
  const AngleModels models = trainAngles(trainingLook(), config, {1, 2, {}});
  Random random(7);
  double sum_deg = 0.0;
  constexpr int kScenes = 30;
  for (int i = 0; i < kScenes; ++i) {
    const DetectionScene scene = drawDetectionScene(trainingLook(), 1, random);
    const FaceImage image{scene.color, scene.camera, scene.view, scene.radius_m};
    const double angle_rad = models.predict(AngleMethod::kForest, image, scene.centres_patch[0]);
    EXPECT_GE(angle_rad, 0.0);
    EXPECT_LT(angle_rad, 2.0 * std::numbers::pi);
    sum_deg += std::abs(std::remainder(angle_rad - scene.panel.knobs[0].angle_rad, 2.0 * std::numbers::pi)) * 180.0 / std::numbers::pi;
  }
  EXPECT_LT(sum_deg / kScenes, 70.0);  // by chance 90
}

TEST(DetectorTrainingConfig, RefusesWhatMakesNoSense) {
  test::checkConfigRules<DetectorTrainingConfig>({{"panels", "40000", "must be from 10 to 36000"},
                                                  {"negatives_per_panel", "0", "must be from 1 to 100"},
                                                  {"rounds", "-1", "must be from 0 to 10"},
                                                  {"hard_per_panel", "0", "must be from 1 to 100"},
                                                  {"cost", "0", "must be > 0"},
                                                  {"false_alarms", "2", "must be from 0 to 1"}});
}

TEST(AngleTrainingConfig, RefusesWhatMakesNoSense) {
  test::checkConfigRules<AngleTrainingConfig>({{"renders", "200000", "must be from 10 to 180000"},
                                               {"trees", "0", "must be from 1 to 1000"},
                                               {"classes", "3", "must be from 4 to 360"},
                                               {"svr_cost", "0", "must be > 0"},
                                               {"svr_epsilon", "0", "must be > 0"}});
}

}  // namespace
}  // namespace oikos::recognition
