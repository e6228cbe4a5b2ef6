// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "tests/mapping/report/sample_report.h"
#include "tests/support/enum_table_check.h"

namespace oikos::mapping {
namespace {

TEST(ReportFigures, OfTheSample) {
  const ReportFigures figures = figuresOf(test::sampleReport());
  EXPECT_EQ(figures.frames, 40);
  EXPECT_EQ(figures.tracked, 40);
  EXPECT_EQ(figures.keyframes, 10);
  EXPECT_EQ(figures.loops_accepted, 1);
  EXPECT_EQ(figures.loops_down_weighted, 0);
  EXPECT_EQ(figures.loops_rejected, 1);
  EXPECT_DOUBLE_EQ(figures.drive_s, 3.9);
  EXPECT_NEAR(figures.path_m, 3.9, 1e-12);
  EXPECT_NEAR(figures.largest_correction_m, 0.08, 1e-12);
  EXPECT_DOUBLE_EQ(figures.median_residual_px, 0.5);
  EXPECT_DOUBLE_EQ(figures.median_inliers, 219.5);
  EXPECT_NEAR(figures.free_area_m2, 5.7, 1e-9);
}

TEST(ReportFigures, FramesWithoutInliersHaveNoResidual) {
  MapReport report = test::sampleReport();
  for (FrameFacts& frame : report.frames) {
    frame = {.status = FrameStatus::kLost, .inliers = 0, .residual_px = std::numeric_limits<double>::quiet_NaN()};
  }
  const ReportFigures figures = figuresOf(report);
  EXPECT_EQ(figures.lost, 40);
  EXPECT_TRUE(std::isnan(figures.median_residual_px));
}

TEST(ReportFigures, CarriedFramesAreNotLostAndHaveNoInliers) {
  MapReport report = test::sampleReport();
  for (std::size_t i = 0; i < 39; ++i) {
    report.frames[i] = {.status = FrameStatus::kCarried, .inliers = 0, .residual_px = std::numeric_limits<double>::quiet_NaN()};
  }
  const ReportFigures figures = figuresOf(report);
  EXPECT_EQ(figures.carried, 39);
  EXPECT_EQ(figures.lost, 0);
  EXPECT_EQ(figures.median_inliers, report.frames[39].inliers);
}

TEST(ReportFigures, OfNothing) {
  const ReportFigures figures = figuresOf({});
  EXPECT_EQ(figures.frames, 0);
  EXPECT_EQ(figures.path_m, 0.0);
}

TEST(ReportFigures, PartsThatDoNotBelongTogetherBreakTheContract) {
  MapReport short_path = test::sampleReport();
  short_path.trajectory.pop_back();
  EXPECT_THROW(static_cast<void>(figuresOf(short_path)), base::ContractViolation);
  MapReport short_odometry = test::sampleReport();
  short_odometry.trajectory_before_loops.pop_back();
  EXPECT_THROW(static_cast<void>(figuresOf(short_odometry)), base::ContractViolation);
  MapReport wild_loop = test::sampleReport();
  wild_loop.loops[0].from_frame = 40;
  EXPECT_THROW(static_cast<void>(figuresOf(wild_loop)), base::ContractViolation);
}

TEST(ReportFigures, LoopsIntoEarlierDrivesNeedOne) {
  MapReport report = test::extendedReport();
  EXPECT_EQ(figuresOf(report).loops_to_earlier, 1);
  report.loops.back().to_frame = 3;
  EXPECT_THROW((void)figuresOf(report), base::ContractViolation);
  report.extension.reset();
  EXPECT_THROW((void)figuresOf(report), base::ContractViolation);
}

TEST(ReportFigures, NamesOfTheFacts) {
  oikos::test::checkEnumTable(FrameStatus::kLost);
  oikos::test::checkEnumTable(LoopVerdict::kRejectedByConsistency);
  oikos::test::checkEnumTable(FloorSighting::kNotInSight);
}

}  // namespace
}  // namespace oikos::mapping
