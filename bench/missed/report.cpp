// SPDX-License-Identifier: Apache-2.0
#include "bench/missed/report.h"

#include <algorithm>
#include <cstdio>

#include "core/metrics/share_interval.h"

namespace oikos::bench {

namespace {

void printRate(const char* what, int hits, int count) {
  const metrics::ShareInterval interval = metrics::wilsonInterval(hits, count);
  std::printf("%s: %d of %d, %.1f %% (95 %%: %.1f-%.1f)\n", what, hits, count, 100.0 * hits / std::max(1, count), 100.0 * interval.low,
              100.0 * interval.high);
}

bool isStatus(const ObjectTrial& trial, tracking::WatchStatus status) {
  return trial.reading && trial.reading->status == status;
}

}  // namespace

void MissedReport::Score::add(const Score& more) {
  in_view += more.in_view;
  missed_of_all += more.missed_of_all;
  gone += more.gone;
  missed += more.missed;
  there += more.there;
  false_miss += more.false_miss;
  found_there += more.found_there;
}

void MissedReport::add(const SceneTrials& trials) {
  for (const ObjectTrial& trial : trials.objects) {
    if (trial.is_gone) {
      addGone(trial);
    } else if (trial.reading) {
      addThere(trial);
    }
  }
  drives_ += trials.drives;
  looking_s_ += trials.looking_s;
}

void MissedReport::addThere(const ObjectTrial& trial) {
  const bool is_missed = isStatus(trial, tracking::WatchStatus::kMissed);
  Score& score = scores_[trial.id];
  ++score.there;
  score.false_miss += is_missed ? 1 : 0;
  score.found_there += isStatus(trial, tracking::WatchStatus::kThere) ? 1 : 0;
  if (is_missed) {
    describe(trial, "wrongly missed");
  }
}

void MissedReport::addGone(const ObjectTrial& trial) {
  if (!trial.is_in_view) {
    return;
  }
  const bool is_missed = isStatus(trial, tracking::WatchStatus::kMissed);
  const bool is_plain = trial.is_measured && !flat_.contains(trial.id);
  Score& score = scores_[trial.id];
  ++score.in_view;
  score.missed_of_all += is_missed ? 1 : 0;
  score.gone += is_plain ? 1 : 0;
  score.missed += is_plain && is_missed ? 1 : 0;
  if (!is_missed) {
    describe(trial, is_plain ? "in plain view, not missed" : "in view, not missed");
  }
}

void MissedReport::describe(const ObjectTrial& trial, const char* what) const {
  if (!is_verbose_) {
    return;
  }
  const tracking::ObjectReading reading = trial.reading.value_or(tracking::ObjectReading());
  std::printf("  past %s: %s %s: %s, %d images, %d there, %d not there, %d hidden\n", trial.carrier.c_str(), trial.id.c_str(), what,
              std::string(base::toString(reading.status)).c_str(), reading.views, reading.there, reading.not_there, reading.hidden);
}

void MissedReport::print(int views) const {
  Score all;
  for (const auto& [id, score] : scores_) {
    std::printf("%-14s gone: missed %3d of %3d   there: wrongly missed %2d of %3d, said to be there %3d\n", id.c_str(), score.missed,
                score.gone, score.false_miss, score.there, score.found_there);
    all.add(score);
  }
  printRate("gone, in view in two images: missed", all.missed_of_all, all.in_view);
  printRate("gone, in plain view in two images: missed", all.missed, all.gone);
  printRate("still there: wrongly missed", all.false_miss, all.there);
  printRate("still there: something is said to be there", all.found_there, all.there);
  std::printf("%d drives of %d images, %.1f ms of processor time an image in looking\n", drives_, views,
              1000.0 * looking_s_ / std::max(1, drives_ * views));
}

}  // namespace oikos::bench
