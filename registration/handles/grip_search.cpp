// SPDX-License-Identifier: Apache-2.0
// After 5.2.1.1 of paper 003 (S238, S239): what stands out within the front's hull is the handle. Differs in that no single reading has to
// stand out by a centimetre: at two metres a bar is three pixels wide, a first Kinect takes the mean over nine, and its noise is as high as
// what is left of the bar. All readings around the handle are compared with the whole of it.
#include "registration/handles/grip_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "registration/handles/grip_grid.h"

namespace oikos::registration {

namespace {

/// From a sharp and from a blurred start: a thin bar that stands out far, blurred, looks much like a thicker one that is not.
GripPlace refined(const GripBelief& belief, const GridPlace& start, const GripReadings& readings, const GripConfig& config) {
  GripPlace best;
  for (const double blur_px : {config.sharp_blur_px, config.wide_blur_px}) {
    Bar bar = believedBar(belief);
    bar.along_m = start.along_m;
    bar.across_m = start.across_m;
    bar.blur_m = blur_px * readings.pixel_m;
    const GripPlace place = fitBar(belief, bar, readings, config);
    if (best.gain <= 0.0 || place.score > best.score) {
      best = place;
    }
  }
  return best;
}

/// Heights in a rectangle beside a bar.
struct Flank {
  double sum_m = 0.0;
  int readings = 0;
  [[nodiscard]] double mean_m() const { return readings > 0 ? sum_m / readings : 0.0; }
};

/// A grip has the front on both of its sides, and where it ends; the edge of a worktop has not, and goes on.
bool standsFree(const Bar& bar, const GripReadings& grip) {
  constexpr double kBeside_m = 0.02;
  constexpr double kNoFront = 0.5;  // of its height
  constexpr double kSure = 2.0;     // deviations
  std::array<Flank, 2> sides;
  std::array<Flank, 2> ends;
  const double c = std::cos(bar.roll_rad);
  const double s = std::sin(bar.roll_rad);
  for (const GripReading& reading : grip.readings) {
    const double dz = reading.along_m - bar.along_m;
    const double dy = reading.across_m - bar.across_m;
    const double z = std::abs(c * dz - s * dy) - bar.half_length_m;
    const double y = std::abs(s * dz + c * dy) - bar.half_width_m;
    const auto isBeside = [&](double way_m) { return way_m > bar.blur_m && way_m < bar.blur_m + kBeside_m; };
    if (z < 0.0 && isBeside(y)) {
      Flank& side = sides[s * dz + c * dy > 0.0 ? 1 : 0];
      side.sum_m += reading.height_m - bar.offset_m;
      ++side.readings;
    } else if (y < 0.0 && isBeside(z)) {
      Flank& end = ends[c * dz - s * dy > 0.0 ? 1 : 0];
      end.sum_m += reading.height_m - bar.offset_m;
      ++end.readings;
    }
  }
  const auto isFront = [&](const Flank& flank) {  // or may be
    const double noise_m = kSure * grip.sigma_m / std::sqrt(std::max(1.0, grip.share * flank.readings));
    return flank.mean_m() - noise_m < kNoFront * bar.height_m;
  };
  return std::all_of(sides.begin(), sides.end(), [&](const Flank& side) { return side.readings > 0 && isFront(side); }) &&
         std::all_of(ends.begin(), ends.end(), isFront);
}

}  // namespace

std::vector<GripPlace> searchGrip(const GripBelief& belief, const GripReadings& readings, const GripConfig& config) {
  std::vector<GripPlace> places;
  for (const GridPlace& start : bestOfGrid(readings, believedBar(belief), config)) {
    const GripPlace place = refined(belief, start, readings, config);
    if (place.gain >= config.min_gain && place.bar.height_m >= config.min_reach_m && standsFree(place.bar, readings)) {
      places.push_back(place);
    }
  }
  std::stable_sort(places.begin(), places.end(), [](const GripPlace& a, const GripPlace& b) { return a.score > b.score; });
  return places;
}

std::vector<PlaceEvidence> evidenceOf(const GripBelief& belief, const GripReadings& readings, const GripConfig& config) {
  return evidenceOverGrid(readings, believedBar(belief), config);
}

}  // namespace oikos::registration
