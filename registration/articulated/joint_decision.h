// SPDX-License-Identifier: Apache-2.0
// What can be said of a joint after all of its values were looked at.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"

namespace oikos::registration {

enum class JointStatus {
  kNotInView,      ///< no value would bring the part into the image and before readings
  kHidden,         ///< something stands before where it is: another part, furniture, a person
  kNotObservable,  ///< in view, but too many values explain the image: seen edge-on, or hardly at all
  kAmbiguous,      ///< a few values explain the image equally well
  kFound,
};
constexpr auto enumTable(JointStatus) {
  return std::to_array<base::EnumName<JointStatus>>({{JointStatus::kNotInView, "not in view"},
                                                     {JointStatus::kHidden, "hidden"},
                                                     {JointStatus::kNotObservable, "not observable"},
                                                     {JointStatus::kAmbiguous, "ambiguous"},
                                                     {JointStatus::kFound, "found"}});
}

/// What one image says about a joint: rad or m. Several of them can be fused (joint_fusion.h).
struct JointEvidence {
  bool is_turn = false;
  std::vector<double> values;          ///< over the joint's range, evenly, its limits included
  std::vector<double> log_likelihood;  ///< of each, tempered; 0: as likely as no such part at all
  bool has_peak = false;               ///< `value` is what solving has led to; otherwise only the profile speaks
  double value = 0.0;
  double peak_log_likelihood = 0.0;  ///< of `value`, as `log_likelihood`
  double variance = 0.0;             ///< of `value`,
  double shared_variance = 0.0;      ///< and the share of it that is the same in every image: the joint's axis, the sensor's distortion
};

/// Pixels at the estimate.
struct JointSight {
  bool is_ever_seen = false;  ///< some value puts the part before a reading
  int read = 0;
  int agreeing = 0;
  int nearer = 0;
  int behind = 0;
};

struct JointDecisionConfig {
  double window_deg = 5.0;       ///< values nearer than this to the best one, or next to it, count as the same,
  double window_m = 0.02;        ///< and so do these
  double min_confidence = 0.99;  ///< of the posterior, within the window
  double max_sigma_deg = 3.0;    ///< of a value that was found
  double max_sigma_m = 0.018;
  int min_agreeing = 8;      ///< pixels of the scan that show the part
  double min_share = 0.6;    ///< of the readings of it or behind it, those of it
  double max_hidden = 0.85;  ///< of the readings of it, before it and behind it, those that may lie before it
  double max_spread = 0.4;   ///< of the range, that the values of an ambiguous joint may fill; beyond, nothing is known of it

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("window_deg", window_deg);
    visitor("window_m", window_m);
    visitor("min_confidence", min_confidence);
    visitor("max_sigma_deg", max_sigma_deg);
    visitor("max_sigma_m", max_sigma_m);
    visitor("min_agreeing", min_agreeing);
    visitor("min_share", min_share);
    visitor("max_hidden", max_hidden);
    visitor("max_spread", max_spread);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct JointDecision {
  JointStatus status = JointStatus::kNotInView;
  double confidence = 0.0;  ///< of the posterior, within the window about the value
};
[[nodiscard]] JointDecision decide(const JointEvidence& evidence, const JointSight& sight, const JointDecisionConfig& config);

/// Mean and variance of the profile's posterior, every value being as likely before.
struct ProfileMoments {
  double mean = 0.0;
  double variance = 0.0;
};
[[nodiscard]] ProfileMoments momentsOf(const JointEvidence& evidence);

}  // namespace oikos::registration
