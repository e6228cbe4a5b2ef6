// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/earlier_map.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/read_file.h"
#include "core/geometry/se3.h"
#include "tests/mapping/built_map.h"
#include "tests/support/expect_error.h"

namespace oikos::mapping {
namespace {

namespace fs = std::filesystem;

const Built& builtMap() {
  static const Built map(richRecording(shortDrive(40, -20.0, 80.0)));
  return map;
}

/// A copy whose files may be spoiled.
class Copy {
 public:
  Copy() { fs::copy(builtMap().folder.path(), folder_.path(), fs::copy_options::recursive); }
  [[nodiscard]] fs::path path() const { return folder_.path(); }
  void write(const char* name, const std::string& content) const { std::ofstream(path() / name, std::ios::binary) << content; }
  [[nodiscard]] std::string read(const char* name) const { return base::readFile(path() / name); }
  void expectRefused(base::ErrorCode code, const std::vector<std::string>& parts) const {
    test::expectError(code, parts, [this] { const EarlierMap map(path(), {}); });
  }

 private:
  test::TemporaryFolder folder_;
};

TEST(EarlierMap, IsWhatWasSaved) {
  const EarlierMap map(builtMap().folder.path(), {});
  EXPECT_EQ(map.frameCount(), 40);
  EXPECT_TRUE(map.baseTrajectory().empty());
  EXPECT_TRUE(map.isFloorFound());
  ASSERT_EQ(map.drives().size(), 1U);
  EXPECT_EQ(map.drives()[0].frames, 40);
  const FrontEndResult start = map.start();
  EXPECT_EQ(start.graph.settled, builtMap().result.keyframes);
  ASSERT_EQ(start.graph.nodes.size(), static_cast<std::size_t>(start.graph.settled));
  ASSERT_EQ(start.features.size(), start.graph.nodes.size());
  EXPECT_TRUE(start.frames.empty());
  EXPECT_GE(start.graph.edges.size(), start.graph.nodes.size() - 1);
  for (const Edge& edge : start.graph.edges) {
    EXPECT_LT(edge.from, edge.to);
    const Eigen::Isometry3d T = start.graph.nodes[static_cast<std::size_t>(edge.from)].T_world_camera.inverse() *
                                start.graph.nodes[static_cast<std::size_t>(edge.to)].T_world_camera;
    EXPECT_LT(geometry::logSe3(T.inverse() * edge.T_from_to).norm(), 1e-5);
  }
  for (int node = 0; node < start.graph.settled; ++node) {
    const Node& settled = start.graph.nodes[static_cast<std::size_t>(node)];
    EXPECT_EQ(map.findKeyframe(settled.frame), node);
    // The camera turns by 80 degrees in 40 frames at 30 Hz.
    EXPECT_NEAR(settled.velocity.tail<3>().norm(), 80.0 / 40.0 * 30.0 * std::numbers::pi / 180.0, 0.25) << node;
  }
  EXPECT_EQ(map.findKeyframe(1'000'000), std::nullopt);
}

TEST(EarlierMap, AMapFromBeforeThereWereDrivesIsOfOne) {
  const Copy copy;
  auto report = nlohmann::json::parse(copy.read("report.json"));
  report.erase("drives");
  copy.write("report.json", report.dump());
  const EarlierMap map(copy.path(), {});
  ASSERT_EQ(map.drives().size(), 1U);
  EXPECT_EQ(map.drives()[0].frames, 40);
}

TEST(EarlierMap, NoMapIsWrongUsage) {
  const test::TemporaryFolder empty;
  test::expectError(base::ErrorCode::kUsage, {"keyframes.sqlite", "without --extend"}, [&] { const EarlierMap map(empty.path(), {}); });
}

TEST(EarlierMap, ADamagedStoreIsNamed) {
  const Copy copy;
  copy.write("keyframes.sqlite",
             "this is no database, but it is long enough to be looked at as if it were one: it has more than 100 bytes");
  copy.expectRefused(base::ErrorCode::kInput, {"keyframes.sqlite"});
  const Copy cut;
  cut.write("keyframes.sqlite", cut.read("keyframes.sqlite").substr(0, 20000));
  cut.expectRefused(base::ErrorCode::kInput, {"keyframes.sqlite"});
}

TEST(EarlierMap, FilesOfDifferentMapsAreRefused) {
  const Copy fewer;
  fewer.write("trajectory.txt", "0 0 0 1 0 0 0 1\n");
  fewer.expectRefused(base::ErrorCode::kInput, {"trajectory.txt", "has 1 poses", "not of one map"});
  const Copy moved;
  const std::string graph = moved.read("graph.g2o");
  moved.write("graph.g2o", "VERTEX_SE3:QUAT 0 5 5 5 0 0 0 1\n" + graph.substr(graph.find('\n') + 1));
  moved.expectRefused(base::ErrorCode::kInput, {"graph.g2o", "vertex 0 is not where keyframe 0"});
  const Copy empty;
  empty.write("graph.g2o", "");
  empty.expectRefused(base::ErrorCode::kInput, {"graph.g2o"});
}

TEST(EarlierMap, AReportThatDoesNotFitIsRefused) {
  const Copy no_json;
  no_json.write("report.json", "{");
  no_json.expectRefused(base::ErrorCode::kInput, {"report.json", "no report of a map"});
  const Copy no_floor;
  no_floor.write("report.json", "{}");
  no_floor.expectRefused(base::ErrorCode::kInput, {"report.json", "floor"});
  const auto withDrives = [](const Copy& copy, const nlohmann::json& drives) {
    auto report = nlohmann::json::parse(copy.read("report.json"));
    report["drives"] = drives;
    copy.write("report.json", report.dump());
  };
  const Copy too_few;
  withDrives(too_few, {{{"first_frame", 0}, {"frames", 39}, {"added_to_stamps_s", 0}}});
  too_few.expectRefused(base::ErrorCode::kInput, {"report.json", "39 frames", "has 40"});
  const Copy gap;
  withDrives(gap, {{{"first_frame", 0}, {"frames", 20}, {"added_to_stamps_s", 0}},
                   {{"first_frame", 21}, {"frames", 19}, {"added_to_stamps_s", 1}}});
  gap.expectRefused(base::ErrorCode::kInput, {"report.json", "from 21 on, 20 expected"});
  const Copy no_number;
  withDrives(no_number, {{{"first_frame", "x"}, {"frames", 40}, {"added_to_stamps_s", 0}}});
  no_number.expectRefused(base::ErrorCode::kInput, {"report.json"});
}

TEST(EarlierMap, MissingFilesAreNamed) {
  for (const char* name : {"trajectory.txt", "graph.g2o", "report.json"}) {
    const Copy copy;
    fs::remove(copy.path() / name);
    copy.expectRefused(base::ErrorCode::kIo, {name});
  }
}

}  // namespace
}  // namespace oikos::mapping
