// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/earlier_drives.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/error.h"
#include "core/base/read_file.h"

namespace oikos::mapping {

namespace {

using Json = nlohmann::json;

DriveFacts driveOf(const Json& entry) {
  DriveFacts drive;
  drive.first_frame = entry.at("first_frame").get<int>();
  drive.frames = entry.at("frames").get<int>();
  drive.added_to_stamps_s = entry.at("added_to_stamps_s").get<std::int64_t>();
  return drive;
}

void checkDrives(const std::vector<DriveFacts>& drives, int frames, const std::filesystem::path& file) {
  int next = 0;
  for (const DriveFacts& drive : drives) {
    if (drive.first_frame != next || drive.frames < 1) {
      throw base::Error(base::ErrorCode::kInput,
                        "drives: one of " + std::to_string(drive.frames) + " frames from " + std::to_string(drive.first_frame) + " on, " +
                            std::to_string(next) + " expected",
                        file.string());
    }
    next += drive.frames;
  }
  if (next != frames) {
    throw base::Error(base::ErrorCode::kInput,
                      "drives: " + std::to_string(next) + " frames, but trajectory.txt beside it has " + std::to_string(frames),
                      file.string());
  }
}

}  // namespace

EarlierDrives readEarlierDrives(const std::filesystem::path& file, int frames) {
  EarlierDrives earlier;
  try {
    const Json report = Json::parse(base::readFile(file));
    earlier.is_floor_found = report.at("floor").at("status").get<std::string>() == base::toString(FloorSighting::kFound);
    if (const auto drives = report.find("drives"); drives != report.end()) {
      for (const Json& entry : *drives) {
        earlier.drives.push_back(driveOf(entry));
      }
    } else {
      earlier.drives.push_back({0, frames, 0});
    }
  } catch (const Json::exception& error) {
    throw base::Error(base::ErrorCode::kInput, std::string("is no report of a map: ") + error.what(), file.string());
  }
  checkDrives(earlier.drives, frames, file);
  return earlier;
}

}  // namespace oikos::mapping
