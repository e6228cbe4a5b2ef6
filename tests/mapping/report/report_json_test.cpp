// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mapping/report/json_text.h"
#include "mapping/report/report.h"
#include "tests/mapping/report/sample_report.h"

namespace oikos::mapping {
namespace {

using Json = nlohmann::ordered_json;

TEST(ReportJson, HoldsTheReportsNumbers) {
  const Json json = Json::parse(reportJson(test::sampleReport()));
  EXPECT_EQ(json["format"], "oikos-map-report");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["summary"]["verdict"], "usable");
  EXPECT_EQ(json["recording"]["frames_listed"], 42);
  EXPECT_EQ(json["recording"]["frames_duplicate"], 3);
  EXPECT_EQ(json["recording"]["camera"]["fx_px"], 525.5);
  EXPECT_EQ(json["recording"]["messages"][0]["reason"], "truncated at byte 1203");
  EXPECT_EQ(json["tracking"]["keyframes"], 10);
  EXPECT_EQ(json["loops"]["list"][1]["verdict"], "rejected-by-consistency");
  EXPECT_EQ(json["loops"]["list"][0]["residual_px"], 0.625);
  EXPECT_EQ(json["optimisation"]["final_cost"], 234.25);
  EXPECT_EQ(json["optimisation"]["refined"][0]["after"], 1.0125);
  EXPECT_EQ(json["floor"]["camera_height_m"], 1.25);
  EXPECT_EQ(json["map"]["voxels_free"], 1234567);
  EXPECT_EQ(json["map"]["box_max_m"], Json({2.0, 1.5, 2.5}));
}

TEST(ReportJson, OneRowAFrame) {
  const MapReport report = test::sampleReport();
  const Json frames = Json::parse(reportJson(report))["frames"];
  ASSERT_EQ(frames["rows"].size(), report.frames.size());
  ASSERT_EQ(frames["columns"].size(), frames["rows"][0].size());
  EXPECT_EQ(frames["rows"][4], Json({0.4, "tracked", 204, 0.5, true, {0.4, 0.0, 1.25}, {0.4 + 0.08 * 4 / 39, 0.0, 1.25}}));
}

TEST(ReportJson, ReadAndWrittenAgainIsTheSameText) {
  const std::string text = reportJson(test::sampleReport());
  EXPECT_EQ(jsonText(Json::parse(text)), text);
  EXPECT_EQ(reportJson(test::sampleReport()), text);
}

TEST(ReportJson, KeysKeepTheirOrder) {
  const Json json = Json::parse(reportJson(test::sampleReport()));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) {
    keys.push_back(key);
  }
  EXPECT_EQ(keys, (std::vector<std::string>{"format", "version", "summary", "warnings", "recording", "tracking", "loops", "optimisation",
                                            "floor", "drives", "map", "frames"}));
}

TEST(ReportJson, AFloorPlanIsThereIfThereWasOne) {
  EXPECT_FALSE(Json::parse(reportJson(test::sampleReport())).contains("floor_plan"));
  const Json plan = Json::parse(reportJson(test::reportOnPlan()))["floor_plan"];
  EXPECT_EQ(plan["map_in_plan"]["x_m"], 7.5);
  EXPECT_EQ(plan["map_in_plan"]["y_m"], -2.0);
  EXPECT_EQ(plan["map_in_plan"]["yaw_deg"], 0.0);
  EXPECT_NEAR(plan["start_in_map"]["yaw_deg"], 90.0, 1e-9);
  EXPECT_EQ(plan["plan_walls_m"], 76.5);
  EXPECT_EQ(plan["plan_walls_seen_share"], 0.75);
  EXPECT_EQ(plan["upright_surface_on_plan_share"], 0.625);
  EXPECT_EQ(plan["residual_rms_m"], 0.0125);
  EXPECT_EQ(plan["walls_over_floor_m"], 0.25);
  EXPECT_EQ(plan["walls_missing_m"], 0.5);
  EXPECT_EQ(plan["floor_outside_m2"], 0.125);
  EXPECT_EQ(plan["surface_beyond_share"], 0.03125);
}

TEST(ReportJson, AnExtendedMapSaysWhatItIsMadeOfAndWhatHasChanged) {
  const Json json = Json::parse(reportJson(test::extendedReport()));
  EXPECT_EQ(json["drives"][1], (Json{{"first_frame", 3}, {"frames", 40}, {"added_to_stamps_s", 12}}));
  EXPECT_EQ(json["extension"],
            (Json{{"earlier_frames", 3}, {"earlier_keyframes", 2}, {"keyframes_of_changes", 1}, {"largest_move_m", 0.0125}}));
  EXPECT_EQ(json["loops"]["to_earlier_drives"], 1);
  EXPECT_EQ(json["loops"]["list"][2]["to_earlier_frame"], 2);
  EXPECT_FALSE(json["loops"]["list"][2].contains("to_frame"));
  ASSERT_EQ(json["changes"].size(), 1U);
  EXPECT_EQ(json["changes"][0]["kind"], "gone");
  EXPECT_EQ(json["changes"][0]["center_map_m"], Json({0.5, 0.25, 0.375}));
  EXPECT_TRUE(json["changes"][0]["support_height_m"].is_null());
  EXPECT_EQ(json["changes"][0]["confidence"], 0.875);
  EXPECT_EQ(json["changes"][0]["piece"], "chair-1");
  ASSERT_EQ(json["moved_furniture"].size(), 1U);
  EXPECT_EQ(json["moved_furniture"][0]["id"], "table");
  EXPECT_EQ(json["moved_furniture"][0]["after_map"]["x_m"], 0.25);
  EXPECT_NEAR(json["moved_furniture"][0]["after_map"]["yaw_deg"].get<double>(), 90.0, 1e-9);
  EXPECT_EQ(json["moved_furniture"][0]["views"], 3);
  MapReport unnamed = test::extendedReport();
  unnamed.extension->explanation = {};
  EXPECT_TRUE(Json::parse(reportJson(unnamed))["changes"][0]["piece"].is_null());
  EXPECT_FALSE(Json::parse(reportJson(test::sampleReport())).contains("changes"));
}

TEST(ReportJson, WhatIsUnknownIsNull) {
  MapReport report = test::sampleReport();
  report.floor.status = FloorSighting::kNotInSight;
  report.frames[0].residual_px = std::numeric_limits<double>::quiet_NaN();
  report.trajectory_before_loops.clear();
  const Json json = Json::parse(reportJson(report));
  EXPECT_TRUE(json["floor"]["camera_height_m"].is_null());
  EXPECT_TRUE(json["frames"]["rows"][0][3].is_null());
  EXPECT_TRUE(json["frames"]["rows"][0][6].is_null());
}

TEST(ReportJson, AnEmptyReportAndHostileTextsAreValidJson) {
  EXPECT_EQ(Json::parse(reportJson({}))["summary"]["verdict"], "not-usable");
  MapReport report = test::sampleReport();
  report.warnings = {"\"}\n\xFF</script>"};
  EXPECT_EQ(Json::parse(reportJson(report))["warnings"][0], "\"}\n\xEF\xBF\xBD</script>");
}

}  // namespace
}  // namespace oikos::mapping
