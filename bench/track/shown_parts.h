// SPDX-License-Identifier: Apache-2.0
// How much of a door or drawer the pictures of a simulated drive really show.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semantic/model/home.h"

namespace oikos::bench {

/// By frame of a drive with images of parts: pixels that show the part which the joint moves and have a reading of it, over those of its
/// largest face seen straight on from there (as articulated_bench counts). Throws std::runtime_error for a drive without such images or a
/// joint that the drive's home does not have.
class ShownParts {
 public:
  /// `drive`: the recording's folder.
  explicit ShownParts(const std::filesystem::path& drive);

  [[nodiscard]] std::vector<double> sharesOf(const std::string& joint_id) const;

 private:
  struct Part {
    int number = 0;         ///< in the images
    double face_sqm = 0.0;  ///< of its largest face
    Eigen::Vector3d middle_map;
  };
  [[nodiscard]] Part partOf(const std::string& joint_id) const;

  std::filesystem::path drive_;
  semantic::Home home_;  ///< as it truly was at the end
};

}  // namespace oikos::bench
