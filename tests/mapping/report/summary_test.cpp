// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>

#include "tests/mapping/report/sample_report.h"
#include "tests/support/enum_table_check.h"

namespace oikos::mapping {
namespace {

MapSummary summaryAfter(const std::function<void(MapReport&)>& change) {
  MapReport report = test::sampleReport();
  change(report);
  return summarise(report, figuresOf(report));
}

bool mentions(const MapSummary& summary, const std::string& words) {
  return std::any_of(summary.findings.begin(), summary.findings.end(),
                     [&](const Finding& finding) { return (finding.what + " " + finding.advice).find(words) != std::string::npos; });
}

void lose(MapReport& report, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    report.frames[i].status = FrameStatus::kLost;
  }
}

TEST(MapSummary, AGoodDriveIsUsableWithoutABut) {
  const MapSummary summary = summaryAfter([](MapReport&) {});
  EXPECT_EQ(summary.verdict, MapVerdict::kUsable);
  EXPECT_EQ(summary.headline, "The map is usable.");
  EXPECT_EQ(summary.story,
            "40 of 40 frames have a place along a path of 3.90 m. 1 loop was closed, which moved the path by up to 8.0 cm. The floor "
            "was found 1.25 m below the camera; 5.7 m² of it are known to be free.");
  EXPECT_TRUE(summary.findings.empty());
}

TEST(MapSummary, LossWeighsByItsShareAndIsNamedByTime) {
  const MapSummary some = summaryAfter([](MapReport& report) {
    lose(report, 10, 14);
    lose(report, 30, 31);
  });
  EXPECT_EQ(some.verdict, MapVerdict::kUsableWithCare);
  EXPECT_TRUE(mentions(some, "5 frames (12.5 %), at 1.0–1.3 s, 3.0–3.0 s of the drive"));
  EXPECT_TRUE(mentions(some, "again, slower"));
  EXPECT_EQ(summaryAfter([](MapReport& report) { lose(report, 0, 9); }).verdict, MapVerdict::kNotUsable);
  const MapSummary scattered = summaryAfter([](MapReport& report) {
    for (std::size_t i = 0; i < 8; i += 2) {
      lose(report, i, i + 1);
    }
  });
  EXPECT_TRUE(mentions(scattered, "at 0.0–0.0 s, 0.2–0.2 s, 0.4–0.4 s and elsewhere of the drive"));
}

TEST(MapSummary, WhatOdometryCarriedIsNotLostButNeedsCare) {
  const auto carry = [](std::size_t begin, std::size_t end) {
    return summaryAfter([=](MapReport& report) {
      for (std::size_t i = begin; i < end; ++i) {
        report.frames[i].status = FrameStatus::kCarried;
      }
    });
  };
  const MapSummary some = carry(10, 20);
  EXPECT_EQ(some.verdict, MapVerdict::kUsableWithCare);
  EXPECT_TRUE(mentions(some, "could not be followed in 10 frames (25.0 %), at 1.0–1.9 s of the drive; the wheels' odometry carried them"));
  EXPECT_FALSE(mentions(some, "lost"));
  EXPECT_EQ(carry(0, 40).verdict, MapVerdict::kUsableWithCare);
  EXPECT_TRUE(carry(0, 40).story.starts_with("40 of 40 frames have a place"));
}

TEST(MapSummary, NothingTrackedIsNotUsable) {
  EXPECT_EQ(summarise({}, figuresOf({})).verdict, MapVerdict::kNotUsable);
  const MapSummary summary = summaryAfter([](MapReport& report) { lose(report, 1, 40); });
  EXPECT_EQ(summary.verdict, MapVerdict::kNotUsable);
  EXPECT_TRUE(mentions(summary, "could not be followed"));
}

TEST(MapSummary, EachDefectHasItsFinding) {
  const MapSummary apart = summaryAfter([](MapReport& report) { report.submaps = 3; });
  EXPECT_EQ(apart.verdict, MapVerdict::kUsableWithCare);
  EXPECT_TRUE(mentions(apart, "2 pieces of the drive could not be joined to the map and are missing"));
  const MapSummary floorless = summaryAfter([](MapReport& report) { report.floor.status = FloorSighting::kNotInSight; });
  EXPECT_EQ(floorless.verdict, MapVerdict::kUsableWithCare);
  EXPECT_TRUE(mentions(floorless, "floor was never in sight"));
  EXPECT_EQ(floorless.story.find("floor was found"), std::string::npos);
  EXPECT_TRUE(mentions(summaryAfter([](MapReport& report) { report.recording.skipped = 4; }), "5 frames of 42 could not be used"));
  EXPECT_TRUE(mentions(summaryAfter([](MapReport& report) { report.optimisation.converged = false; }), "limit of iterations"));
  EXPECT_TRUE(mentions(summaryAfter([](MapReport& report) { report.loops[1].verdict = LoopVerdict::kDownWeighted; }),
                       "1 loop was found wrong and given no say"));
}

TEST(MapSummary, AHighResidualPointsAtTheCalibration) {
  const MapSummary summary = summaryAfter([](MapReport& report) {
    for (FrameFacts& frame : report.frames) {
      frame.residual_px = 2.5;
    }
  });
  EXPECT_EQ(summary.verdict, MapVerdict::kUsableWithCare);
  EXPECT_TRUE(mentions(summary, "2.5 px"));
  EXPECT_TRUE(mentions(summary, "calibration"));
}

TEST(MapSummary, ALongDriveWithoutALoopIsToldToEndWhereItBegan) {
  const MapSummary summary = summaryAfter([](MapReport& report) {
    report.loops.clear();
    for (std::size_t i = 0; i < report.trajectory.size(); ++i) {
      report.trajectory[i].T_map_camera.translation().x() = 0.2 * static_cast<double>(i);
    }
  });
  EXPECT_EQ(summary.verdict, MapVerdict::kUsable);
  EXPECT_TRUE(mentions(summary, "End the drive where it began"));
}

TEST(MapSummary, TheWorstFindingComesFirst) {
  const MapSummary summary = summaryAfter([](MapReport& report) {
    lose(report, 0, 20);
    report.floor.status = FloorSighting::kNotInSight;
    report.loops[1].verdict = LoopVerdict::kDownWeighted;
  });
  ASSERT_EQ(summary.findings.size(), 3U);
  EXPECT_EQ(summary.findings[0].weight, MapVerdict::kNotUsable);
  EXPECT_EQ(summary.findings[2].weight, MapVerdict::kUsable);
}

TEST(MapSummary, VerdictNames) {
  oikos::test::checkEnumTable(MapVerdict::kNotUsable);
}

}  // namespace
}  // namespace oikos::mapping
