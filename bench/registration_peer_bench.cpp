// SPDX-License-Identifier: Apache-2.0
// align() beside the point-to-plane ICP of PCL and of Open3D and beside distance fields of the model's parts on the same depth images, in
// turns: the same scan points, the same start, normals counted everywhere, processor time of all threads. Fields are made before; their
// cost stands apart.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>
#include <random>

#include "bench/registration/field_align.h"
#include "bench/registration/icp_peers.h"
#include "core/metrics/share_interval.h"
#include "registration/align.h"
#include "tests/registration/furniture_scan.h"

namespace {

using namespace oikos;
constexpr double kDegree = std::numbers::pi / 180.0;

double cpuMs(const std::function<void()>& action) {
  const std::clock_t begin = std::clock();
  action();
  return 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Case {
  std::size_t kind = 0;
  model::ArticulatedModel model;
  std::vector<double> joint_values;
  Eigen::Isometry3d T_map_true;
  Eigen::Isometry3d T_map_start;
  Eigen::Isometry3d T_map_camera;
  cv::Mat depth_m;
};

Case makeCase(int number, double range_m, double range_deg) {
  std::mt19937_64 random(static_cast<std::uint64_t>(number) + 77);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const std::size_t kind = static_cast<std::size_t>(number) % test::furnitureKinds().size();
  const test::FurnitureKind& furniture = test::furnitureKinds()[kind];
  const model::ArticulatedModel real = test::trulyBuilt(furniture, 0.005, random);
  test::FurnitureScene world;
  world.model = &real;
  world.joint_values.assign(real.joints.size(), 0.0);
  world.T_map_model = Eigen::AngleAxisd(std::numbers::pi * uniform(random), Eigen::Vector3d::UnitZ());
  world.T_map_camera = test::cameraBefore(world.T_map_model, 2.0, (uniform(random) > 0.0 ? 1.0 : -1.0) * 42.0 * kDegree, 0.6);
  world.noise_seed = static_cast<std::uint64_t>(number);
  Case made{kind,
            test::believed(furniture),
            world.joint_values,
            world.T_map_model,
            {},
            world.T_map_camera,
            test::recordDepth(world, test::kinectCamera())};
  made.T_map_start = Eigen::Translation3d(range_m * uniform(random), range_m * uniform(random), 0.0) *
                     Eigen::AngleAxisd(range_deg * kDegree * uniform(random), Eigen::Vector3d::UnitZ()) * made.T_map_true;
  return made;
}

struct Outcome {
  double ms = 0.0;
  double error_cm = 0.0;
  double error_deg = 0.0;
  int points = 0;
};

Outcome errorOf(const Case& made, const Eigen::Isometry3d& T_map_found) {
  const Eigen::Isometry3d T_true_found = made.T_map_true.inverse() * T_map_found;
  Outcome outcome;
  outcome.error_cm = 100.0 * T_true_found.translation().norm();
  outcome.error_deg = Eigen::AngleAxisd(T_true_found.linear()).angle() / kDegree;
  return outcome;
}

Outcome runOurs(const Case& made, const registration::ScanConfig& scan_config) {
  render::Scene scene;
  const int piece = scene.add(made.model, made.T_map_start, made.joint_values);
  registration::ModelMotion motion(scene, piece, made.model, made.T_map_camera, {made.T_map_start, made.joint_values}, {});
  int points = 0;
  const double ms = cpuMs([&] {
    const registration::Scan scan = registration::makeScan(made.depth_m, test::kinectCamera(), scan_config);
    points = registration::align(motion, scan, {}).inliers;
  });
  Outcome outcome = errorOf(made, motion.pose().T_map_model);
  outcome.ms = ms;
  outcome.points = points;
  return outcome;
}

/// Fields, made once a kind.
class KindFields {
 public:
  explicit KindFields(const bench::FieldConfig& config) : config_(config) {}

  const bench::FieldModel& of(const Case& made) {
    std::optional<bench::FieldModel>& fields = fields_[made.kind];
    if (!fields) {
      ms_.push_back(cpuMs([&] { fields.emplace(made.model, made.joint_values, config_); }));
      megabytes_.push_back(1e-6 * static_cast<double>(fields->bytes()));
    }
    return *fields;
  }

  void print() const {
    std::printf("\nFields of %.1f cm, made once a kind: CPU ms %.0f (median; most %.0f), MB %.1f (most %.1f)\n", 100.0 * config_.voxel_m,
                median(ms_), *std::max_element(ms_.begin(), ms_.end()), median(megabytes_),
                *std::max_element(megabytes_.begin(), megabytes_.end()));
  }

 private:
  bench::FieldConfig config_;
  std::map<std::size_t, std::optional<bench::FieldModel>> fields_;
  std::vector<double> ms_;
  std::vector<double> megabytes_;
};

struct FieldOutcomes {
  std::vector<Outcome> found;
  std::vector<Outcome> judged;  ///< the same, with what align() says of its result: counts, overlap, covariance
};

void runFields(const Case& made, const bench::FieldModel& fields, const registration::ScanConfig& scan_config, FieldOutcomes& outcomes) {
  render::Scene scene;
  const int piece = scene.add(made.model, made.T_map_start, made.joint_values);
  registration::ModelMotion motion(scene, piece, made.model, made.T_map_camera, {made.T_map_start, made.joint_values}, {});
  registration::Scan scan;
  bench::FieldAlignment found;
  const double ms = cpuMs([&] {
    scan = registration::makeScan(made.depth_m, test::kinectCamera(), scan_config);
    found = bench::alignOnFields(fields, {scene, piece, made.joint_values, made.T_map_start, made.T_map_camera}, scan, {});
  });
  Outcome outcome = errorOf(made, found.T_map_model);
  outcome.ms = ms;
  outcome.points = found.inliers;
  outcomes.found.push_back(outcome);
  outcome.ms += cpuMs([&] {
    motion.moveTo({found.T_map_model, made.joint_values});
    outcome.points = registration::judge(motion, scan, {}).inliers;
  });
  outcomes.judged.push_back(outcome);
}

/// The scan's points where the model is seen, what align() pairs, too, and the rendered model (S213-S215).
bench::IcpClouds icpClouds(const Case& made, const render::Scene& scene, int step_px) {
  const camera::PinholeCamera camera = registration::thinned(test::kinectCamera(), step_px);
  const render::View view = test::viewOf(scene, camera, made.T_map_camera);
  bench::IcpClouds clouds;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (view.part.at<int>(v, u) < 0) {
        continue;
      }
      const cv::Vec3f normal = view.normal_camera.at<cv::Vec3f>(v, u);
      clouds.model.emplace_back(static_cast<double>(view.depth_m.at<float>(v, u)) * camera.ray(u, v));
      clouds.model_normals.emplace_back(normal[0], normal[1], normal[2]);
      const double z = static_cast<double>(made.depth_m.at<float>(v * step_px, u * step_px));
      if (std::isfinite(z)) {
        clouds.scan.emplace_back(z * camera.ray(u, v));
      }
    }
  }
  return clouds;
}

using IcpPeer = Eigen::Isometry3d (*)(const bench::IcpClouds& clouds, double correspondence_m);

Outcome runIcp(IcpPeer align, const Case& made, const registration::ScanConfig& scan_config, double correspondence_m) {
  render::Scene scene;
  scene.add(made.model, made.T_map_start, made.joint_values);
  scene.commit();
  std::size_t points = 0;
  Eigen::Isometry3d T_camera_moved;
  const double ms = cpuMs([&] {
    const bench::IcpClouds clouds = icpClouds(made, scene, scan_config.step_px);
    points = clouds.scan.size();
    T_camera_moved = align(clouds, correspondence_m);
  });
  // The scan was moved onto the model; the model goes the other way.
  Outcome outcome = errorOf(made, made.T_map_camera * T_camera_moved.inverse() * made.T_map_camera.inverse() * made.T_map_start);
  outcome.ms = ms;
  outcome.points = static_cast<int>(points);
  return outcome;
}

void print(const char* name, const std::vector<Outcome>& outcomes, double ours_ms) {
  std::vector<double> ms;
  std::vector<double> cm;
  std::vector<double> deg;
  double points = 0.0;
  for (const Outcome& outcome : outcomes) {
    ms.push_back(outcome.ms);
    cm.push_back(outcome.error_cm);
    deg.push_back(outcome.error_deg);
    points += outcome.points / static_cast<double>(outcomes.size());
  }
  const auto count = static_cast<int>(outcomes.size());
  const auto within = static_cast<int>(
      std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return o.error_cm < 3.0 && o.error_deg < 3.0; }));
  const auto [low, high] = metrics::wilsonInterval(within, count);
  std::printf("| %-25s | %6.0f | %7.1f | %6.2fx | %.2f | %.2f | %d of %d, %.1f %% (%.1f-%.1f) |\n", name, points, median(ms),
              median(ms) / ours_ms, median(cm), median(deg), within, count, 100.0 * within / count, 100.0 * low, 100.0 * high);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Registration of furniture beside PCL's and Open3D's ICP and distance fields"};
  int trials = 40;
  double range_m = 0.05;
  double range_deg = 3.0;
  registration::ScanConfig scan_config;
  app.add_option("--trials", trials, "how many; kinds take turns")->check(CLI::PositiveNumber);
  app.add_option("--range-m", range_m, "start's offset in x and y, at most");
  app.add_option("--range-deg", range_deg, "and its turn");
  app.add_option("--step-px", scan_config.step_px, "one point in so many columns and rows");
  bench::FieldConfig field_config;
  app.add_option("--voxel-m", field_config.voxel_m, "of the distance fields")->check(CLI::Range(0.005, 0.05));
  CLI11_PARSE(app, argc, argv);
  std::vector<Outcome> ours;
  std::vector<Outcome> pcl;
  std::vector<Outcome> open3d;
  FieldOutcomes on_fields;
  KindFields kind_fields(field_config);
  for (int i = 0; i < trials; ++i) {
    const Case made = makeCase(i, range_m, range_deg);
    ours.push_back(runOurs(made, scan_config));
    pcl.push_back(runIcp(bench::alignByPcl, made, scan_config, 0.1));
    open3d.push_back(runIcp(bench::alignByOpen3d, made, scan_config, 0.1));
    runFields(made, kind_fields.of(made), scan_config, on_fields);
  }
  std::vector<double> ours_ms;
  for (const Outcome& outcome : ours) {
    ours_ms.push_back(outcome.ms);
  }
  std::printf("| | points | CPU ms | | error cm | deg | within 3 cm, 3 deg (95 %%) |\n|---|---|---|---|---|---|---|\n");
  print("align()", ours, median(ours_ms));
  print("PCL, ICP with normals", pcl, median(ours_ms));
  print("Open3D, point to plane", open3d, median(ours_ms));
  print("distance fields", on_fields.found, median(ours_ms));
  print("distance fields, judge()", on_fields.judged, median(ours_ms));
  kind_fields.print();
  return 0;
}
