// SPDX-License-Identifier: Apache-2.0
// How far wrong a piece of furniture may be believed to stand and still be registered, to what accuracy and at what cost: ten kinds before
// a simulated Kinect, their dimensions off as a tape's are.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <numbers>
#include <opencv2/core.hpp>
#include <random>

#include "registration/pose_search.h"
#include "tests/registration/furniture_scan.h"

namespace {

using namespace oikos;
constexpr double kDegree = std::numbers::pi / 180.0;

struct Options {
  int trials = 1000;
  double dimension_mm = 5.0;
  double range_m = 0.30;
  double range_deg = 15.0;
  std::string association = "projective";
  std::string sensor = "kinect1";
  bool has_occluder = false;
  std::uint64_t seed = 1;
  bool without_edges = false;
  bool verbose = false;
};

struct Trial {
  std::string kind;
  registration::AlignStatus status = registration::AlignStatus::kNotInView;
  double error_m = 0.0;
  double error_deg = 0.0;
  double normalised_sq = 0.0;
  double ms = 0.0;  ///< of processor time, one thread  ///< of processor time, one thread
  [[nodiscard]] bool succeeded() const { return error_m < 0.03 && error_deg < 3.0; }
};

Trial runTrial(int number, const Options& options) {
  std::mt19937_64 random(options.seed * 1'000'003 + static_cast<std::uint64_t>(number));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const test::FurnitureKind& furniture = test::furnitureKinds()[static_cast<std::size_t>(number) % test::furnitureKinds().size()];
  const model::ArticulatedModel real = test::trulyBuilt(furniture, options.dimension_mm / 1000.0, random);
  const model::ArticulatedModel model = test::believed(furniture);
  test::FurnitureScene world;
  world.model = &real;
  world.joint_values.assign(real.joints.size(), 0.0);
  world.T_map_model = Eigen::Translation3d(uniform(random), uniform(random), 0.0) *
                      Eigen::AngleAxisd(std::numbers::pi * uniform(random), Eigen::Vector3d::UnitZ());
  const double off_axis_rad = (uniform(random) > 0.0 ? 1.0 : -1.0) * (43.5 + 16.5 * uniform(random)) * kDegree;  // two faces
  world.T_map_camera = test::cameraBefore(world.T_map_model, 2.0 + 0.5 * uniform(random), off_axis_rad, 0.6);
  world.noise_seed = static_cast<std::uint64_t>(number);
  world.has_occluder = options.has_occluder;
  world.sensor = *base::findEnum<camera::DepthSensorKind>(options.sensor);
  const cv::Mat depth_m = test::recordDepth(world, test::kinectCamera());

  const Eigen::Isometry3d T_map_start =
      Eigen::Translation3d(world.T_map_model.translation() +
                           Eigen::Vector3d(options.range_m * uniform(random), options.range_m * uniform(random), 0.0)) *
      Eigen::AngleAxisd(options.range_deg * kDegree * uniform(random), Eigen::Vector3d::UnitZ()) *
      Eigen::Isometry3d(world.T_map_model.linear());
  render::Scene scene;
  const int piece = scene.add(model, T_map_start, world.joint_values);
  scene.commit();
  registration::SearchConfig config;
  config.align.association = *base::findEnum<registration::Association>(options.association);
  config.align.has_edges = !options.without_edges;
  config.align.threads = 1;
  const std::clock_t begin = std::clock();
  const registration::Scan scan = registration::makeScan(depth_m, test::kinectCamera(), {});
  registration::ModelMotion motion(scene, piece, model, world.T_map_camera, {T_map_start, world.joint_values}, {});
  const registration::AlignResult result = registration::searchPose(motion, scan, config);
  Trial trial;
  trial.ms = 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  trial.kind = furniture.kind;
  trial.status = result.status;
  const Eigen::Isometry3d T_true_found = world.T_map_model.inverse() * motion.pose().T_map_model;
  trial.error_m = T_true_found.translation().norm();
  const double yaw = std::atan2(T_true_found.linear()(1, 0), T_true_found.linear()(0, 0));
  trial.error_deg = std::abs(yaw) / kDegree;
  Eigen::Vector3d error;
  const Eigen::Vector3d pivot = motion.pivot_map();
  const Eigen::Vector3d true_pivot = world.T_map_model * (motion.pose().T_map_model.inverse() * pivot);
  error << (pivot - true_pivot).head<2>(), yaw;
  trial.normalised_sq = error.dot(result.covariance.ldlt().solve(error));
  if (options.verbose) {
    std::printf("%4d %-12s %-20s %.1f cm %.2f deg start %.2f m fit %.2f overlap %.2f rms %.1f mm %.1f ms\n", number, trial.kind.c_str(),
                std::string(base::toString(trial.status)).c_str(), 100.0 * trial.error_m, trial.error_deg,
                (T_map_start.translation() - world.T_map_model.translation()).norm(), result.fit, result.overlap, 1000.0 * result.rms_m,
                trial.ms);
  }
  return trial;
}

/// Wilson's interval at 95 %.
std::pair<double, double> interval(int successes, int n) {
  const double z = 1.96;
  const double p = static_cast<double>(successes) / n;
  const double middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half = z / (1.0 + z * z / n) * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  return {middle - half, middle + half};
}

double median(std::vector<double> values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void report(const std::string& name, const std::vector<Trial>& trials) {
  int successes = 0;
  int confident = 0;
  int confidently_wrong = 0;
  double sum_m = 0.0;
  double sum_deg = 0.0;
  double sum_normalised = 0.0;
  std::vector<double> ms;
  for (const Trial& trial : trials) {
    const bool is_confident = trial.status == registration::AlignStatus::kConverged;
    successes += trial.succeeded() ? 1 : 0;
    confident += is_confident ? 1 : 0;
    confidently_wrong += is_confident && !trial.succeeded() ? 1 : 0;
    if (trial.succeeded()) {
      sum_m += trial.error_m;
      sum_deg += trial.error_deg;
      sum_normalised += trial.normalised_sq;
    }
    ms.push_back(trial.ms);
  }
  const int n = static_cast<int>(trials.size());
  const auto [low, high] = interval(successes, n);
  std::printf("| %-13s | %4d | %5.1f %% (%.1f-%.1f) | %4d | %3d | %.2f | %.2f | %.2f | %.1f |\n", name.c_str(), n, 100.0 * successes / n,
              100.0 * low, 100.0 * high, confident, confidently_wrong, 100.0 * sum_m / std::max(1, successes),
              sum_deg / std::max(1, successes), sum_normalised / std::max(1, successes), median(ms));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Registration of furniture from wrong starts: success, accuracy, time"};
  Options options;
  app.add_option("--trials", options.trials, "how many; kinds take turns")->check(CLI::PositiveNumber);
  app.add_option("--dimension-mm", options.dimension_mm, "deviation of each dimension from the model's");
  app.add_option("--range-m", options.range_m, "start's offset in x and y, at most");
  app.add_option("--range-deg", options.range_deg, "and its turn");
  app.add_option("--association", options.association, "projective or nearest");
  app.add_option("--sensor", options.sensor, "ideal, kinect1, kinect2");
  app.add_option("--seed", options.seed, "of the trials");
  app.add_flag("--occluder", options.has_occluder, "a person-sized box before the piece");
  app.add_flag("--without-edges", options.without_edges, "surfaces alone");
  app.add_flag("--verbose", options.verbose, "a line for each trial");
  CLI11_PARSE(app, argc, argv);
  std::map<std::string, std::vector<Trial>> by_kind;
  std::vector<Trial> all;
  for (int i = 0; i < options.trials; ++i) {
    all.push_back(runTrial(i, options));
    by_kind[all.back().kind].push_back(all.back());
  }
  std::printf(
      "| kind | n | success (95 %%) | converged | of these wrong | error cm | deg | error^2/cov (3) | ms "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [kind, trials] : by_kind) {
    report(kind, trials);
  }
  report("all", all);
  return 0;
}
