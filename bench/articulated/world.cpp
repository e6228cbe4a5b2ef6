// SPDX-License-Identifier: Apache-2.0
#include "bench/articulated/world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/model/primitives.h"
#include "tests/registration/furniture_scan.h"

namespace oikos::bench {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

const std::vector<WorldKind>& kinds() {
  static const std::vector<WorldKind> kinds = {
      {"cabinet", {"cabinet"}},
      {"two doors", {"cabinet", {{"door_count", "2"}, {"width_m", "0.9"}, {"worktop_thickness_m", "0.04"}}}},
      {"wardrobe", {"cabinet", {{"door_count", "2"}, {"width_m", "1.0"}, {"height_m", "1.9"}, {"shelf_count", "4"}}}},
      {"wall cupboard",
       {"cabinet",
        {{"bottom_m", "1.35"},
         {"height_m", "0.7"},
         {"depth_m", "0.35"},
         {"plinth_height_m", "0"},
         {"hinge", "right"},
         {"handle_level", "0.1"}}}},
      {"drawer unit", {"drawer_unit"}},
      {"chest", {"drawer_unit", {{"drawer_count", "5"}, {"width_m", "0.8"}, {"height_m", "1.1"}, {"depth_m", "0.45"}}}},
      {"fridge", {"fridge"}},
      {"oven", {"oven"}},
      {"dishwasher", {"dishwasher"}},
      {"room door", {"room_door"}},
  };
  return kinds;
}

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

double normal(Random& random) {
  return std::normal_distribution<double>()(random);
}

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

std::shared_ptr<const model::TriangleMesh> box(const Eigen::Vector3d& size) {
  model::TriangleMesh mesh = model::makeBox(size.cast<float>());
  mesh.materials.assign(1, {});
  mesh.materials[0].color_rgb = {0.6F, 0.6F, 0.55F};
  mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  return std::make_shared<const model::TriangleMesh>(std::move(mesh));
}

/// As the simulator's [belief] does: origin and direction of each hinge and slide.
void disturbAxes(model::ArticulatedModel& model, const WorldSettings& settings, Random& random) {
  for (model::ModelJoint& joint : model.joints) {
    const Eigen::Vector3d axis = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    joint.T_parent_joint.rotate(Eigen::AngleAxisd(settings.axis_deg * kDegree * normal(random), axis));
    joint.T_parent_joint.pretranslate(settings.axis_m * Eigen::Vector3d(normal(random), normal(random), normal(random)));
  }
}

Eigen::AlignedBox3d boxOf(const model::TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    box.extend(vertex.cast<double>());
  }
  return box;
}

/// Boxes on the shelves, behind the front, and in the drawers, which carry them along.
void addContents(const World& world, render::Scene& scene, Random& random) {
  const std::vector<Eigen::Isometry3d> T_model_part = model::Kinematics(world.real).solve(world.values);
  const Eigen::AlignedBox3d body = boxOf(*world.real.parts[0].mesh_part);
  for (int i = 0; i < 5 && world.kind != "room door"; ++i) {
    const Eigen::Vector3d size(uniform(random, 0.06, 0.2), uniform(random, 0.06, 0.25), uniform(random, 0.08, 0.25));
    const Eigen::Vector3d low = body.min() + 0.5 * size + Eigen::Vector3d(0.03, 0.05, 0.13);
    const Eigen::Vector3d high = body.max() - 0.5 * size - Eigen::Vector3d(0.08, 0.05, 0.06);
    if ((high - low).minCoeff() > 0.0) {
      const Eigen::Vector3d place(uniform(random, low.x(), high.x()), uniform(random, low.y(), high.y()),
                                  uniform(random, low.z(), high.z()));
      scene.add(box(size), world.T_map_model * at(place.x(), place.y(), place.z()));
    }
  }
  for (const model::ModelJoint& joint : world.real.joints) {
    if (joint.type == model::MotionType::kPrismatic && joint.name.find("basket") == std::string::npos) {
      const auto part = static_cast<std::size_t>(joint.child);
      const Eigen::AlignedBox3d drawer = boxOf(*world.real.parts[part].mesh_part);
      const double height_m = 0.4 * drawer.sizes().z();
      const double x = uniform(random, drawer.min().x() + 0.1, drawer.max().x() - 0.2);
      const double y = uniform(random, 0.5, -0.5) * (drawer.sizes().y() - 0.2);
      scene.add(box({0.12, 0.12, height_m}), world.T_map_model * T_model_part[part] * at(x, y, drawer.min().z() + 0.6 * height_m + 0.02));
    }
  }
}

void addRoom(const World& world, render::Scene& scene) {
  scene.add(box({14.0, 14.0, 0.1}), world.T_map_model * at(0.0, 0.0, -0.05));
  const double back_m = boxOf(*world.real.parts[0].mesh_part).min().x();
  if (world.kind != "room door") {
    scene.add(box({0.1, 12.0, 3.0}), world.T_map_model * at(back_m - 0.06, 0.0, 1.5));
    return;
  }
  const double half_m = boxOf(*world.real.parts[0].mesh_part).max().y();
  scene.add(box({0.1, 12.0, 3.0}), world.T_map_model * at(-2.5, 0.0, 1.5));
  for (const double side : {-1.0, 1.0}) {
    scene.add(box({0.10, 4.0, 3.0}), world.T_map_model * at(0.0, side * (half_m + 2.0), 1.5));
  }
}

/// A person between camera and piece, so wide that a share of the piece is hidden.
void addPerson(const World& world, double share, render::Scene& scene, Random& random) {
  constexpr double kOnTheWay = 0.55;  // from the piece to the camera
  const Eigen::AlignedBox3d body = boxOf(*world.real.parts[0].mesh_part);
  const double width_m = share * 1.3 * body.sizes().y() * (1.0 - kOnTheWay);
  const Eigen::Vector3d to_camera = world.T_map_camera.translation() - world.T_map_model.translation();
  const Eigen::Vector3d across = Eigen::Vector3d(-to_camera.y(), to_camera.x(), 0.0).normalized();
  const double aside_m = uniform(random, -0.35, 0.35) * body.sizes().y() * (1.0 - kOnTheWay);
  Eigen::Isometry3d T_map_person = Eigen::Isometry3d::Identity();
  T_map_person.translation() = world.T_map_model.translation() + kOnTheWay * to_camera + aside_m * across;
  T_map_person.translation().z() = 0.85;
  T_map_person.linear().col(0) = Eigen::Vector3d(to_camera.x(), to_camera.y(), 0.0).normalized();
  T_map_person.linear().col(1) = across;
  scene.add(box({0.2, width_m, 1.9}), T_map_person);
}

camera::PinholeCamera cameraOf(camera::DepthSensorKind sensor) {
  return sensor == camera::DepthSensorKind::kKinect2 ? camera::nominalDepthCamera(sensor) : test::kinectCamera();
}

}  // namespace

const std::vector<std::string>& worldKinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> listed;
    for (const WorldKind& kind : kinds()) {
      listed.push_back(kind.name);
    }
    return listed;
  }();
  return names;
}

std::vector<double> randomState(const model::ArticulatedModel& real, const model::ArticulatedModel& believed, Random& random) {
  std::vector<double> values;
  double door_rad = std::numbers::pi;
  for (std::size_t j = 0; j < real.joints.size(); ++j) {
    const model::ModelJoint& joint = real.joints[j];
    const double lower = std::max(joint.lower, believed.joints[j].lower);
    const double upper = std::min(joint.upper, believed.joints[j].upper);
    double value = uniform(random, 0.0, 1.0) < 0.25 ? lower : uniform(random, lower, upper);
    if (joint.type == model::MotionType::kRevolute) {
      door_rad = value;
    } else if (joint.name.find("basket") != std::string::npos && door_rad < 85.0 * kDegree) {
      value = 0.0;
    }
    values.push_back(value);
  }
  return values;
}

void lookFrom(double distance_m, double off_axis_rad, World& world) {
  const double middle_m = boxOf(*world.real.parts[0].mesh_part).center().z();
  world.distance_m = distance_m;
  world.off_axis_rad = off_axis_rad;
  world.T_map_camera = test::cameraBefore(world.T_map_model, distance_m, off_axis_rad, middle_m);
}

World makeWorld(int number, const WorldSettings& settings, Random& random) {
  return makeWorld(kinds()[static_cast<std::size_t>(number) % kinds().size()], settings, random);
}

World makeWorld(const WorldKind& kind, const WorldSettings& settings, Random& random) {
  World world;
  world.kind = kind.name;
  world.real = test::trulyBuilt(kind.shape, settings.dimension_m, random);
  disturbAxes(world.real, settings, random);
  world.believed = test::believed(kind.shape);
  world.values = randomState(world.real, world.believed, random);
  world.T_map_model = at(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), 0.0) *
                      Eigen::AngleAxisd(uniform(random, -std::numbers::pi, std::numbers::pi), Eigen::Vector3d::UnitZ());
  const Eigen::AlignedBox3d body = boxOf(*world.real.parts[0].mesh_part);
  const double off_axis_rad = uniform(random, -60.0, 60.0) * kDegree;
  lookFrom(uniform(random, 0.8, 2.5) + body.max().x(), off_axis_rad, world);
  return world;
}

Picture takePicture(const World& world, const WorldSettings& settings, std::uint64_t seed, Random& random) {
  render::Scene scene;
  scene.add(world.real, world.T_map_model, world.values);
  Picture picture;
  for (const render::ScenePart& part : scene.parts()) {
    picture.part_of_scene.push_back(part.part);
  }
  addRoom(world, scene);
  if (settings.has_contents) {
    addContents(world, scene, random);
  }
  if (settings.occluded > 0.0) {
    addPerson(world, settings.occluded, scene, random);
  }
  picture.part_of_scene.resize(scene.parts().size(), -1);
  scene.commit();
  picture.camera = cameraOf(settings.sensor);
  picture.view = test::viewOf(scene, picture.camera, world.T_map_camera);
  picture.depth_m = test::sensed(picture.view, picture.camera, settings.sensor, seed);
  return picture;
}

Eigen::Isometry3d believedPlace(const World& world, const WorldSettings& settings, Random& random) {
  const double heading_rad = uniform(random, -std::numbers::pi, std::numbers::pi);
  const double x = settings.placement_m * normal(random) + settings.shift_m * std::cos(heading_rad);
  const double y = settings.placement_m * normal(random) + settings.shift_m * std::sin(heading_rad);
  const double side = uniform(random, -1.0, 1.0) < 0.0 ? -1.0 : 1.0;
  const double yaw_deg = settings.placement_deg * normal(random) + side * settings.shift_deg;
  return world.T_map_model * at(x, y, 0.0) * Eigen::AngleAxisd(yaw_deg * kDegree, Eigen::Vector3d::UnitZ());
}

std::vector<double> visibleShares(const World& world, const Picture& picture) {
  constexpr float kSame_m = 0.04F;
  std::vector<double> shares(world.real.parts.size(), 0.0);
  for (int v = 0; v < picture.view.part.rows; ++v) {
    for (int u = 0; u < picture.view.part.cols; ++u) {
      const int shown = picture.view.part.at<int>(v, u);
      const int part = shown < 0 ? -1 : picture.part_of_scene[static_cast<std::size_t>(shown)];
      if (part >= 0 && std::abs(picture.depth_m.at<float>(v, u) - picture.view.depth_m.at<float>(v, u)) < kSame_m) {
        shares[static_cast<std::size_t>(part)] += 1.0;
      }
    }
  }
  const std::vector<Eigen::Isometry3d> T_model_part = model::Kinematics(world.real).solve(world.values);
  for (std::size_t part = 0; part < shares.size(); ++part) {
    if (world.real.parts[part].mesh_part) {
      const Eigen::AlignedBox3d box = boxOf(*world.real.parts[part].mesh_part);
      std::array<double, 3> sizes = {box.sizes().x(), box.sizes().y(), box.sizes().z()};
      std::sort(sizes.begin(), sizes.end());
      const double far_m = (world.T_map_camera.inverse() * world.T_map_model * T_model_part[part] * box.center()).norm();
      shares[part] /= sizes[1] * sizes[2] * picture.camera.fx * picture.camera.fy / (far_m * far_m);
    }
  }
  return shares;
}

}  // namespace oikos::bench
