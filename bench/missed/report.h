// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>

#include "bench/missed/trial.h"

namespace oikos::bench {

/// Counts what was missed rightly and wrongly.
class MissedReport {
 public:
  /// `flat`: objects that a depth image cannot always tell. `is_verbose`: prints each that was told wrongly or not.
  MissedReport(std::set<std::string> flat, bool is_verbose) : flat_(std::move(flat)), is_verbose_(is_verbose) {}

  void add(const SceneTrials& trials);
  /// To the standard output.
  void print(int views) const;

 private:
  struct Score {
    int in_view = 0;        ///< gone, in view in two images from places apart,
    int missed_of_all = 0;  ///< and missed
    int gone = 0;           ///< of these, in plain view: its place measured in these images, and it is not flat,
    int missed = 0;         ///< and missed
    int there = 0;          ///< objects that were looked at,
    int false_miss = 0;     ///< and missed wrongly
    int found_there = 0;    ///< something was said to be there

    void add(const Score& more);
  };
  void addGone(const ObjectTrial& trial);
  void addThere(const ObjectTrial& trial);
  void describe(const ObjectTrial& trial, const char* what) const;

  std::set<std::string> flat_;
  bool is_verbose_;
  std::map<std::string, Score> scores_;  ///< by object
  int drives_ = 0;
  double looking_s_ = 0.0;
};

}  // namespace oikos::bench
