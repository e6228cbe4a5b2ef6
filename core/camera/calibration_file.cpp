// SPDX-License-Identifier: Apache-2.0
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/base/read_file.h"
#include "core/base/rfc3339.h"
#include "core/camera/calibration.h"
#include "core/geometry/pose_numbers.h"

namespace oikos::camera {

namespace {

std::string shown(const toml::node& node) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  node.visit([&text](const auto& value) { text << value; });
  return text.str();
}

/// One table of the file; every complaint names file, line and key.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string file, std::string prefix)
      : table_(table), file_(std::move(file)), prefix_(std::move(prefix)) {}

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    const toml::node* node = table_.get(key);
    const toml::node& place = node != nullptr ? *node : static_cast<const toml::node&>(table_);
    const auto line = place.source().begin.line;
    throw base::Error(base::ErrorCode::kInput, prefix_ + key + (node != nullptr ? " = " + shown(*node) : "") + ": " + what,
                      line > 0 ? file_ + ":" + std::to_string(line) : file_);
  }

  void rejectUnknownKeys(const std::vector<std::string>& known) const {
    for (const auto& [key, value] : table_) {
      const std::string name(key.str());
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        fail(name, "unknown key; the nearest known one is '" + prefix_ + base::nearestName(name, known) + "'");
      }
    }
  }

  [[nodiscard]] const toml::node* find(const std::string& key) const { return table_.get(key); }

  [[nodiscard]] double getNumber(const std::string& key, const std::string& meaning) const {
    const toml::node* node = find(key);
    if (node == nullptr) {
      fail(key, "is missing: " + meaning);
    }
    const auto number = node->is_number() ? node->value<double>() : std::nullopt;
    if (!number || !std::isfinite(*number)) {
      fail(key, "must be a finite number: " + meaning);
    }
    return *number;
  }

  [[nodiscard]] double getPositive(const std::string& key, const std::string& meaning, double limit) const {
    const double number = getNumber(key, meaning);
    if (number <= 0.0 || number > limit) {
      fail(key, "must be > 0 and <= " + std::to_string(static_cast<int>(limit)) + ": " + meaning);
    }
    return number;
  }

  [[nodiscard]] int getSize(const std::string& key) const {
    const double number = getNumber(key, "pixels");
    if (number != std::floor(number) || number < 8 || number > 16384) {
      fail(key, "must be a whole number of pixels from 8 to 16384");
    }
    return static_cast<int>(number);
  }

  template <std::size_t kCount>
  [[nodiscard]] std::array<double, kCount> getNumbers(const std::string& key, const std::string& meaning) const {
    const toml::array* list = find(key) != nullptr ? find(key)->as_array() : nullptr;
    if (list == nullptr || list->size() != kCount) {
      fail(key, "must be a list of " + std::to_string(kCount) + " numbers: " + meaning);
    }
    std::array<double, kCount> numbers{};
    for (std::size_t i = 0; i < kCount; ++i) {
      const toml::node& node = *list->get(i);
      const auto number = node.is_number() ? node.value<double>() : std::nullopt;
      if (!number || !std::isfinite(*number)) {
        fail(key, "element " + std::to_string(i + 1) + " is not a finite number: " + meaning);
      }
      numbers[i] = *number;
    }
    return numbers;
  }

  [[nodiscard]] Eigen::Isometry3d getPose(const std::string& key) const {
    const auto pose = geometry::poseFromNumbers(getNumbers<7>(key, "tx, ty, tz (m), qx, qy, qz, qw"));
    if (!pose) {
      fail(key, "the quaternion qx, qy, qz, qw must have norm 1 (within 0.001)");
    }
    return *pose;
  }

  [[nodiscard]] PinholeCamera getPinhole() const {
    constexpr double kLongestFocalLength_px = 100000.0;
    PinholeCamera pinhole;
    pinhole.width = getSize("width");
    pinhole.height = getSize("height");
    pinhole.fx = getPositive("fx", "focal length in pixels", kLongestFocalLength_px);
    pinhole.fy = getPositive("fy", "focal length in pixels", kLongestFocalLength_px);
    pinhole.cx = getPositive("cx", "principal point in pixels, inside the image", pinhole.width);
    pinhole.cy = getPositive("cy", "principal point in pixels, inside the image", pinhole.height);
    return pinhole;
  }

 private:
  const toml::table& table_;
  std::string file_;
  std::string prefix_;
};

DepthCorrection readCorrection(const TableReader& reader) {
  constexpr double kMost = 0.2;
  const auto c = reader.getNumbers<4>("correction", "constant, per metre, across, down");
  if (std::any_of(c.begin(), c.end(), [](double share) { return std::abs(share) > kMost; })) {
    reader.fail("correction",
                "each share must be from -0.2 to 0.2: a reading is multiplied by 1 + constant + per_m * z + across * x + down * y");
  }
  return {c[0], c[1], c[2], c[3]};
}

double readDepthDistortion(const TableReader& reader) {
  constexpr double kMost = 0.2;
  const auto share = reader.find("depth_distortion")->value<double>();
  if (!share || !(*share >= 0.0 && *share <= kMost)) {
    reader.fail("depth_distortion", "must be a share of the distance from 0 to 0.2, such as 0.003");
  }
  return *share;
}

DepthCamera readDepthCamera(const TableReader& parent, const std::string& file) {
  const toml::table* table = parent.find("depth")->as_table();
  if (table == nullptr) {
    parent.fail("depth", "must be a table: [depth] with width, height, fx, fy, cx, cy, T_color_depth");
  }
  const TableReader reader(*table, file, "depth.");
  reader.rejectUnknownKeys({"width", "height", "fx", "fy", "cx", "cy", "T_color_depth", "correction"});
  DepthCamera depth{reader.getPinhole(), reader.getPose("T_color_depth"), {}};
  if (reader.find("correction") != nullptr) {
    depth.correction = readCorrection(reader);
  }
  return depth;
}

std::int64_t readStart(const TableReader& reader) {
  const toml::node& node = *reader.find("start");
  const auto start_ns = base::parseRfc3339Ns(node.is_string() ? *node.value<std::string>() : shown(node));
  if (!start_ns) {
    reader.fail("start", "must be a time with its offset (RFC 3339), such as 2024-05-17T09:30:00+02:00");
  }
  return *start_ns;
}

toml::table parseFile(const std::filesystem::path& file) {
  const std::string text = base::readFile(file);
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw base::Error(base::ErrorCode::kInput, std::string(error.description()),
                      file.string() + ":" + std::to_string(error.source().begin.line));
  }
}

}  // namespace

Calibration readCalibration(const std::filesystem::path& file) {
  const toml::table table = parseFile(file);
  const TableReader reader(table, file.string(), "");
  reader.rejectUnknownKeys({"width", "height", "fx", "fy", "cx", "cy", "distortion", "depth_scale", "depth_distortion", "start", "rate_hz",
                            "T_base_camera", "depth"});
  Calibration calibration;
  calibration.color = reader.getPinhole();
  calibration.depth_scale = reader.getPositive("depth_scale", "depth units per metre, such as 1000 (millimetres) or 5000 (TUM)", 1e7);
  if (reader.find("depth_distortion") != nullptr) {
    calibration.depth_distortion = readDepthDistortion(reader);
  }
  if (reader.find("distortion") != nullptr) {
    const auto d = reader.getNumbers<5>("distortion", "k1, k2, p1, p2, k3");
    calibration.distortion = {d[0], d[1], d[2], d[3], d[4]};
  }
  if (reader.find("start") != nullptr) {
    calibration.start_ns = readStart(reader);
  }
  if (reader.find("rate_hz") != nullptr) {
    calibration.rate_hz = reader.getPositive("rate_hz", "frames per second", 10000.0);
  }
  if (reader.find("T_base_camera") != nullptr) {
    calibration.T_base_camera = reader.getPose("T_base_camera");
  }
  if (reader.find("depth") != nullptr) {
    calibration.depth = readDepthCamera(reader, file.string());
  }
  return calibration;
}

}  // namespace oikos::camera
