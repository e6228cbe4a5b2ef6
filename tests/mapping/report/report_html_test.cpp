// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <regex>
#include <string>
#include <vector>

#include "mapping/report/report.h"
#include "tests/mapping/report/sample_report.h"
#include "tests/mapping/report/well_formed.h"

namespace oikos::mapping {
namespace {

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + part.size())) {
    ++found;
  }
  return found;
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A row of a table of facts.
std::string fact(const std::string& name, const std::string& value) {
  return "<tr><th>" + name + "</th><td class=\"number\">" + value + "</td></tr>";
}

TEST(ReportHtml, TheCheckerFindsWhatIsNotWellFormed) {
  EXPECT_EQ(test::xmlProblem("<!DOCTYPE html>\n<p class=\"a\">x<br/>&amp;</p>"), "");
  for (const char* const wrong : {"<p>", "</p>", "<p><b></p></b>", "<p a=b></p>", "<p>&nbsp;</p>", "<p>a & b</p>", "<p>1 < 2</p>", "<p"}) {
    EXPECT_NE(test::xmlProblem(wrong), "") << wrong;
  }
}

TEST(ReportHtml, IsOneWellFormedPageThatNeedsNothingElse) {
  const std::string html = reportHtml(test::sampleReport());
  EXPECT_EQ(test::xmlProblem(html), "");
  EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
  EXPECT_FALSE(holds(html, "<script"));
  EXPECT_FALSE(holds(html, "http://"));
  EXPECT_FALSE(holds(html, "https://"));
  EXPECT_FALSE(holds(html, "nan"));
  EXPECT_TRUE(holds(html, "href=\"data:image/png;base64,iVBORw0KGgo"));
}

TEST(ReportHtml, ShowsTheReportsNumbers) {
  const std::string html = reportHtml(test::sampleReport());
  EXPECT_TRUE(holds(html, "The map is usable."));
  for (const std::string& row :
       {fact("format", "tum"), fact("frames listed", "42"), fact("frames read", "40"), fact("unreadable, skipped", "1"),
        fact("repeated stamps", "3"), fact("focal length", "525.5 / 526.5 px"), fact("keyframes", "10"), fact("cost before", "1234.5"),
        fact("iterations", "17"), fact("voxels free", "1\u202F234\u202F567"), fact("cloud points", "98\u202F765"),
        fact("extent x × y × z", "3.00 × 2.00 × 2.50 m"), fact("camera over floor", "1.25 m")}) {
    EXPECT_TRUE(holds(html, row)) << row;
  }
  EXPECT_TRUE(holds(html, "<th>depth_scale</th><td class=\"number\">1.000000</td><td class=\"number\">1.012500</td>"));
  EXPECT_TRUE(holds(html, "<td class=\"text\">rgb/0012.png</td><td class=\"text\">truncated at byte 1203</td>"));
  EXPECT_TRUE(holds(html, "refused: contradicts other loops"));
}

TEST(ReportHtml, ShowsAndDrawsTheFloorPlan) {
  EXPECT_FALSE(holds(reportHtml(test::sampleReport()), "Floor plan"));
  const std::string html = reportHtml(test::reportOnPlan());
  EXPECT_EQ(test::xmlProblem(html), "");
  for (const std::string& row :
       {fact("origin of the map in the plan, x / y", "7.500 / -2.000 m"), fact("heading at the start", "90.0°"),
        fact("of these seen", "75 %"), fact("residual, root mean square", "12.5 mm"), fact("walls missing", "0.5 m")}) {
    EXPECT_TRUE(holds(html, row)) << row;
  }
  EXPECT_EQ(count(html, "<path class=\"plan\""), 1);
}

TEST(ReportHtml, ShowsAndDrawsWhatWasExtendedAndWhatHasChanged) {
  const std::string html = reportHtml(test::extendedReport());
  for (const char* part : {"What was extended", "12.5 mm", "What has changed", "gone", "0.50, 0.25, 0.38", "class=\"earlier\"",
                           "class=\"change-gone\"", "earlier drives", "chair-1", "table stands 25 cm from where the home has it"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  MapReport unchanged = test::extendedReport();
  unchanged.extension->changes.clear();
  EXPECT_NE(reportHtml(unchanged).find("Nothing that is large enough"), std::string::npos);
  EXPECT_EQ(reportHtml(test::sampleReport()).find("What has changed"), std::string::npos);
}

TEST(ReportHtml, DrawsBothPathsAndEveryLoop) {
  MapReport report = test::sampleReport();
  const std::string html = reportHtml(report);
  EXPECT_EQ(count(html, "<path class=\"after\""), 1);
  EXPECT_EQ(count(html, "<path class=\"before\""), 1);
  EXPECT_EQ(count(html, "<path class=\"loop\""), 1);
  EXPECT_EQ(count(html, "<path class=\"refused\""), 1);
  report.trajectory_before_loops.clear();
  EXPECT_EQ(count(reportHtml(report), "<path class=\"before\""), 0);
}

// The grid spans x from -1 to 2 m, y from -0.5 to 1.5 m, and 30 cm are left free around it: 2.6 m are the 720 units of
// height. Its middle, x = 0.5 m, is the drawing's, at 500.
TEST(ReportHtml, ThePathLiesWhereTheGridHasIt) {
  const std::string html = reportHtml(test::sampleReport());
  const double scale = 720.0 / 2.6;
  std::smatch image;
  ASSERT_TRUE(
      std::regex_search(html, image, std::regex("<image x=\"([0-9.]+)\" y=\"([0-9.]+)\" width=\"([0-9.]+)\" height=\"([0-9.]+)\"")));
  EXPECT_NEAR(std::stod(image[1]), 500.0 - 1.5 * scale, 0.06);
  EXPECT_NEAR(std::stod(image[2]), 0.3 * scale, 0.06);
  EXPECT_NEAR(std::stod(image[3]), 3.0 * scale, 0.06);
  EXPECT_NEAR(std::stod(image[4]), 2.0 * scale, 0.06);
  std::smatch start;
  ASSERT_TRUE(std::regex_search(html, start, std::regex("<circle class=\"start\" cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"")));
  EXPECT_NEAR(std::stod(start[1]), 500.0 - 0.5 * scale, 0.06);
  EXPECT_NEAR(std::stod(start[2]), 1.8 * scale, 0.06);
}

TEST(ReportHtml, HostileTextsStayText) {
  MapReport report = test::sampleReport();
  const std::string attack = "<script>alert(1)</script>\"' onload=\"x\" & \xFF]]>";
  report.recording.format = attack;
  report.recording.messages = {{attack, attack}};
  report.warnings = {attack};
  report.optimisation.refined = {{attack, 0.0, 1.0}};
  const std::string html = reportHtml(report);
  EXPECT_EQ(test::xmlProblem(html), "");
  EXPECT_FALSE(holds(html, "<script"));
  EXPECT_FALSE(holds(html, "onload=\""));
  EXPECT_EQ(count(html, "&lt;script&gt;alert(1)&lt;/script&gt;"), 5);
}

TEST(ReportHtml, LostFramesLeaveAGapAndAMark) {
  MapReport report = test::sampleReport();
  for (std::size_t i = 10; i < 20; ++i) {
    report.frames[i] = {.status = FrameStatus::kLost, .residual_px = std::numeric_limits<double>::quiet_NaN()};
  }
  const std::string html = reportHtml(report);
  EXPECT_EQ(count(html, "<rect class=\"lost\""), 2);  // one in each plot
  std::smatch line;
  ASSERT_TRUE(std::regex_search(html, line, std::regex("<path class=\"line residual\" d=\"([^\"]*)\"")));
  EXPECT_EQ(count(line[1], "M"), 2);
}

TEST(ReportHtml, EveryDegenerateReportIsStillAPage) {
  EXPECT_EQ(test::xmlProblem(reportHtml({})), "");
  MapReport one = test::sampleReport();
  one.frames.resize(1);
  one.trajectory.resize(1);
  one.trajectory_before_loops.clear();
  one.loops.clear();
  one.grid = {};
  one.recording.messages.clear();
  const std::string html = reportHtml(one);
  EXPECT_EQ(test::xmlProblem(html), "");
  EXPECT_TRUE(holds(html, "Nothing: every frame of the recording was used."));
  MapReport unknown = test::sampleReport();
  unknown.grid.cells.setTo(cv::Scalar(205));
  EXPECT_EQ(count(reportHtml(unknown), "<image"), 0);
}

TEST(ReportHtml, ALongDriveMakesNoLongPage) {
  MapReport report = test::sampleReport();
  for (int i = 40; i < 30000; ++i) {
    recording::StampedPose pose = report.trajectory[static_cast<std::size_t>(i % 40)];
    pose.stamp_ns = 5'000'000'000 + i * 33'000'000LL;
    report.trajectory.push_back(pose);
    report.trajectory_before_loops.push_back(pose);
    report.frames.push_back({.status = FrameStatus::kTracked, .inliers = 100 + i % 50, .residual_px = 0.4});
    report.recording.messages.push_back({"rgb/" + std::to_string(i), "missing"});
  }
  const std::string html = reportHtml(report);
  EXPECT_TRUE(holds(html, "The first 200 of 29\u202F961; report.json has them all."));
  EXPECT_EQ(reportHtml(report), html);
  const std::size_t per_frame_bytes = 40;  // two paths of points that are truly apart
  EXPECT_LT(html.size(), 100'000 + 30'000 * per_frame_bytes);
}

}  // namespace
}  // namespace oikos::mapping
