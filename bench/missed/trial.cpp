// SPDX-License-Identifier: Apache-2.0
#include "bench/missed/trial.h"

#include <algorithm>
#include <ctime>
#include <map>
#include <random>
#include <set>

#include "bench/missed/drive_past.h"
#include "bench/missed/view_truth.h"
#include "core/base/degrees.h"
#include "core/base/enum_table.h"
#include "core/geometry/se3.h"
#include "tests/registration/furniture_scan.h"
#include "tools/simulate/scene_script.h"
#include "tools/simulate/true_home.h"

namespace oikos::bench {

namespace {

using Random = std::mt19937_64;

/// Objects taken from the true home, and all of them nudged a little.
std::set<std::string> takeSome(semantic::Home& home, const MissedOptions& options, Random& random) {
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

/// Off by its covariance.
tracking::WatchFrame believedFrame(int number, const Eigen::Isometry3d& T_map_camera, const MissedOptions& options, Random& random) {
  std::normal_distribution<double> normal;
  geometry::Vector6d sigma;
  sigma.head<3>().setConstant(options.pose_mm / 1000.0);
  sigma.tail<3>().setConstant(options.pose_deg * base::kRadPerDeg);
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

/// Images of a drive, and what is believed of where they were taken.
struct Images {
  std::vector<tracking::WatchFrame> frames;
  std::vector<camera::RgbdFrame> depths;
};

/// Of the camera, where an object was in view.
struct Places {
  std::vector<Eigen::Vector3d> in_view;
  std::vector<Eigen::Vector3d> measured;
};

bool areApart(const std::vector<Eigen::Vector3d>& places, double apart_m) {
  return std::any_of(places.begin(), places.end(), [&](const Eigen::Vector3d& one) { return (one - places.front()).norm() >= apart_m; });
}

/// The homes of a scene: with all objects, and without those that have gone.
class SceneRun {
 public:
  SceneRun(const semantic::Home& believed, const MissedOptions& options, const tracking::ObjectWatchConfig& config, std::uint64_t seed)
      : believed_(believed),
        options_(options),
        config_(config),
        random_(seed),
        real_(trueHome(seed)),
        gone_(takeSome(real_, options, random_)),
        now_(without(real_, gone_)),
        world_(real_, {OIKOS_DEMO_HOME, seed}) {}

  SceneTrials run() {
    for (const Carrier& carrier : carriersOf(real_)) {
      world_.update(real_);
      const std::vector<Eigen::Isometry3d> drive = drivePast(carrier, world_, options_.views, random_);
      if (!drive.empty()) {
        runDrive(carrier, drive);
      }
    }
    return std::move(trials_);
  }

 private:
  [[nodiscard]] semantic::Home trueHome(std::uint64_t seed) const {
    simulate::BeliefSettings belief;
    belief.dimension_m = options_.belief_mm / 1000.0;
    belief.placement_m = options_.belief_mm / 1000.0;
    belief.placement_deg = 0.06 * options_.belief_mm;
    return simulate::makeTrueHome(believed_, belief, seed);
  }

  void runDrive(const Carrier& carrier, const std::vector<Eigen::Isometry3d>& drive) {
    std::vector<std::map<std::string, Pixels>> seen;
    for (const Eigen::Isometry3d& T_map_camera : drive) {
      seen.push_back(seenIn(world_, T_map_camera));
    }
    world_.update(now_);
    const Images images = imagesOf(drive);
    std::map<std::string, Places> places;
    for (std::size_t i = 0; i < drive.size(); ++i) {
      for (const auto& [id, pixels] : seen[i]) {
        places[id].in_view.emplace_back(drive[i].translation());
        if (isMeasured(pixels, images.depths[i].depth_m)) {
          places[id].measured.emplace_back(drive[i].translation());
        }
      }
    }
    note(carrier, watch(images), places);
    ++trials_.drives;
  }

  [[nodiscard]] Images imagesOf(const std::vector<Eigen::Isometry3d>& drive) {
    const auto kind = base::findEnum<camera::DepthSensorKind>(options_.sensor).value();
    const camera::PinholeCamera camera = test::kinectCamera();
    Images images;
    for (std::size_t i = 0; i < drive.size(); ++i) {
      images.frames.push_back(believedFrame(static_cast<int>(i), drive[i], options_, random_));
      camera::RgbdFrame image;
      image.index = static_cast<int>(i);
      image.stamp_ns = images.frames.back().stamp_ns;
      image.depth_m = test::sensed(test::viewOf(world_.scene(), camera, drive[i]), camera, kind, random_());
      images.depths.push_back(std::move(image));
    }
    return images;
  }

  [[nodiscard]] std::vector<tracking::ObjectReading> watch(const Images& images) {
    const std::clock_t begin = std::clock();
    tracking::ObjectWatch watch(believed_, OIKOS_DEMO_HOME, {}, images.frames, test::kinectCamera(), config_);
    for (std::vector<int> wanted = watch.wanted(); !wanted.empty(); wanted = watch.wanted()) {
      for (const int number : wanted) {
        watch.look(images.depths[static_cast<std::size_t>(number)], images.frames[static_cast<std::size_t>(number)]);
      }
    }
    trials_.looking_s += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return watch.conclude();
  }

  void note(const Carrier& carrier, const std::vector<tracking::ObjectReading>& readings, const std::map<std::string, Places>& places) {
    std::map<std::string, ObjectTrial> trials;
    for (const tracking::ObjectReading& reading : readings) {
      trials[reading.id.value].reading = reading;
    }
    for (const auto& [id, where] : places) {
      if (trials.contains(id) || gone_.contains(id)) {
        trials[id].is_in_view = areApart(where.in_view, config_.views.apart_m);
        trials[id].is_measured = areApart(where.measured, config_.views.apart_m);
      }
    }
    for (auto& [id, trial] : trials) {
      trial.carrier = carrier.id;
      trial.id = id;
      trial.is_gone = gone_.contains(id);
      trials_.objects.push_back(std::move(trial));
    }
  }

  const semantic::Home& believed_;
  const MissedOptions& options_;
  const tracking::ObjectWatchConfig& config_;
  Random random_;
  semantic::Home real_;
  std::set<std::string> gone_;
  semantic::Home now_;
  simulate::World world_;
  SceneTrials trials_;
};

}  // namespace

SceneTrials runScene(const semantic::Home& home, const MissedOptions& options, const tracking::ObjectWatchConfig& config,
                     std::uint64_t seed) {
  return SceneRun(home, options, config, seed).run();
}

}  // namespace oikos::bench
