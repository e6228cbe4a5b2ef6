// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/timing.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace oikos::mapping {
namespace {

using Json = nlohmann::ordered_json;

TEST(Timing, HoldsTheReportsNumbers) {
  const TimingReport timing{.stages = {{"odometry", 6.25}, {"volume", 2.5}},
                            .total_s = 12.5,
                            .frames = 600,
                            .threads = 2,
                            .peak_memory_bytes = 123456789,
                            .host = "robot-7",
                            .processor = "Some CPU",
                            .processors = 4};
  const Json json = Json::parse(timingJson(timing));
  EXPECT_EQ(json["format"], "oikos-map-timing");
  EXPECT_EQ(json["frames_per_s"], 48.0);
  EXPECT_EQ(json["stages"][1]["name"], "volume");
  EXPECT_EQ(json["stages"][1]["wall_s"], 2.5);
  EXPECT_EQ(json["peak_memory_bytes"], 123456789);
  EXPECT_EQ(json["threads"], 2);
  EXPECT_EQ(json["host"], "robot-7");
}

TEST(Timing, NoTimeIsNoRate) {
  EXPECT_TRUE(Json::parse(timingJson({}))["frames_per_s"].is_null());
}

TEST(Timing, MeasuresThisProcess) {
  TimingReport timing;
  measureHost(timing);
  EXPECT_GT(timing.peak_memory_bytes, 1 << 20);
  EXPECT_GE(timing.processors, 1);
  EXPECT_FALSE(timing.host.empty());
}

}  // namespace
}  // namespace oikos::mapping
