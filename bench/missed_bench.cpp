// SPDX-License-Identifier: Apache-2.0
// Small objects of the demo home that have gone from their places: how many are missed in a few located depth images of what carries them,
// and how many of those still there are missed wrongly. Each scene is another true home, believed wrongly by so many millimetres, another
// choice of what has gone, and another short way of the camera; poses are off by their covariance.
//   missed_bench [--scenes N] [--views N] [--belief-mm MM] [--pose-mm MM] [--pose-deg DEG] [--sensor kinect1|kinect2] [--seed N]
//                [--set KEY=VALUE]…
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/base/degrees.h"
#include "core/camera/sensor/depth_sensor.h"
#include "core/metrics/share_interval.h"
#include "core/render/camera_rays.h"
#include "core/render/view.h"
#include "semantic/model/placement.h"
#include "semantic/xml/home_reader.h"
#include "tools/simulate/scene_script.h"
#include "tools/simulate/true_home.h"
#include "tools/simulate/world.h"
#include "tracking/objects/object_watch.h"

namespace {

using namespace oikos;
namespace fs = std::filesystem;
using Random = std::mt19937_64;

struct Options {
  int scenes = 8;  ///< of each piece that carries something
  int views = 5;
  double belief_mm = 5.0;
  double pose_mm = 6.0;
  double pose_deg = 0.25;
  std::string sensor = "kinect1";
  unsigned seed = 1;
  bool is_verbose = false;
  std::vector<std::string> settings;
};

camera::PinholeCamera kinectCamera() {
  return {640, 480, 525.0, 525.0, 319.5, 239.5};
}

/// What is on it, and where that is in truth.
struct Carrier {
  std::string id;
  Eigen::AlignedBox3d around_map;
  std::set<std::string> objects;
};

std::vector<Carrier> carriersOf(const semantic::Home& home) {
  std::vector<Carrier> carriers;
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      Carrier carrier{object.id.value, {}, {}};
      for (const semantic::SmallObject& small : object.small_objects) {
        if (const auto T_map_parent = semantic::findCarrierInMap(object, small.parent)) {
          carrier.around_map.extend(*T_map_parent * small.T_parent_object.position_m);
          carrier.objects.insert(small.id.value);
        }
      }
      if (!carrier.objects.empty() && object.movability != semantic::Movability::kMovable) {
        carriers.push_back(std::move(carrier));
      }
    }
  }
  return carriers;
}

/// A camera on a robot that looks at a point.
Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye_map, const Eigen::Vector3d& target_map) {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d forward = (target_map - eye_map).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  T_map_camera.linear() << right, forward.cross(right), forward;
  T_map_camera.translation() = eye_map;
  return T_map_camera;
}

/// Not in furniture, a wall or a neighbouring room: from there nothing is before the target.
bool isFree(const Eigen::Vector3d& eye_map, const Eigen::Vector3d& target_map, const simulate::World& world) {
  const Eigen::Vector2d eye = eye_map.head<2>();
  const auto footprints = world.footprints();
  if (std::any_of(footprints.begin(), footprints.end(), [&](const Eigen::AlignedBox2d& box) { return box.exteriorDistance(eye) < 0.15; })) {
    return false;
  }
  const camera::PinholeCamera ray{1, 1, 1.0, 1.0, 0.0, 0.0};
  const render::View view =
      render::renderView(world.scene(), render::CameraRays(ray), {lookAt(eye_map, target_map), {}}, render::ViewConfig());
  return static_cast<double>(view.depth_m.at<float>(0, 0)) > (target_map - eye_map).norm() - 0.35;
}

/// A short drive past the carrier; empty: there is no room for one.
std::vector<Eigen::Isometry3d> drivePast(const Carrier& carrier, const simulate::World& world, int views, Random& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const Eigen::Vector3d target = carrier.around_map.center() + Eigen::Vector3d(0.0, 0.0, 0.05);
  for (int attempt = 0; attempt < 300; ++attempt) {
    const double angle_rad = 2.0 * base::kRadPerDeg * 180.0 * share(random);
    const double height_m = 0.9 + 0.4 * share(random);
    const double step_m = 0.13 + 0.15 * share(random);
    Eigen::Vector3d eye = target + (0.9 + 1.5 * share(random)) * Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    const Eigen::Vector3d step = step_m * Eigen::Vector3d(-std::sin(angle_rad), std::cos(angle_rad), 0.0);
    std::vector<Eigen::Isometry3d> drive;
    for (int i = 0; i < views; ++i, eye += step) {
      eye.z() = height_m;
      if (isFree(eye, target, world)) {
        const Eigen::Vector3d aside = 0.1 * Eigen::Vector3d(share(random) - 0.5, share(random) - 0.5, share(random) - 0.5);
        drive.push_back(lookAt(eye, target + aside));
      }
    }
    if (static_cast<int>(drive.size()) == views) {
      return drive;
    }
  }
  return {};
}

/// Objects taken from the true home, and all of them nudged a little.
std::set<std::string> takeSome(semantic::Home& home, const Options& options, Random& random) {
  std::set<std::string> gone;
  std::normal_distribution<double> nudge_m(0.0, options.belief_mm / 1000.0);
  std::bernoulli_distribution is_taken(0.45);
  for (semantic::Room& room : home.rooms) {
    for (auto& object : room.objects) {
      for (semantic::SmallObject& small : object.edit().small_objects) {
        small.T_parent_object.position_m.head<2>() += Eigen::Vector2d(nudge_m(random), nudge_m(random));
        if (is_taken(random)) {
          gone.insert(small.id.value);
        }
      }
    }
  }
  return gone;
}

semantic::Home without(semantic::Home home, const std::set<std::string>& gone) {
  for (semantic::Room& room : home.rooms) {
    for (auto& object : room.objects) {
      std::erase_if(object.edit().small_objects, [&](const semantic::SmallObject& small) { return gone.contains(small.id.value); });
    }
  }
  return home;
}

/// Pixels of an image in which an object would be seen.
using Pixels = std::vector<cv::Point>;

Pixels pixelsOf(int model, const render::Scene& scene, const render::View& view) {
  Pixels pixels;
  for (int v = 0; v < view.part.rows; ++v) {
    for (int u = 0; u < view.part.cols; ++u) {
      const int part = view.part.at<int>(v, u);
      if (part >= 0 && scene.parts()[static_cast<std::size_t>(part)].model == model) {
        pixels.emplace_back(u, v);
      }
    }
  }
  return pixels;
}

/// How many pixels it would have if nothing were before it.
std::size_t pixelsAlone(int model, const render::Scene& scene, const Eigen::Isometry3d& T_map_camera, const render::ViewConfig& config) {
  render::Scene alone;
  for (const render::ScenePart& part : scene.parts()) {
    if (part.model == model) {
      alone.add(part.mesh_part, part.T_map_part);
    }
  }
  alone.commit();
  return static_cast<std::size_t>(
      cv::countNonZero(render::renderView(alone, render::CameraRays(kinectCamera()), {T_map_camera, {}}, config).part >= 0));
}

/// What is in view in an image, all being there: half of it or more, 150 pixels or more, the whole of it in the picture.
std::map<std::string, Pixels> seenIn(const simulate::World& world, const Eigen::Isometry3d& T_map_camera) {
  constexpr std::size_t kMinPixels = 150;
  constexpr double kMaxRange_m = 3.4;
  render::ViewConfig config;
  config.with_parts = true;
  const camera::PinholeCamera camera = kinectCamera();
  const render::View all = render::renderView(world.scene(), render::CameraRays(camera), {T_map_camera, {}}, config);
  std::map<std::string, Pixels> seen;
  for (const auto& [id, small] : world.smallPieces()) {
    if ((small.T_map_object.translation() - T_map_camera.translation()).norm() > kMaxRange_m) {
      continue;
    }
    Pixels pixels = pixelsOf(small.model, world.scene(), all);
    const bool is_cut = std::any_of(pixels.begin(), pixels.end(), [&](const cv::Point& pixel) {
      return pixel.x == 0 || pixel.y == 0 || pixel.x == camera.width - 1 || pixel.y == camera.height - 1;
    });
    if (!is_cut && pixels.size() >= kMinPixels && 2 * pixels.size() >= pixelsAlone(small.model, world.scene(), T_map_camera, config)) {
      seen[id] = std::move(pixels);
    }
  }
  return seen;
}

/// Whether half of an object's pixels or more have a reading.
bool isMeasured(const Pixels& pixels, const cv::Mat& depth_m) {
  const auto measured =
      std::count_if(pixels.begin(), pixels.end(), [&](const cv::Point& pixel) { return depth_m.at<float>(pixel) > 0.0F; });
  return 2 * static_cast<std::size_t>(measured) >= pixels.size();
}

cv::Mat senseDepth(const simulate::World& world, const Eigen::Isometry3d& T_map_camera, camera::DepthSensorKind kind, std::uint64_t seed) {
  render::ViewConfig config;
  config.with_normals = true;
  config.with_surface = true;
  const camera::PinholeCamera camera = kinectCamera();
  const render::View view = render::renderView(world.scene(), render::CameraRays(camera), {T_map_camera, {}}, config);
  camera::IdealView ideal;
  ideal.depth_m = view.depth_m;
  ideal.normal_camera = view.normal_camera;
  ideal.gloss = view.gloss;
  ideal.reflectivity = view.albedo;
  camera::DepthSensorConfig sensor;
  sensor.kind = kind;
  const cv::Mat units = camera::senseDepth(ideal, camera, sensor, {.seed = seed});
  cv::Mat depth_m;
  units.convertTo(depth_m, CV_32FC1, 1.0 / sensor.units_per_m);
  depth_m.setTo(std::numeric_limits<float>::quiet_NaN(), units == 0);
  return depth_m;
}

struct Score {
  int in_view = 0;        ///< gone, in view in two images from places apart,
  int missed_of_all = 0;  ///< and missed
  int gone = 0;           ///< of these, in plain view: its place measured in these images, and it is not flat,
  int missed = 0;         ///< and missed
  int there = 0;          ///< objects that were looked at,
  int false_miss = 0;     ///< and missed wrongly
  int found_there = 0;    ///< something was said to be there

  void add(const Score& more) {
    in_view += more.in_view;
    missed_of_all += more.missed_of_all;
    gone += more.gone;
    missed += more.missed;
    there += more.there;
    false_miss += more.false_miss;
    found_there += more.found_there;
  }
};

class Bench {
 public:
  explicit Bench(const Options& options) : options_(options), home_(load()) {
    base::ConfigLayers layers;
    for (const std::string& text : options.settings) {
      layers.settings.push_back(base::parseSetting(text));
    }
    const tracking::BelievedScene scene(home_, OIKOS_DEMO_HOME, {});
    for (const tracking::WatchedObject& object : scene.objects()) {
      if (object.box_object.sizes().minCoeff() < 0.06) {
        flat_.insert(object.id.value);
      }
    }
    config_ = base::loadConfig<tracking::ObjectWatchConfig>(layers);
  }

  void run() {
    for (int scene = 0; scene < options_.scenes; ++scene) {
      runScene(static_cast<std::uint64_t>(options_.seed) * 1000 + static_cast<std::uint64_t>(scene));
    }
    Score all;
    for (const auto& [id, score] : scores_) {
      std::printf("%-14s gone: missed %3d of %3d   there: wrongly missed %2d of %3d, said to be there %3d\n", id.c_str(), score.missed,
                  score.gone, score.false_miss, score.there, score.found_there);
      all.add(score);
    }
    print("gone, in view in two images: missed", all.missed_of_all, all.in_view);
    print("gone, in plain view in two images: missed", all.missed, all.gone);
    print("still there: wrongly missed", all.false_miss, all.there);
    print("still there: something is said to be there", all.found_there, all.there);
    std::printf("%d drives of %d images, %.1f ms of processor time an image in looking\n", drives_, options_.views,
                1000.0 * looking_s_ / std::max(1, drives_ * options_.views));
  }

 private:
  static semantic::Home load() {
    const fs::path file = fs::path(OIKOS_DEMO_HOME) / "home.xml";
    return semantic::getHome(semantic::readHome(file), file);
  }

  static void print(const char* what, int hits, int count) {
    const metrics::ShareInterval interval = metrics::wilsonInterval(hits, count);
    std::printf("%s: %d of %d, %.1f %% (95 %%: %.1f-%.1f)\n", what, hits, count, 100.0 * hits / std::max(1, count), 100.0 * interval.low,
                100.0 * interval.high);
  }

  void runScene(std::uint64_t seed) {
    Random random(seed);
    simulate::BeliefSettings belief;
    belief.dimension_m = options_.belief_mm / 1000.0;
    belief.placement_m = options_.belief_mm / 1000.0;
    belief.placement_deg = 0.06 * options_.belief_mm;
    semantic::Home real = simulate::makeTrueHome(home_, belief, seed);
    const std::set<std::string> gone = takeSome(real, options_, random);
    const semantic::Home now = without(real, gone);
    simulate::World world(real, {OIKOS_DEMO_HOME, seed});
    for (const Carrier& carrier : carriersOf(real)) {
      world.update(real);
      const std::vector<Eigen::Isometry3d> drive = drivePast(carrier, world, options_.views, random);
      if (!drive.empty()) {
        runDrive(carrier, drive, world, {real, now, gone}, random);
      }
    }
  }

  /// Of the camera, where an object was in view.
  struct Places {
    std::vector<Eigen::Vector3d> in_view;
    std::vector<Eigen::Vector3d> measured;
  };
  struct Truth {
    const semantic::Home& all;
    const semantic::Home& now;
    const std::set<std::string>& gone;
  };

  void runDrive(const Carrier& carrier, const std::vector<Eigen::Isometry3d>& drive, simulate::World& world, const Truth& truth,
                Random& random) {
    std::vector<std::map<std::string, Pixels>> seen;
    for (const Eigen::Isometry3d& T_map_camera : drive) {
      seen.push_back(seenIn(world, T_map_camera));
    }
    world.update(truth.now);
    std::vector<tracking::WatchFrame> frames;
    std::vector<camera::RgbdFrame> images;
    for (std::size_t i = 0; i < drive.size(); ++i) {
      frames.push_back(believedFrame(static_cast<int>(i), drive[i], random));
      camera::RgbdFrame image;
      image.index = static_cast<int>(i);
      image.stamp_ns = frames.back().stamp_ns;
      image.depth_m = senseDepth(world, drive[i], base::findEnum<camera::DepthSensorKind>(options_.sensor).value(), random());
      images.push_back(std::move(image));
    }
    std::map<std::string, Places> places;
    for (std::size_t i = 0; i < drive.size(); ++i) {
      for (const auto& [id, pixels] : seen[i]) {
        places[id].in_view.emplace_back(drive[i].translation());
        if (isMeasured(pixels, images[i].depth_m)) {
          places[id].measured.emplace_back(drive[i].translation());
        }
      }
    }
    judge(carrier, watch(frames, images), places, truth.gone);
    ++drives_;
  }

  /// Off by its covariance.
  tracking::WatchFrame believedFrame(int number, const Eigen::Isometry3d& T_map_camera, Random& random) const {
    std::normal_distribution<double> normal;
    geometry::Vector6d sigma;
    sigma.head<3>().setConstant(options_.pose_mm / 1000.0);
    sigma.tail<3>().setConstant(options_.pose_deg * base::kRadPerDeg);
    geometry::Vector6d error;
    for (int i = 0; i < 6; ++i) {
      error(i) = sigma(i) * normal(random);
    }
    tracking::WatchFrame frame;
    frame.frame = number;
    frame.stamp_ns = number * 400'000'000LL;
    frame.T_map_camera = T_map_camera * geometry::expSe3(error);
    frame.covariance = sigma.cwiseAbs2().asDiagonal();
    return frame;
  }

  std::vector<tracking::ObjectReading> watch(const std::vector<tracking::WatchFrame>& frames,
                                             const std::vector<camera::RgbdFrame>& images) {
    const std::clock_t begin = std::clock();
    tracking::ObjectWatch watch(home_, OIKOS_DEMO_HOME, {}, frames, kinectCamera(), config_);
    for (std::vector<int> wanted = watch.wanted(); !wanted.empty(); wanted = watch.wanted()) {
      for (const int number : wanted) {
        watch.look(images[static_cast<std::size_t>(number)], frames[static_cast<std::size_t>(number)]);
      }
    }
    looking_s_ += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return watch.conclude();
  }

  /// From two places apart.
  [[nodiscard]] bool areApart(const std::vector<Eigen::Vector3d>& places) const {
    return std::any_of(places.begin(), places.end(),
                       [&](const Eigen::Vector3d& one) { return (one - places.front()).norm() >= config_.views.apart_m; });
  }

  void judge(const Carrier& carrier, const std::vector<tracking::ObjectReading>& readings, const std::map<std::string, Places>& places,
             const std::set<std::string>& gone) {
    std::map<std::string, const tracking::ObjectReading*> told;
    for (const tracking::ObjectReading& reading : readings) {
      told[reading.id.value] = &reading;
      Score& score = scores_[reading.id.value];
      if (!gone.contains(reading.id.value)) {
        const bool is_missed = reading.status == tracking::WatchStatus::kMissed;
        ++score.there;
        score.false_miss += is_missed ? 1 : 0;
        score.found_there += reading.status == tracking::WatchStatus::kThere ? 1 : 0;
        if (is_missed) {
          describe(carrier, reading.id.value, "wrongly missed", &reading);
        }
      }
    }
    for (const auto& [id, places_of] : places) {
      if (gone.contains(id) && areApart(places_of.in_view)) {
        const auto found = told.find(id);
        judgeGone(carrier, id, !isFlat(id) && areApart(places_of.measured), found == told.end() ? nullptr : found->second);
      }
    }
  }

  void judgeGone(const Carrier& carrier, const std::string& id, bool is_plain, const tracking::ObjectReading* reading) {
    const bool is_missed = reading != nullptr && reading->status == tracking::WatchStatus::kMissed;
    Score& score = scores_[id];
    ++score.in_view;
    score.missed_of_all += is_missed ? 1 : 0;
    score.gone += is_plain ? 1 : 0;
    score.missed += is_plain && is_missed ? 1 : 0;
    if (!is_missed) {
      describe(carrier, id, is_plain ? "in plain view, not missed" : "in view, not missed", reading);
    }
  }

  void describe(const Carrier& carrier, const std::string& id, const char* what, const tracking::ObjectReading* reading) const {
    if (!options_.is_verbose) {
      return;
    }
    const tracking::ObjectReading none;
    const tracking::ObjectReading& one = reading == nullptr ? none : *reading;
    std::printf("  past %s: %s %s: %s, %d images, %d there, %d not there, %d hidden\n", carrier.id.c_str(), id.c_str(), what,
                std::string(base::toString(one.status)).c_str(), one.views, one.there, one.not_there, one.hidden);
  }

  /// Of these a depth image cannot always tell.
  [[nodiscard]] bool isFlat(const std::string& id) const { return flat_.contains(id); }

  const Options& options_;
  semantic::Home home_;
  tracking::ObjectWatchConfig config_;
  std::set<std::string> flat_;  ///< objects with a side below 6 cm
  std::map<std::string, Score> scores_;
  int drives_ = 0;
  double looking_s_ = 0.0;
};

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Small objects that have gone, missed in located depth images of the simulated demo home", "missed_bench");
  app.add_option("--scenes", options.scenes, "true homes; in each a drive past all that carries something");
  app.add_option("--views", options.views, "images of a drive");
  app.add_option("--belief-mm", options.belief_mm, "standard deviation of believed dimensions and places");
  app.add_option("--pose-mm", options.pose_mm, "standard deviation of the camera's place,");
  app.add_option("--pose-deg", options.pose_deg, "and direction, each axis");
  app.add_option("--sensor", options.sensor)->check(CLI::IsMember({"kinect1", "kinect2"}));
  app.add_option("--seed", options.seed);
  app.add_flag("--verbose", options.is_verbose, "each that was not missed");
  app.add_option("--set", options.settings, "any parameter of the watch, as KEY=VALUE")->allow_extra_args(false);
  CLI11_PARSE(app, argc, argv);
  try {
    Bench(options).run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "missed_bench: %s\n", error.what());
    return 1;
  }
}
