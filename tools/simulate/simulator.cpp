// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/simulator.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>

#include "core/base/atomic_file.h"
#include "core/base/number_text.h"
#include "core/model/primitives.h"
#include "core/recording/trajectory.h"
#include "core/tags/tag_setup.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/home_writer.h"
#include "tools/simulate/ceiling_camera.h"
#include "tools/simulate/dice.h"
#include "tools/simulate/frame_writer.h"
#include "tools/simulate/home_change.h"
#include "tools/simulate/rig.h"
#include "tools/simulate/scene_script.h"
#include "tools/simulate/shooter.h"
#include "tools/simulate/true_home.h"
#include "tools/simulate/truth_log.h"
#include "tools/simulate/unmodelled.h"
#include "tools/simulate/wheel_odometry.h"
#include "tools/simulate/world.h"

namespace oikos::simulate {

namespace {

namespace fs = std::filesystem;

constexpr double kWallHeight_m = 2.5;

/// A home's folder by one of its scenes.
fs::path homeOf(const fs::path& script) {
  const fs::path scenes = fs::absolute(script).lexically_normal().parent_path();
  if (scenes.filename() != "scenes" || !fs::exists(scenes.parent_path() / "home.xml")) {
    throw base::Error(base::ErrorCode::kInput,
                      "a scene lies in the folder scenes of the home that it is about, beside whose home.xml it finds it", script.string());
  }
  return scenes.parent_path();
}

std::string stampText(double time_s) {
  return base::toFixedText(time_s, 6);
}

const char* extensionOf(int jpeg_quality) {
  return jpeg_quality > 0 ? ".jpg" : ".png";
}

std::vector<double> numbersOf(const std::string& text) {
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    numbers.push_back(*base::findNumber(word));
  }
  return numbers;
}

render::Lighting lightingOf(const LightSettings& settings, const semantic::Home& home) {
  render::Lighting lighting;
  lighting.from_above_rgb.setConstant(static_cast<float>(settings.glow));
  lighting.from_below_rgb.setConstant(0.6F * static_cast<float>(settings.glow));
  lighting.has_shadows = settings.shadows;
  lighting.lamps = settings.lamps.empty() ? ceilingLamps(home, kWallHeight_m) : std::vector<render::PointLight>{};
  for (const std::string& lamp : settings.lamps) {
    const std::vector<double> n = numbersOf(lamp);
    lighting.lamps.push_back({{n[0], n[1], n[2]}, Eigen::Vector3f(1.0F, 0.96F, 0.9F) * static_cast<float>(n[3]), 1e6F});
  }
  return lighting;
}

/// Somebody on their way from one place to another.
struct Walker {
  int model = 0;
  double from_s = 0.0;
  double to_s = 0.0;
  Eigen::Vector2d from_map = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_map = Eigen::Vector2d::Zero();
};

model::TriangleMesh makePerson() {
  model::TriangleMesh person;
  model::TriangleMesh body = model::makeCylinder({.radius_m = 0.19F, .length_m = 1.4F, .segments = 32});
  body.materials.assign(1, {});
  body.materials.front().color_rgb = {0.25F, 0.3F, 0.45F};
  append(person, body, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.75)));
  append(person, model::makeSphere({.radius_m = 0.13F, .rings = 16}), Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 1.6)));
  return person;
}

class Simulation {
 public:
  explicit Simulation(const SimulationJob& job)
      : job_(job),
        script_(readSceneScript(job.script)),
        home_folder_(homeOf(job.script)),
        believed_(semantic::getHome(semantic::readHome(home_folder_ / "home.xml"), home_folder_ / "home.xml")),
        home_(makeTrueHome(believed_, script_.belief, job.seed)),
        path_(pathOf(script_)),
        nominal_(nominalCalibration(script_)),
        writer_(script_.camera.jpeg_quality, job.threads) {
    for (const std::string& text : script_.changes) {
      changes_.push_back(*parseHomeChange(text));
    }
    std::stable_sort(changes_.begin(), changes_.end(), [](const HomeChange& a, const HomeChange& b) { return a.at_s < b.at_s; });
    semantic::Home rehearsal = believed_;
    for (const HomeChange& change : changes_) {
      apply(change, rehearsal, job_.script.string());  // so that a late one is not refused after hours
    }
  }

  SimulationSummary run() {
    const double end_s = endOf();
    for (const char* folder : {"rgb", "depth", "truth"}) {
      fs::create_directory(job_.folder / folder);
    }
    World world(home_, {home_folder_, job_.seed, kWallHeight_m, script_.belief.extra_part_share, job_.threads});
    for (const LooseBox& box : scatterBoxes(home_, path_, {world.footprints(), end_s}, script_.belief.clutter, job_.seed)) {
      world.add(box.model, box.T_map_model);
    }
    addWalkers(world);
    addCeilingCamera(world);
    const camera::Calibration calibration = trueCalibration(nominal_, script_.belief, job_.seed);
    Shooter shooter(shotSettings(calibration));
    TruthLog truth(calibration);
    if (script_.part_images) {
      fs::create_directory(job_.folder / "truth" / "parts");
      TruthLog::writePartNames(world, job_.folder / "truth");
    }
    const auto frames = static_cast<int>(std::floor(end_s * script_.rate_hz)) + 1;
    Dice dice(job_.seed + 801);
    for (int i = 0; i < frames; ++i) {
      const double time_s = static_cast<double>(toStamp(i / script_.rate_hz)) / 1e9;  // as the lists write it
      update(world, time_s);
      truth.noteStates(home_, time_s);
      const FloorPose base = path_.at(time_s - script_.path.stand_s);
      T_map_base_.push_back({toStamp(time_s), base.T_map_base()});
      watch(world, i);
      base::reportProgress(job_.progress, {"simulating", i + 1, frames});
      if (dice.next() < script_.camera.lost_share) {
        ++summary_.lost_frames;
        continue;
      }
      const Shot shot = shooter.shoot(world.scene(), path_, time_s - script_.path.stand_s, i);
      truth.noteObjects(world, shot, time_s);
      if (script_.part_images) {
        TruthLog::writeParts(shot, job_.folder / "truth" / "parts" / (stampText(time_s) + ".png"));
      }
      write(shot, time_s);
    }
    writer_.finish();
    writeLists();
    truth.write(job_.folder / "truth");
    summary_.duration_s = end_s;
    return summary_;
  }

 private:
  [[nodiscard]] double endOf() const {
    constexpr double kLongest_s = 24.0 * 3600.0;
    const double end_s = script_.duration_s > 0.0 ? script_.duration_s : path_.duration_s() + 2.0 * script_.path.stand_s;
    if (!(end_s <= kLongest_s)) {
      throw base::Error(base::ErrorCode::kInput, "path: takes " + base::toText(end_s) + " s, must be at most a day; give duration_s",
                        job_.script.string());
    }
    return end_s;
  }

  static std::int64_t toStamp(double time_s) { return std::llround(time_s * 1e6) * 1000; }

  [[nodiscard]] ShotSettings shotSettings(const camera::Calibration& calibration) const {
    ShotSettings settings;
    settings.calibration = calibration;
    settings.depth.kind = script_.sensor;
    settings.depth.units_per_m = nominal_.depth_scale;
    settings.depth.scale_error = script_.belief.depth_scale_share;
    settings.lighting = lightingOf(script_.light, home_);
    settings.readout_s = script_.camera.readout_s;
    settings.depth_delay_s = script_.camera.depth_delay_s;
    settings.seed = job_.seed;
    settings.threads = job_.threads;
    return settings;
  }

  void addWalkers(World& world) {
    const auto person = std::make_shared<const model::TriangleMesh>(makePerson());
    for (const std::string& text : script_.walkers) {
      const std::vector<double> n = numbersOf(text);
      walkers_.push_back({world.scene().add(person, Eigen::Isometry3d::Identity()), n[0], n[1], {n[2], n[3]}, {n[4], n[5]}});
    }
  }

  void addCeilingCamera(World& world) {
    if (!script_.ceiling_camera.position_m.empty()) {
      fs::create_directories(job_.folder / "ceiling" / "rgb");
      ceiling_.emplace(script_.ceiling_camera, lightingOf(script_.light, home_), world.scene());
    }
  }

  /// The ceiling camera's picture of a frame, whether or not the robot's own is lost.
  void watch(World& world, int frame) {
    constexpr std::uint64_t kNoise = 601;  // another than the robot's camera has
    if (ceiling_) {
      const recording::StampedPose& base = T_map_base_.back();
      const camera::SensorRun run{job_.seed + kNoise, frame, job_.threads};
      const int quality = script_.ceiling_camera.jpeg_quality;
      const std::string stamp = stampText(static_cast<double>(base.stamp_ns) / 1e9);
      const std::string file = "rgb/" + stamp + extensionOf(quality);
      writeImage(job_.folder / "ceiling" / file, ceiling_->shoot(world.scene(), base.T_map_camera, run), quality);
      ceiling_pictures_ += stamp + " " + file + "\n";
    }
  }

  void update(World& world, double time_s) {
    for (; next_change_ < changes_.size() && changes_[next_change_].at_s <= time_s; ++next_change_) {
      apply(changes_[next_change_], home_, job_.script.string(), BeyondLimits::kStop);
    }
    for (const Walker& walker : walkers_) {
      const double share = std::clamp((time_s - walker.from_s) / (walker.to_s - walker.from_s), 0.0, 1.0);
      const Eigen::Vector2d place_map = walker.from_map + share * (walker.to_map - walker.from_map);
      world.scene().move(walker.model, Eigen::Isometry3d(Eigen::Translation3d(place_map.x(), place_map.y(), 0.0)), {});
      world.scene().show(walker.model, time_s >= walker.from_s && time_s <= walker.to_s);
    }
    world.update(home_);
  }

  void write(const Shot& shot, double time_s) {
    const double depth_s = time_s + script_.camera.depth_delay_s;
    const int quality = script_.camera.jpeg_quality;
    const std::string color_file = "rgb/" + stampText(time_s) + extensionOf(quality);
    const std::string depth_file = "depth/" + stampText(depth_s) + ".png";
    writer_.write({job_.folder / color_file, job_.folder / depth_file, shot.color, shot.depth});
    colors_ += stampText(time_s) + " " + color_file + "\n";
    depths_ += stampText(depth_s) + " " + depth_file + "\n";
    T_map_camera_.push_back({toStamp(time_s), shot.T_map_camera});
    ++summary_.frames;
  }

  void writeLists() const {
    base::writeFileAtomically(job_.folder / "rgb.txt", colors_);
    base::writeFileAtomically(job_.folder / "depth.txt", depths_);
    base::writeFileAtomically(job_.folder / "camera.toml", toToml(nominal_, script_.start));
    recording::writeTrajectory(T_map_camera_, job_.folder / "groundtruth.txt");
    if (script_.odometry.is_written) {
      recording::writeTrajectory(makeWheelOdometry(T_map_base_, script_.odometry, job_.seed), job_.folder / "odometry.txt");
      recording::writeTrajectory(makePrior(T_map_base_, script_.odometry, job_.seed), job_.folder / "prior.txt");
    }
    if (ceiling_) {
      base::writeFileAtomically(job_.folder / "ceiling" / "rgb.txt", ceiling_pictures_);
      base::writeFileAtomically(job_.folder / "ceiling" / "camera.toml", toToml(ceiling_->calibration(), script_.start));
      base::writeFileAtomically(job_.folder / "ceiling" / "tags.toml", base::writeConfig(ceiling_->setup()));
    }
    base::writeFileAtomically(job_.folder / "truth" / "home.xml", semantic::toXml(home_));
    base::writeFileAtomically(job_.folder / "truth" / "scene.toml",
                              "# oikos simulate --seed " + std::to_string(job_.seed) + "\n" + base::writeConfig(script_));
  }

  const SimulationJob& job_;
  const SceneScript script_;
  const fs::path home_folder_;
  const semantic::Home believed_;
  semantic::Home home_;  ///< the true one, in its present state
  const RobotPath path_;
  const camera::Calibration nominal_;
  FrameWriter writer_;
  std::vector<HomeChange> changes_;
  std::size_t next_change_ = 0;
  std::vector<Walker> walkers_;
  std::optional<CeilingCamera> ceiling_;
  std::string ceiling_pictures_ = "# stamp file\n";
  std::string colors_ = "# stamp file\n";
  std::string depths_ = "# stamp file\n";
  recording::Trajectory T_map_camera_;
  recording::Trajectory T_map_base_;
  SimulationSummary summary_;
};

}  // namespace

SimulationSummary simulate(const SimulationJob& job) {
  return Simulation(job).run();
}

}  // namespace oikos::simulate
