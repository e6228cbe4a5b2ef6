// SPDX-License-Identifier: Apache-2.0
// When joints were moved during a drive, and when they are said to have been.
#pragma once

#include <string>
#include <vector>

namespace oikos::bench {

/// Numbers of frames.
struct MovedInDrive {
  std::string id;           ///< the joint's
  int moment = 0;           ///< the first that is taken after the change,
  int first_shown = 0;      ///< and the first of these that shows enough of the part
  bool is_in_view = false;  ///< that one, and the last one before the change does as well
  int told = 0;             ///< as the event has it: the first that shows it gone from where it was,
  int last_before = -1;     ///< and the last before it that shows it there; -1: none

  /// Frames from the moment if it was in view, else from the time in which it can have been seen first.
  [[nodiscard]] int off() const;
  [[nodiscard]] bool isWithin() const { return last_before < moment && moment <= told; }
};

[[nodiscard]] std::string textOf(const MovedInDrive& moved);
void report(const std::vector<MovedInDrive>& moments, double rate_hz);

}  // namespace oikos::bench
