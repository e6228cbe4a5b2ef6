// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "registration/align.h"

namespace oikos::registration {

struct SearchConfig {
  AlignConfig align;
  double range_m = 0.30;         ///< how far the pose may be from where it is thought to be, in each direction
  double range_deg = 15.0;       ///< and how far turned
  double good_fit = 0.85;        ///< an alignment from the middle that explains so much of the model needs no second start,
  double near_m = 0.15;          ///< if it did not go farther than this
  double near_deg = 8.0;         ///< nor turn more: farther off there might be a twin as near
  int screening_iterations = 7;  ///< from each start, on very few points
  int best_starts = 4;           ///< so many of them are gone on with
  double same_m = 0.03;          ///< two results nearer than this, and than `same_deg`, are one
  double same_deg = 3.0;
  double min_overlap = 0.78;  ///< where the scan shows what lies behind more of the model, something else stands there: a person before it
  double clear_lead = 0.03;   ///< a fit that is better by less is no better: ambiguous

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("align", align);
    visitor("range_m", range_m);
    visitor("range_deg", range_deg);
    visitor("good_fit", good_fit);
    visitor("near_m", near_m);
    visitor("near_deg", near_deg);
    visitor("screening_iterations", screening_iterations);
    visitor("best_starts", best_starts);
    visitor("same_m", same_m);
    visitor("same_deg", same_deg);
    visitor("min_overlap", min_overlap);
    visitor("clear_lead", clear_lead);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// align() from where `motion` stands, and unless that explains the scan nearby, from the best of many starts about it: turned, moved
/// across the line of sight and along it. For planar motion. `motion` is left at the best.
AlignResult searchPose(Motion& motion, const Scan& scan, const SearchConfig& config);

}  // namespace oikos::registration
