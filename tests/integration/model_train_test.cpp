// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/read_file.h"
#include "tests/integration/process.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

ProcessResult trainKnobs(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {"model", "train", "knobs"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return runOikos(all);
}

/// A training of seconds, and where its outcome goes.
class ModelTrainKnobs : public testing::Test {
 protected:
  std::string trainedWith(const std::string& name, const std::vector<std::string>& options) const {
    std::vector<std::string> all = {"--out", (folder.path() / name).string(), "--config", config};
    all.insert(all.end(), options.begin(), options.end());
    const ProcessResult result = trainKnobs(all);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return base::readFile(folder.path() / name);
  }

  TemporaryFolder folder;
  std::string config = folder.write("small.toml", "panels = 24\nrounds = 1\n").string();
};

TEST_F(ModelTrainKnobs, GivesTheSameBytesForTheSameSeedAndAnyNumberOfThreads) {
  const std::string one = trainedWith("one.txt", {"--seed", "3", "--threads", "1"});
  EXPECT_EQ(trainedWith("two.txt", {"--seed", "3", "--threads", "2"}), one);
  EXPECT_NE(trainedWith("other.txt", {"--seed", "4"}), one);
  EXPECT_TRUE(one.starts_with("oikos-knob-detector 1\nweights 576\nbias ")) << one.substr(0, 100);
}

TEST_F(ModelTrainKnobs, SaysWhatItWasTrainedOn) {
  const std::string out = (folder.path() / "detector.txt").string();
  const ProcessResult result = trainKnobs({"--out", out, "--config", config, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["written"], out);
  EXPECT_EQ(json["panels"], 24);
  EXPECT_GT(json["knobs"], 5);
  EXPECT_GT(json["others"], 24);
  EXPECT_LE(json["recall"], 1.0);
  EXPECT_TRUE(json.contains("false_alarms_per_panel"));
}

TEST_F(ModelTrainKnobs, RefusesWhatItCannotTrainWith) {
  const std::string out = (folder.path() / "detector.txt").string();
  const auto expectFailure = [&](const std::vector<std::string>& arguments, int code, const std::string& message) {
    const ProcessResult result = trainKnobs(arguments);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  expectFailure({}, 2, "--out is required");
  expectFailure({"--out", out, "--panels", "24"}, 2, "--panels");
  expectFailure({"--out", out, "--config", folder.write("few.toml", "rounds = 1\npanels = 5\n").string()}, 3,
                "few.toml:2: panels = 5: must be from 10 to 36000");
  expectFailure({"--out", out, "--config", folder.write("typo.toml", "pannels = 24\n").string()}, 3,
                "typo.toml:1: unknown key 'pannels'; the nearest known key is 'panels'");
  expectFailure({"--out", out, "--config", (folder.path() / "none.toml").string()}, 4, "none.toml");
  expectFailure({"--out", folder.path().string(), "--config", config}, 4, folder.path().string());
}

/// Before minutes of training, not after.
TEST_F(ModelTrainKnobs, RefusesAPlaceThatItCannotWriteToBeforeItTrains) {
  const std::string nowhere = (folder.path() / "none" / "detector.txt").string();
  const ProcessResult result = trainKnobs({"--out", nowhere});  // all 4,000 panels: this would take minutes
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find(nowhere), std::string::npos) << result.err;
}

TEST(ModelTrain, KnowsOnlyKnobs) {
  const ProcessResult result = runOikos({"model", "train", "handles"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("no command 'handles'; known: knobs"), std::string::npos) << result.err;
  EXPECT_EQ(runOikos({"model", "train"}).exit_code, 2);
}

}  // namespace
}  // namespace oikos::test
