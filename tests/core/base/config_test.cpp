// SPDX-License-Identifier: Apache-2.0
#include "core/base/config.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "tests/support/enum_table_check.h"
#include "tests/support/temporary_folder.h"

namespace oikos::base {
namespace {

enum class Feature { kSift, kOrb };
constexpr auto enumTable(Feature /*unused*/) {
  return std::to_array<EnumName<Feature>>({{Feature::kSift, "sift"}, {Feature::kOrb, "orb"}});
}

struct SensorConfig {
  double max_range_m = 4.0;
  std::vector<double> weights = {1.0, 0.5};

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("max_range_m", max_range_m);
    visitor("weights", weights);
  }
  [[nodiscard]] std::vector<std::string> validate() const { return ConfigRules().greater("max_range_m", max_range_m, 0.0).messages(); }
};

struct TestConfig {
  bool refine = true;
  SensorConfig sensor;
  int iterations = 40;
  std::int64_t seed = 0;
  double ratio = 0.3;
  std::string name = "plain";
  std::vector<std::string> tags;
  Feature feature = Feature::kSift;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("refine", refine);
    visitor("sensor", sensor);
    visitor("iterations", iterations);
    visitor("seed", seed);
    visitor("ratio", ratio);
    visitor("name", name);
    visitor("tags", tags);
    visitor("feature", feature);
  }
  [[nodiscard]] std::vector<std::string> validate() const {
    return ConfigRules().between("ratio", ratio, 0.0, 1.0).atLeast("iterations", iterations, 1).messages();
  }
};

/// The message of the Error that loading throws; "" if it throws none.
std::string failureOf(const ConfigLayers& layers, ErrorCode expected) {
  try {
    static_cast<void>(loadConfig<TestConfig>(layers));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), expected) << error.what();
    return error.what();
  }
  return "";
}

class ConfigFile : public ::testing::Test {
 protected:
  /// As failureOf, with the file's path cut off so that the message starts with its line.
  std::string failureOfText(const std::string& text) {
    const auto file = folder_.write("map.toml", text);
    const std::string message = failureOf({file, {}}, ErrorCode::kInput);
    EXPECT_TRUE(message.starts_with(file.string() + ":")) << message;
    return message.substr(std::min(message.size(), file.string().size() + 1));
  }
  TestConfig load(const std::string& text) { return loadConfig<TestConfig>({folder_.write("map.toml", text), {}}); }

  test::TemporaryFolder folder_;
};

TEST_F(ConfigFile, FillsEveryTypeOfField) {
  const TestConfig config = load(
      "refine = false\niterations = 7\nseed = 12345678901\nratio = 1\nname = 'Küche'\ntags = ['a', \"b\"]\n"
      "feature = 'orb'\n[sensor]\nmax_range_m = 2.5\nweights = [1, 2.5]\n");
  EXPECT_FALSE(config.refine);
  EXPECT_EQ(config.iterations, 7);
  EXPECT_EQ(config.seed, 12345678901);
  EXPECT_EQ(config.ratio, 1.0);
  EXPECT_EQ(config.name, "Küche");
  EXPECT_EQ(config.tags, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(config.feature, Feature::kOrb);
  EXPECT_EQ(config.sensor.max_range_m, 2.5);
  EXPECT_EQ(config.sensor.weights, (std::vector<double>{1.0, 2.5}));
}

TEST_F(ConfigFile, LeavesDefaultsWhereItSaysNothing) {
  EXPECT_EQ(writeConfig(load("")), writeConfig(TestConfig()));
  EXPECT_EQ(writeConfig(load("[sensor]\n")), writeConfig(TestConfig()));
}

TEST_F(ConfigFile, NamesLineAndNearestKeyOfAnUnknownOne) {
  EXPECT_EQ(failureOfText("refine = true\n\niteration = 3\n"), "3: unknown key 'iteration'; the nearest known key is 'iterations'");
  EXPECT_EQ(failureOfText("[sensor]\nmax_range = 3\n"), "2: unknown key 'sensor.max_range'; the nearest known key is 'sensor.max_range_m'");
  EXPECT_EQ(failureOfText("[senser]\n"), "1: unknown key 'senser'; the nearest known key is 'seed'");
}

TEST_F(ConfigFile, ReportsItsFirstMistakeFirst) {
  EXPECT_EQ(failureOfText("zzz = 1\naaa = 2\n").substr(0, 20), "1: unknown key 'zzz'");
}

TEST_F(ConfigFile, RejectsValuesOfTheWrongType) {
  EXPECT_EQ(failureOfText("refine = 1\n"), "1: refine = 1: must be true or false");
  EXPECT_EQ(failureOfText("iterations = 1.5\n"), "1: iterations = 1.5: must be a whole number of at most 31 bits");
  EXPECT_EQ(failureOfText("iterations = 2147483648\n"), "1: iterations = 2147483648: must be a whole number of at most 31 bits");
  EXPECT_EQ(failureOfText("seed = true\n"), "1: seed = true: must be a whole number");
  EXPECT_EQ(failureOfText("ratio = 'x'\n"), "1: ratio = 'x': must be a finite number");
  EXPECT_EQ(failureOfText("ratio = true\n"), "1: ratio = true: must be a finite number");
  EXPECT_EQ(failureOfText("ratio = nan\n"), "1: ratio = nan: must be a finite number");
  EXPECT_EQ(failureOfText("ratio = inf\n"), "1: ratio = inf: must be a finite number");
  EXPECT_EQ(failureOfText("name = 1\n"), "1: name = 1: must be a string");
  EXPECT_EQ(failureOfText("tags = 'a'\n"), "1: tags = 'a': must be a list of strings");
  EXPECT_EQ(failureOfText("tags = [1]\n"), "1: tags = [1]: must be a list of strings");
  EXPECT_EQ(failureOfText("[sensor]\nweights = [nan]\n"), "2: sensor.weights = [nan]: must be a list of finite numbers");
  EXPECT_EQ(failureOfText("feature = 'surf'\n"), "1: feature = 'surf': must be one of sift, orb");
  EXPECT_EQ(failureOfText("sensor = 3\n"), "1: key 'sensor' is a table, a value was given; a value in it is 'sensor.max_range_m'");
  EXPECT_EQ(failureOfText("[ratio]\n"), "1: ratio = {…}: must be a finite number");
}

TEST_F(ConfigFile, RejectsValuesOutOfRangeWithTheLineTheyCameFrom) {
  EXPECT_EQ(failureOfText("\nratio = 1.5\n"), "2: ratio = 1.5: must be from 0 to 1");
  EXPECT_EQ(failureOfText("iterations = 0\n"), "1: iterations = 0: must be >= 1");
  EXPECT_EQ(failureOfText("[sensor]\n\nmax_range_m = -1\n"), "3: sensor.max_range_m = -1: must be > 0");
}

TEST_F(ConfigFile, RejectsTextThatIsNotToml) {
  EXPECT_EQ(failureOfText("refine = true\nratio = = 1\n").substr(0, 15), "2: is not TOML:");
  EXPECT_EQ(failureOfText("ratio = 1\nratio = 2\n").substr(0, 15), "2: is not TOML:");
}

TEST(Config, MissingFileIsAnIoError) {
  EXPECT_EQ(failureOf({"/no/such/file.toml", {}}, ErrorCode::kIo), "/no/such/file.toml: cannot open: No such file or directory");
}

TEST_F(ConfigFile, CommandLineWinsOverFileAndLaterOverEarlier) {
  const auto file = folder_.write("map.toml", "ratio = 0.1\niterations = 2\n");
  const auto config = loadConfig<TestConfig>(
      {file, {parseSetting("ratio=0.2"), parseSetting("ratio = 0.4"), parseSetting("feature=orb"), parseSetting("name=1")}});
  EXPECT_EQ(config.ratio, 0.4);
  EXPECT_EQ(config.iterations, 2);
  EXPECT_EQ(config.feature, Feature::kOrb);
  EXPECT_EQ(config.name, "1");
}

TEST_F(ConfigFile, CommandLineRepairsWhatTheFileBreaks) {
  const auto file = folder_.write("map.toml", "ratio = 7\n");
  EXPECT_EQ(loadConfig<TestConfig>({file, {parseSetting("ratio=0.5")}}).ratio, 0.5);
}

TEST(Config, SettingsAreUsageErrorsThatNameTheirOption) {
  const auto failure = [](const std::string& text) { return failureOf({{}, {parseSetting(text)}}, ErrorCode::kUsage); };
  EXPECT_EQ(failure("rato=1"), "--set: unknown key 'rato'; the nearest known key is 'ratio'");
  EXPECT_EQ(failure("ratio=2"), "--set: ratio = 2: must be from 0 to 1");
  EXPECT_EQ(failure("ratio=abc"), "--set: ratio = abc: is not a TOML value");
  EXPECT_EQ(failure("ratio=0.1\nname = 'x'"), "--set: ratio = 0.1\nname = 'x': is not a TOML value");
  EXPECT_EQ(failure("ratio="), "--set: ratio = : is not a TOML value");
  EXPECT_EQ(failure("feature=surf"), "--set: feature = 'surf': must be one of sift, orb");
  EXPECT_EQ(failureOf({{}, {{"iterations", "0", "--iterations"}}}, ErrorCode::kUsage), "--iterations: iterations = 0: must be >= 1");
}

TEST(Config, SettingNeedsKeyAndEqualsSign) {
  for (const char* text : {"ratio", "=1", ""}) {
    EXPECT_THROW(static_cast<void>(parseSetting(text)), Error) << text;
  }
  const Setting setting = parseSetting(" a.b = c = d ");
  EXPECT_EQ(setting.key, "a.b");
  EXPECT_EQ(setting.value, "c = d");
}

TEST(Config, DefaultsThatBreakTheirOwnRulesAreABug) {
  EXPECT_THROW(throwIfInvalid({"ratio = 2: must be less"}, {}), ContractViolation);
}

TEST(Config, RuleThatNamesAKeyLeftAtItsDefaultIsReportedAllTheSame) {
  EXPECT_THROW(throwIfInvalid({"min = 2: must be < max"}, {{"max", {"--set", ErrorCode::kUsage}}}), Error);
}

TEST(Config, IsWrittenInOrderWithTheRootFirst) {
  EXPECT_EQ(writeConfig(TestConfig()),
            "refine = true\niterations = 40\nseed = 0\nratio = 0.3\nname = \"plain\"\ntags = []\nfeature = \"sift\"\n"
            "\n[sensor]\nmax_range_m = 4.0\nweights = [1.0, 0.5]\n");
}

TEST_F(ConfigFile, ReadsBackWhatWasWritten) {
  TestConfig config;
  config.name = "a \"quoted\"\\ line\nand\ttab \x7f Küche";
  config.tags = {"", "x"};
  config.ratio = 0.1 + 0.2;
  config.seed = std::numeric_limits<std::int64_t>::min();
  config.sensor.max_range_m = std::numeric_limits<double>::max();
  config.sensor.weights = {std::numeric_limits<double>::denorm_min(), 1e22, 123456789.0, -0.0};
  const TestConfig back = load(writeConfig(config));
  EXPECT_EQ(back.name, config.name);
  EXPECT_EQ(back.tags, config.tags);
  EXPECT_EQ(back.ratio, config.ratio);
  EXPECT_EQ(back.seed, config.seed);
  EXPECT_EQ(back.sensor.max_range_m, config.sensor.max_range_m);
  EXPECT_EQ(back.sensor.weights, config.sensor.weights);
  EXPECT_TRUE(std::signbit(back.sensor.weights[3]));
}

TEST(ConfigRules, NanBreaksEveryRule) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ConfigRules().greater("a", nan, 0.0).atLeast("b", nan, 0.0).between("c", nan, 0.0, 1.0).messages(),
            (std::vector<std::string>{"a = nan: must be > 0", "b = nan: must be >= 0", "c = nan: must be from 0 to 1"}));
}

TEST(EnumTable, RoundTrips) {
  test::checkEnumTable(Feature::kOrb);
}

}  // namespace
}  // namespace oikos::base
