// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace oikos::registration {

/// What is known of handles before the image is looked at, and of how a depth camera shows them.
struct GripConfig {
  double place_sigma_m = 0.012;   ///< of where the model has the handle on its front, in each direction,
  double height_sigma_m = 0.003;  ///< how far its grip is before the front,
  double roll_sigma_deg = 1.5;    ///< its direction in the front,
  double length_sigma_m = 0.01;   ///< and its length (a knob's diameter: half of this)
  /// Of what is seen of a handle's height, at 1 m, growing with the square of the distance: where front and handle are less than about a
  /// pixel of disparity apart, a reading is a mixture of both, and nobody knows of how much of each.
  double mixture_sigma_m = 0.006;
  double bar_radius_m = 0.006;
  double radius_sigma_m = 0.002;
  double bar_length_m = 0.16;     ///< where the model has none
  double knob_width_m = 0.03;     ///< where the model has none
  double search_m = 0.035;        ///< to each side of where it is believed
  double min_reach_m = 0.01;      ///< what stands out less is no handle (S238),
  double max_reach_m = 0.10;      ///< and neither is what stands out more
  double offset_sigma_m = 0.002;  ///< of the front around the handle, from its plane
  double sharp_blur_px = 1.5;     ///< half of what a sensor takes the mean over, where front and handle are two surfaces to it,
  double wide_blur_px = 4.5;      ///< and where they are one
  double correlation_px = 4.0;    ///< nearer readings repeat each other
  double floor_m = 0.001;         ///< deviation that no number of readings takes away
  double noise_floor_m = 0.0005;  ///< of a reading
  int most_readings = 6000;       ///< that are looked at
  int min_readings = 6;           ///< of a sharp or blurred grip
  double max_hidden = 0.6;        ///< of the grip's pixels, those that something stands before
  double min_gain = 8.0;          ///< log likelihood of the grip over that of a bare front
  double apart_m = 0.03;          ///< two handles are not nearer to each other
  int most_places = 3;            ///< that are thought of for a handle

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("place_sigma_m", place_sigma_m);
    visitor("height_sigma_m", height_sigma_m);
    visitor("roll_sigma_deg", roll_sigma_deg);
    visitor("length_sigma_m", length_sigma_m);
    visitor("mixture_sigma_m", mixture_sigma_m);
    visitor("bar_radius_m", bar_radius_m);
    visitor("radius_sigma_m", radius_sigma_m);
    visitor("bar_length_m", bar_length_m);
    visitor("knob_width_m", knob_width_m);
    visitor("search_m", search_m);
    visitor("min_reach_m", min_reach_m);
    visitor("max_reach_m", max_reach_m);
    visitor("offset_sigma_m", offset_sigma_m);
    visitor("sharp_blur_px", sharp_blur_px);
    visitor("wide_blur_px", wide_blur_px);
    visitor("correlation_px", correlation_px);
    visitor("floor_m", floor_m);
    visitor("noise_floor_m", noise_floor_m);
    visitor("most_readings", most_readings);
    visitor("min_readings", min_readings);
    visitor("max_hidden", max_hidden);
    visitor("min_gain", min_gain);
    visitor("apart_m", apart_m);
    visitor("most_places", most_places);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace oikos::registration
