// SPDX-License-Identifier: Apache-2.0
// Simulated pictures of panels, what is believed of them, and what is read from them.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "bench/knobs/test_knobs.h"
#include "recognition/knobs/knob_reader.h"
#include "recognition/knobs/training/angle_models.h"

namespace oikos::bench {

constexpr int kStates = 9;

/// What the templates of a knob are made of.
enum class TemplateSource {
  kRender,      ///< as it is believed to be
  kPhoto,       ///< one photograph as an installer takes it, in which he marks the knob's middle
  kRegistered,  ///< the same, its middle where the registration of its part says
};

struct TrialSetup {
  recognition::PanelLook look;
  recognition::DetectorModel detector;
  std::vector<NamedKnob> knobs = testKnobs();              ///< whose pictures are read
  int variants = 6;                                        ///< of each of them
  bool has_confirmation = true;                            ///< of detections by the knob's own render
  const recognition::AngleModels* angle_models = nullptr;  ///< null: the learnt angles are left out
  TemplateSource templates = TemplateSource::kRender;
  std::uint64_t seed = 1;
  int threads = 2;
};

/// Something that was taken for a knob.
struct Alarm {
  bool is_knob = false;
  double detector_score = 0.0;
  double score = 0.0;  ///< of detector and render together
};

struct DetectionTrial {
  int knobs = 0;                 ///< that are wholly in the picture
  int regions = 0;               ///< that were searched
  double ms = 0.0;               ///< of processor time, for all regions, confirmation included
  double alone_ms = 0.0;         ///< of the detector alone
  std::vector<Alarm> alone;      ///< by the detector alone, apart from each other
  std::vector<Alarm> confirmed;  ///< confirmed by the knob's own render; empty without confirmation
};

/// Pictures with none, one, or two to five knobs, as many of each.
[[nodiscard]] std::vector<DetectionTrial> runDetection(int images, const TrialSetup& setup);

struct ReadingTrial {
  std::size_t family = 0;  ///< index into TrialSetup::knobs
  double tilt_deg = 0.0;
  double diameter_px = 0.0;
  recognition::KnobReading reading;
  double error_deg = 0.0;
  bool is_right = false;  ///< its likeliest state is the true one
  double ms = 0.0;        ///< of processor time, templates rendered before
  std::map<recognition::AngleMethod, double> learnt_error_deg;
  std::map<recognition::AngleMethod, bool> learnt_is_right;
};

/// Pictures of one knob, `count` in all, evenly of the variants of each family.
[[nodiscard]] std::vector<ReadingTrial> runReading(int count, const TrialSetup& setup);

/// Of this thread.
[[nodiscard]] double processorTime_ms();

}  // namespace oikos::bench
