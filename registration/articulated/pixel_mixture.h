// SPDX-License-Identifier: Apache-2.0
// What a depth reading says about a surface that a model has in its pixel. Included by this folder's sources and tests only.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace oikos::registration {

/// How likely what is in a pixel, if the model shows a surface there. What is left of 1 is a reading from nowhere.
struct MixtureConfig {
  double as_modelled = 0.85;
  double nearer = 0.12;          ///< something stands before it: a person, a hand
  double behind = 0.01;          ///< the surface is not there
  double contents = 0.35;        ///< taken from `as_modelled` where the surface lies inside its link: what the cupboard or drawer holds
  double min_room_m = 0.06;      ///< from a link's hull to the surface behind it, so that something can stand in between
  double max_normal_deg = 40.0;  ///< between normals: beyond, the reading is a tenth as likely of this surface
  double range_m = 4.5;          ///< the farthest reading

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("as_modelled", as_modelled);
    visitor("nearer", nearer);
    visitor("behind", behind);
    visitor("contents", contents);
    visitor("min_room_m", min_room_m);
    visitor("max_normal_deg", max_normal_deg);
    visitor("range_m", range_m);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// A surface of the model in a pixel; depths along the optical axis.
struct ModelledPixel {
  double depth_m = 0.0;
  double sigma_m = 0.0;  ///< of a reading of it, along the optical axis
  bool faces = true;     ///< as the reading does
  double room_m = 0.0;   ///< from where the ray enters the link's hull to the surface
};

/// An explicit mixture, each component with its density of the reading (1/m): as modelled, a normal distribution; nearer, contents and
/// behind, even over what there is of room. Immutable, so thread-safe.
class PixelMixture {
 public:
  explicit PixelMixture(const MixtureConfig& config);

  /// Log of the density of a reading.
  [[nodiscard]] double logOfSurface(double reading_m, const ModelledPixel& surface) const;
  /// The same where the model shows nothing: the room behind it.
  [[nodiscard]] double logOfNothing() const { return log_of_nothing_; }
  /// How likely the reading is of the surface, and not one of the rest.
  [[nodiscard]] double shareOfSurface(double reading_m, const ModelledPixel& surface) const;

  [[nodiscard]] double minRoom_m() const { return config_.min_room_m; }
  [[nodiscard]] double minNormalCos() const { return min_normal_cos_; }

 private:
  struct Densities {
    double surface = 0.0;
    double rest = 0.0;
  };
  [[nodiscard]] Densities densities(double reading_m, const ModelledPixel& surface) const;

  MixtureConfig config_;
  double log_of_nothing_;
  double min_normal_cos_;
};

/// From a ray's start to where it enters a box, in lengths of the ray; 0 if it starts inside, infinite if it passes by.
[[nodiscard]] double distanceToBox(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& start, const Eigen::Vector3d& ray);

}  // namespace oikos::registration
