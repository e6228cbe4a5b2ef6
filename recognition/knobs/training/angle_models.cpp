// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/training/angle_models.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <opencv2/ml.hpp>

#include "core/base/config.h"
#include "core/base/config_rules.h"
#include "core/base/degrees.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "recognition/knobs/hog.h"

namespace oikos::recognition {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr HogShape kAngleHog = {12, 36};  // S254
constexpr int kPatch_px = 48;
constexpr int kRadius_px = 20;

double wrapped(double angle_rad) {
  return angle_rad - kTurn * std::floor(angle_rad / kTurn);
}

std::vector<float> describe(const FaceImage& image, const Eigen::Vector2d& centre_patch) {
  PatchGrid grid;
  grid.size = {kPatch_px, kPatch_px};
  grid.px_per_m = kRadius_px / image.radius_m;
  grid.origin_px = Eigen::Vector2d::Constant((kPatch_px - 1) / 2.0);
  grid.centre_patch = centre_patch;
  return normaliseAsWhole(histogramCells(differentiate(samplePatch(image.color, image.camera, image.view, grid)), kAngleHog)).values;
}

/// A render of one knob: its descriptor, and the angle of its mark from the direction to the camera.
struct Sample {
  std::vector<float> descriptor;
  double angle_rad = 0.0;
};

Sample drawSample(const PanelLook& look, Random& random) {
  const Panel panel = drawPanel(look, {.knob_count = 1, .knob = {}}, random);
  const DrawnKnob& knob = panel.knobs.front();
  ShotOrder order;
  order.target_panel = knob.position_panel;
  order.radius_m = knob.size.radius_m;
  order.diameter_px = 24.0 * std::pow(5.0, random.between(0.0, 1.0));
  order.tilt_rad = random.between(0.0, 50.0) * base::kRadPerDeg;
  order.azimuth_rad = random.between(0.0, kTurn);
  order.roll_rad = 0.1 * random.normal();
  order.width_px = order.height_px = static_cast<int>(2.0 * order.diameter_px);
  const PanelShot shot = shootPanel(panel, order, random);
  const Eigen::Isometry3d T_panel_face(Eigen::Translation3d(knob.position_panel.x(), knob.position_panel.y(), knob.size.height_m));
  const FaceView view = viewFace(shot.T_camera_panel * T_panel_face, shot.camera);
  const Eigen::Vector2d jitter = 0.05 * knob.size.radius_m * Eigen::Vector2d(random.normal(), random.normal());
  return {describe({shot.color, shot.camera, view, knob.size.radius_m}, jitter), wrapped(knob.angle_rad - view.azimuth_rad)};
}

cv::Ptr<cv::ml::SVM> fitRegression(const cv::Mat& samples, const cv::Mat& targets, const AngleTrainingConfig& config) {
  const auto svm = cv::ml::SVM::create();
  svm->setType(cv::ml::SVM::EPS_SVR);
  svm->setKernel(cv::ml::SVM::LINEAR);
  svm->setC(config.svr_cost);
  svm->setP(config.svr_epsilon);
  svm->setTermCriteria({cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20000, 1e-3});
  svm->train(cv::ml::TrainData::create(samples, cv::ml::ROW_SAMPLE, targets));
  return svm;
}

cv::Ptr<cv::ml::RTrees> fitForest(const cv::Mat& samples, const cv::Mat& classes, const AngleTrainingConfig& config) {
  const auto forest = cv::ml::RTrees::create();
  forest->setMaxDepth(20);
  forest->setMinSampleCount(2);
  forest->setActiveVarCount(0);  // the root of their number
  forest->setTermCriteria({cv::TermCriteria::COUNT, config.trees, 0.0});
  forest->train(cv::ml::TrainData::create(samples, cv::ml::ROW_SAMPLE, classes));
  return forest;
}

}  // namespace

struct AngleModels::Impl {
  int classes = 36;
  cv::Ptr<cv::ml::RTrees> forest;
  cv::Ptr<cv::ml::SVM> angle;
  std::array<cv::Ptr<cv::ml::SVM>, 2> sine_cosine;
};

AngleModels::AngleModels(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
AngleModels::~AngleModels() = default;
AngleModels::AngleModels(AngleModels&&) noexcept = default;
AngleModels& AngleModels::operator=(AngleModels&&) noexcept = default;

std::vector<std::string> AngleTrainingConfig::validate() const {
  return base::ConfigRules()
      .between("renders", renders, 10, 180000)
      .between("trees", trees, 1, 1000)
      .between("classes", classes, 4, 360)
      .greater("svr_cost", svr_cost, 0.0)
      .greater("svr_epsilon", svr_epsilon, 0.0)
      .messages();
}

double AngleModels::predict(AngleMethod method, const FaceImage& image, const Eigen::Vector2d& centre_patch) const {
  const std::vector<float> descriptor = describe(image, centre_patch);
  const cv::Mat sample(1, static_cast<int>(descriptor.size()), CV_32FC1, const_cast<float*>(descriptor.data()));
  double from_camera_rad = 0.0;
  switch (method) {
    case AngleMethod::kForest:
      from_camera_rad = kTurn * impl_->forest->predict(sample) / impl_->classes;
      break;
    case AngleMethod::kSvr:
      from_camera_rad = impl_->angle->predict(sample);
      break;
    case AngleMethod::kPeriodicSvr:
      from_camera_rad = std::atan2(impl_->sine_cosine[0]->predict(sample), impl_->sine_cosine[1]->predict(sample));
      break;
  }
  return wrapped(from_camera_rad + image.view.azimuth_rad);
}

AngleModels trainAngles(const PanelLook& look, const AngleTrainingConfig& config, const TrainingRun& run) {
  OIKOS_CHECK(base::validateConfig(config).empty());
  std::vector<Sample> drawn(static_cast<std::size_t>(config.renders));
  std::atomic<int> done = 0;
  base::parallelFor(config.renders, run.threads, [&](int i) {
    Random random(run.seed, 2'000'000 + static_cast<std::uint64_t>(i));
    drawn[static_cast<std::size_t>(i)] = drawSample(look, random);
    base::reportProgress(run.progress, {"rendering", ++done, config.renders});
  });
  const int size = static_cast<int>(drawn.front().descriptor.size());
  cv::Mat samples(config.renders, size, CV_32FC1);
  cv::Mat classes(config.renders, 1, CV_32SC1);
  std::array<cv::Mat, 3> targets;  // angle, sine, cosine
  for (cv::Mat& target : targets) {
    target.create(config.renders, 1, CV_32FC1);
  }
  for (int i = 0; i < config.renders; ++i) {
    const Sample& sample = drawn[static_cast<std::size_t>(i)];
    std::copy(sample.descriptor.begin(), sample.descriptor.end(), samples.ptr<float>(i));
    classes.at<int>(i) = static_cast<int>(std::lround(sample.angle_rad / kTurn * config.classes)) % config.classes;
    targets[0].at<float>(i) = static_cast<float>(sample.angle_rad);
    targets[1].at<float>(i) = static_cast<float>(std::sin(sample.angle_rad));
    targets[2].at<float>(i) = static_cast<float>(std::cos(sample.angle_rad));
  }
  auto impl = std::make_unique<AngleModels::Impl>();
  impl->classes = config.classes;
  impl->forest = fitForest(samples, classes, config);
  impl->angle = fitRegression(samples, targets[0], config);
  impl->sine_cosine = {fitRegression(samples, targets[1], config), fitRegression(samples, targets[2], config)};
  return AngleModels(std::move(impl));
}

}  // namespace oikos::recognition
