// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/truth_log.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "core/base/atomic_file.h"
#include "core/base/number_text.h"
#include "core/recording/png_encoder.h"

namespace oikos::simulate {

namespace {

/// Pixels of one part, and the box around them.
struct Patch {
  int pixels = 0;
  int left = 1 << 30;
  int top = 1 << 30;
  int right = -1;
  int bottom = -1;
};

std::map<int, Patch> patchesOf(const cv::Mat& part) {
  std::map<int, Patch> patches;
  for (int v = 0; v < part.rows; ++v) {
    const auto* const row = part.ptr<std::int32_t>(v);
    for (int u = 0; u < part.cols;) {
      const std::int32_t number = row[u];
      const int first = u;
      while (u < part.cols && row[u] == number) {
        ++u;
      }
      if (number >= 0) {
        Patch& patch = patches[number];
        patch.pixels += u - first;
        patch.left = std::min(patch.left, first);
        patch.right = std::max(patch.right, u - 1);
        patch.top = std::min(patch.top, v);
        patch.bottom = std::max(patch.bottom, v);
      }
    }
  }
  return patches;
}

/// The pixels that a part's bounds cover, within the picture and with a margin for the lens; the whole picture if some of it is behind the
/// camera.
cv::Rect frameOf(const render::ScenePart& part, const Eigen::Isometry3d& T_camera_part, const camera::PinholeCamera& camera,
                 const camera::LensDistortion& distortion) {
  constexpr int kMargin_px = 4;
  const cv::Rect whole(0, 0, camera.width, camera.height);
  const Eigen::AlignedBox3f bounds = part.mesh_part->bounds();
  Eigen::AlignedBox2d pixels;
  for (int i = 0; i < 8; ++i) {
    const auto corner = static_cast<Eigen::AlignedBox3f::CornerType>(i);
    const Eigen::Vector3d corner_camera = T_camera_part * bounds.corner(corner).cast<double>();
    if (corner_camera.z() < 0.05) {
      return whole;
    }
    const Eigen::Vector2d seen = distortion.distort(corner_camera.hnormalized());
    pixels.extend(camera.project(seen.homogeneous()));
  }
  const auto pixel = [](double value) { return static_cast<int>(std::lround(std::clamp(value, -1e6, 1e6))); };
  const cv::Point low(pixel(pixels.min().x()) - kMargin_px, pixel(pixels.min().y()) - kMargin_px);
  const cv::Point high(pixel(pixels.max().x()) + kMargin_px + 1, pixel(pixels.max().y()) + kMargin_px + 1);
  return cv::Rect(low, high) & whole;
}

}  // namespace

void TruthLog::noteStates(const semantic::Home& home, double time_s) {
  const auto note = [&](const std::string& id, const std::string& value, const char* unit) {
    std::string& last = last_values_[id];
    if (last != value) {
      states_ += base::toText(time_s) + "," + id + "," + value + "," + unit + "\n";
      last = value;
    }
  };
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (!object.articulation) {
        continue;
      }
      for (const semantic::Joint& joint : object.articulation->joints) {
        const bool turns = joint.type == semantic::JointType::kRevolute;
        note(joint.id.value, base::toText(turns ? joint.value / semantic::kRadPerDeg : joint.value), turns ? "deg" : "m");
      }
      for (const semantic::Knob& knob : object.articulation->knobs) {
        note(knob.id.value, knob.current, "state");
      }
    }
  }
}

void TruthLog::noteObjects(const World& world, const Shot& shot, double time_s) {
  const std::map<int, Patch> patches = patchesOf(shot.part);
  const Eigen::Isometry3d T_camera_map = shot.T_map_camera.inverse();
  nlohmann::ordered_json objects = nlohmann::ordered_json::array();
  for (const auto& [number, patch] : patches) {
    const render::ScenePart& part = world.scene().parts()[static_cast<std::size_t>(number)];
    const auto& small = world.smallPieces();
    const auto piece = std::find_if(small.begin(), small.end(), [&](const auto& entry) { return entry.second.model == part.model; });
    if (piece == small.end()) {
      continue;
    }
    const Eigen::Isometry3d T = T_camera_map * part.T_map_part;
    const Eigen::Quaterniond q(T.linear());
    const double share = std::min(1.0, static_cast<double>(patch.pixels) / std::max(patch.pixels, pixelsAlone(part, shot)));
    nlohmann::ordered_json object;
    object["id"] = piece->first;
    object["T_camera_object"] = {T.translation().x(), T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w()};
    object["box_px"] = {patch.left, patch.top, patch.right, patch.bottom};
    object["visible_share"] = std::round(share * 1000.0) / 1000.0;
    objects.push_back(std::move(object));
  }
  nlohmann::ordered_json line;
  line["t"] = time_s;
  line["objects"] = std::move(objects);
  objects_ += line.dump() + "\n";
}

/// How many pixels it would have if nothing stood before it.
int TruthLog::pixelsAlone(const render::ScenePart& part, const Shot& shot) {
  const cv::Rect frame = frameOf(part, shot.T_map_camera.inverse() * part.T_map_part, camera_, distortion_);
  if (frame.empty()) {
    return 0;
  }
  auto found = alone_.find(part.mesh_part.get());
  if (found == alone_.end()) {
    found = alone_.emplace(part.mesh_part.get(), render::Scene()).first;
    found->second.add(part.mesh_part, part.T_map_part);
  }
  found->second.move(0, part.T_map_part, {});
  found->second.commit();
  camera::PinholeCamera crop = camera_;
  crop.width = frame.width;
  crop.height = frame.height;
  crop.cx -= frame.x;
  crop.cy -= frame.y;
  const render::View view = renderView(found->second, render::CameraRays(crop, distortion_), {shot.T_map_camera, {}}, {});
  return cv::countNonZero(view.depth_m == view.depth_m);
}

void TruthLog::write(const std::filesystem::path& folder) const {
  base::writeFileAtomically(folder / "states.csv", states_);
  base::writeFileAtomically(folder / "objects.jsonl", objects_);
}

void TruthLog::writePartNames(const World& world, const std::filesystem::path& folder) {
  std::string table = "number,id,part\n";
  int number = 0;
  for (const World::PartName& name : world.partNames()) {
    table += std::to_string(++number) + "," + name.id + "," + name.part + "\n";
  }
  base::writeFileAtomically(folder / "parts.csv", table);
}

void TruthLog::writeParts(const Shot& shot, const std::filesystem::path& file) {
  cv::Mat numbers;
  shot.part.convertTo(numbers, CV_16UC1, 1.0, 1.0);
  const std::vector<unsigned char> png = recording::encodePng(numbers, 1);
  base::writeFileAtomically(file, std::string(png.begin(), png.end()));
}

}  // namespace oikos::simulate
