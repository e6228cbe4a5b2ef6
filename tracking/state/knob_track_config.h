// SPDX-License-Identifier: Apache-2.0
// How knobs are read from a recording.
#pragma once

#include <string>
#include <vector>

#include "recognition/knobs/knob_reader.h"

namespace oikos::tracking {

/// When readings of a knob are one setting, and when that is an event.
struct KnobTestConfig {
  double error_share = 0.001;     ///< of pictures, those that are sure of a wrong state: one says no more against a state
  double tempering = 0.5;         ///< of a picture's log likelihood beside the first: they are not independent
  double turning_share = 0.01;    ///< prior probability that a knob is turned between two pictures
  double min_probability = 0.95;  ///< of a setting that is told
  int min_images = 2;             ///< that have read it by themselves

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("error_share", error_share);
    visitor("tempering", tempering);
    visitor("turning_share", turning_share);
    visitor("min_probability", min_probability);
    visitor("min_images", min_images);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct KnobTrackConfig {
  recognition::KnobReaderConfig reader;
  KnobTestConfig test;
  double hidden_m = 0.05;   ///< a reading this far before a knob is of something that hides it
  double enough_px = 40.0;  ///< a larger picture of a knob is no better
  int most_frames = 5;      ///< of one stay before an appliance

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("reader", reader);
    visitor("test", test);
    visitor("hidden_m", hidden_m);
    visitor("enough_px", enough_px);
    visitor("most_frames", most_frames);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

}  // namespace oikos::tracking
