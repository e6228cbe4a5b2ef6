// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/scene_script.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/config_rules_check.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::simulate {
namespace {

void expectRefused(const std::string& toml, const std::vector<std::string>& parts) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.write("scene.toml", toml);
  test::expectError(base::ErrorCode::kInput, parts, [&] { (void)readSceneScript(file); });
}

TEST(SceneScript, DefaultsAreValid) {
  EXPECT_TRUE(base::validateConfig(SceneScript()).empty());
  const test::TemporaryFolder folder;
  EXPECT_EQ(base::writeConfig(readSceneScript(folder.write("empty.toml", ""))), base::writeConfig(SceneScript()));
}

TEST(SceneScript, NamesTheNearestKey) {
  expectRefused("rate_hz = 10\n[camera]\nwidht = 640\n", {"scene.toml:3", "camera.widht", "camera.width"});
  expectRefused("walker = []\n", {"scene.toml:1", "walker", "walkers"});
}

TEST(SceneScript, SaysWhatIsWrongWithAText) {
  expectRefused("[path]\nwaypoints = [\"1 2\", \"1 2 look\"]\n",
                {"scene.toml:2", "path.waypoints = '1 2 look': must be 'X Y', with 'look DEGREES' or 'yaw DEGREES' behind it or not"});
  expectRefused("[light]\nlamps = [\"1 2 3\"]\n", {"scene.toml:2", "light.lamps = '1 2 3': must be 'X Y Z BRIGHTNESS'"});
  expectRefused("changes = [\"cup\"]\n",
                {"scene.toml:1",
                 "changes = 'cup': must be '[@SECONDS] ID VALUE deg|m', 'ID STATE', 'ID gone', 'ID at POSE' or 'ID "
                 "on|in|under PARENT at POSE'"});
  expectRefused("start = \"yesterday\"\n",
                {"scene.toml:1", "start = 'yesterday': must be a time with its offset, for instance 2026-03-02T08:00:00Z"});
  for (const char* walker : {"1 2 0 0 1", "2 2 0 0 1 1", "3 2 0 0 1 1", "1 2 0 0 1 1 1", "1 x 0 0 1 1", "1 nan 0 0 1 1"}) {
    expectRefused("walkers = [\"" + std::string(walker) + "\"]\n",
                  {"scene.toml:1", "walkers = '" + std::string(walker) + "': must be 'FROM_S TO_S X Y X Y'"});
  }
  expectRefused("[path]\nstart = [1, 2]\n", {"scene.toml:2", "path.start = 2: must be three numbers: x, y (m), yaw (degrees)"});
  expectRefused("sensor = \"kinect3\"\n", {"scene.toml:1", "kinect3", "kinect1"});
}

TEST(SceneScript, RulesOfTheCamera) {
  test::checkConfigRules<CameraSettings>({
      {"width", "4097", "must be from 16 to 4096"},
      {"height", "5000", "must be from 16 to 4096"},
      {"fx", "0", "must be > 0"},
      {"fy", "-1", "must be > 0"},
      {"cx", "-1", "must be from 0 to 640"},
      {"cy", "481", "must be from 0 to 480"},
      {"forward_m", "3", "must be from -2 to 2"},
      {"height_m", "0", "must be from 0.05 to 3"},
      {"tilt_deg", "90", "must be from -89 to 89"},
      {"depth_delay_s", "0.016", "must be from 0 to 0.015"},
      {"readout_s", "-0.01", "must be from 0 to 0.1"},
      {"lost_share", "1", "must be from 0 to 0.9"},
      {"jpeg_quality", "101", "must be from 0 to 100"},
  });
}

TEST(SceneScript, RulesOfPathLightBeliefAndOdometry) {
  test::checkConfigRules<PathSettings>({{"speed_mps", "0", "must be > 0"},
                                        {"acceleration_mps2", "-1", "must be > 0"},
                                        {"turn_rate_dps", "nan", "must be > 0"},
                                        {"turn_acceleration_dps2", "0", "must be > 0"},
                                        {"stand_s", "-1", "must be from 0 to 3600"}});
  test::checkConfigRules<LightSettings>({{"glow", "1.5", "must be from 0 to 1"}});
  test::checkConfigRules<OdometrySettings>({{"drift_share", "2", "must be from 0 to 1"},
                                            {"turn_drift_share", "-1", "must be from 0 to 1"},
                                            {"prior_m", "2", "must be from 0 to 1"},
                                            {"prior_deg", "nan", "must be from 0 to 45"}});
  test::checkConfigRules<BeliefSettings>({{"dimension_m", "0.1", "must be from 0 to 0.05"},
                                          {"placement_m", "-1", "must be from 0 to 0.1"},
                                          {"placement_deg", "11", "must be from 0 to 10"},
                                          {"axis_m", "0.06", "must be from 0 to 0.05"},
                                          {"axis_deg", "11", "must be from 0 to 10"},
                                          {"wall_deg", "6", "must be from 0 to 5"},
                                          {"extra_part_share", "2", "must be from 0 to 1"},
                                          {"clutter", "-1", "must be from 0 to 1000"},
                                          {"mount_m", "0.06", "must be from 0 to 0.05"},
                                          {"mount_deg", "6", "must be from 0 to 5"},
                                          {"intrinsics_share", "0.1", "must be from 0 to 0.05"},
                                          {"depth_scale_share", "0.2", "must be from -0.1 to 0.1"}});
}

TEST(SceneScript, RulesOfTheScript) {
  test::checkConfigRules<SceneScript>({{"rate_hz", "0", "must be from 0.1 to 120"}, {"duration_s", "-1", "must be from 0 to 86400"}});
}

TEST(SceneScript, WrittenItReadsBackEqual) {
  SceneScript script;
  script.start = "2026-03-02T08:00:00+01:00";
  script.rate_hz = 1.0 / 3.0;
  script.sensor = camera::DepthSensorKind::kKinect2;
  script.changes = {"@1.5 cup on table at 0 0 0.7 0 0 0"};
  script.walkers = {"1 2 0 0 1 1"};
  script.camera.distortion = {0.1, -0.2, 0.001, 0.002, 0.05};
  script.path.waypoints = {"1 2 look 90 yaw 0"};
  script.light.lamps = {"0 0 2 1.5"};
  script.light.shadows = false;
  script.belief.dimension_m = 0.01;
  script.odometry.is_written = false;
  const std::string toml = base::writeConfig(script);
  const test::TemporaryFolder folder;
  EXPECT_EQ(base::writeConfig(readSceneScript(folder.write("scene.toml", toml))), toml);
}

TEST(ParseWaypoint, EveryForm) {
  const auto plain = parseWaypoint("1.5 -2");
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->position_map, Eigen::Vector2d(1.5, -2.0));
  EXPECT_FALSE(plain->yaw_rad);
  EXPECT_EQ(plain->look_around_rad, 0.0);
  const auto full = parseWaypoint(" 1  2 look -90 yaw 180 ");
  ASSERT_TRUE(full);
  EXPECT_DOUBLE_EQ(full->look_around_rad, -0.5 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(full->yaw_rad.value(), std::numbers::pi);
  for (const char* text : {"", "1", "1 2 3", "1 x", "nan 2", "1 2 look", "1 2 look x", "1 2 turn 90", "look 90", "1 2 yaw inf",
                           "1 2 look 10 look 20", "1 2 yaw 10 yaw 20"}) {
    EXPECT_FALSE(parseWaypoint(text)) << text;
  }
}

TEST(PathOf, IsInDegreesOfTheFile) {
  SceneScript script;
  script.path.start = {1.0, 2.0, 90.0};
  script.path.waypoints = {"1 3 yaw 0"};
  script.path.turn_rate_dps = 45.0;
  script.path.turn_acceleration_dps2 = 90.0;
  script.path.speed_mps = 0.5;
  script.path.acceleration_mps2 = 0.5;
  const RobotPath path = pathOf(script);
  EXPECT_DOUBLE_EQ(path.at(0.0).yaw_rad, 0.5 * std::numbers::pi);
  EXPECT_NEAR(path.duration_s(), (1.0 / 0.5 + 1.0) + (90.0 / 45.0 + 45.0 / 90.0), 1e-12);
}

}  // namespace
}  // namespace oikos::simulate
