// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"
#include "tools/command.h"
#include "tools/program.h"

namespace oikos::tools {
namespace {

using Json = nlohmann::json;

/// A stream's text for as long as this lives.
class Captured {
 public:
  explicit Captured(std::ostream& stream) : stream_(stream), before_(stream.rdbuf(text_.rdbuf())) {}
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;
  ~Captured() { stream_.rdbuf(before_); }
  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::ostream& stream_;
  std::streambuf* before_;
};

struct Outcome {
  ExitCode code = ExitCode::kInternal;
  std::string answer;
  std::string complaint;
};

Outcome evaluate(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"oikos", "evaluate"});
  std::vector<char*> argv;
  for (std::string& argument : arguments) {
    argv.push_back(argument.data());
  }
  const Captured answer(std::cout);
  const Captured complaint(std::cerr);
  Program program;
  addEvaluateCommand(program.root());
  const ExitCode code = program.run(static_cast<int>(argv.size()), argv.data());
  return {code, answer.text(), complaint.text()};
}

// A square's corners; the estimate's x axis is a tenth too long: errors 10, 0, 10, 0 cm.
constexpr const char* kTruth = "# a comment\n0 1 0 0 0 0 0 1\n1 0 1 0 0 0 0 1\n2 -1 0 0 0 0 0 1\n3 0 -1 0 0 0 0 1\n";
constexpr const char* kEstimate = "0 1.1 0 0 0 0 0 1\n1 0 1 0 0 0 0 1\n2 -1.1 0 0 0 0 0 1\n3 0 -1 0 0 0 0 1\n";

class Evaluate : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) { return folder_.write(name, text).string(); }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(Evaluate, TrajectoryInCentimetres) {
  const Outcome run = evaluate({"trajectory", file("e.txt", kEstimate), file("t.txt", kTruth)});
  EXPECT_EQ(run.code, ExitCode::kDone) << run.complaint;
  EXPECT_NE(run.answer.find("4 of 4 estimated poses"), std::string::npos);
  EXPECT_NE(run.answer.find("ATE           rmse 7.07  mean 5.00  median 5.00  max 10.00 cm"), std::string::npos) << run.answer;
  EXPECT_NE(run.answer.find("motionless    rmse 100.00 cm"), std::string::npos);
  EXPECT_NE(run.answer.find("RPE 1.00 m    no pair is that long"), std::string::npos);
}

TEST_F(Evaluate, TrajectoryAsJson) {
  const Outcome run = evaluate({"trajectory", file("e.txt", kEstimate), file("t.txt", kTruth), "--distance", "1.45", "--json"});
  ASSERT_EQ(run.code, ExitCode::kDone) << run.complaint;
  const Json json = Json::parse(run.answer);
  EXPECT_EQ(json["status"], "evaluated");
  EXPECT_EQ(json["associated_poses"], 4);
  EXPECT_NEAR(json["ate"]["max_m"].get<double>(), 0.1, 1e-12);
  EXPECT_NEAR(json["motionless_ate_rmse_m"].get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(json["rpe_per_interval"]["translation"]["rmse_m"].get<double>(), 0.1, 1e-12);
  EXPECT_EQ(json["rpe_per_distance"]["pairs"], 3);
  EXPECT_EQ(json["alignment"]["scale"], 1.0);
}

TEST_F(Evaluate, TrajectoriesThatDoNotMeetHaveNoAnswer) {
  const std::string later = "100 0 0 0 0 0 0 1\n101 1 0 0 0 0 0 1\n";
  const Outcome run = evaluate({"trajectory", file("e.txt", later), file("t.txt", kTruth), "--json"});
  EXPECT_EQ(run.code, ExitCode::kNoAnswer);
  EXPECT_EQ(Json::parse(run.answer)["status"], "no-overlap");
  EXPECT_NE(run.complaint.find("one clock"), std::string::npos);
  EXPECT_EQ(evaluate({"trajectory", file("two.txt", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n"), file("t.txt", kTruth)}).code,
            ExitCode::kNoAnswer);
}

TEST_F(Evaluate, EachMistakeHasItsExitCode) {
  const std::string truth = file("t.txt", kTruth);
  EXPECT_EQ(evaluate({"trajectory", "no-such-file", truth}).code, ExitCode::kIo);
  EXPECT_EQ(evaluate({"trajectory", file("bad.txt", "0 1 2\n"), truth}).code, ExitCode::kInput);
  EXPECT_EQ(evaluate({"trajectory", truth}).code, ExitCode::kUsage);
  EXPECT_EQ(evaluate({"trajectory", truth, truth, "--interval", "0"}).code, ExitCode::kUsage);
  EXPECT_EQ(evaluate({"trajectory", truth, truth, "--association", "guess"}).code, ExitCode::kUsage);
  EXPECT_EQ(evaluate({}).code, ExitCode::kUsage);
}

std::string ply(const std::vector<std::string>& points) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (const std::string& point : points) {
    text += point + "\n";
  }
  return text;
}

TEST_F(Evaluate, Map) {
  const std::string cloud = file("cloud.ply", ply({"0.01 0 0", "1 0.03 0"}));
  const std::string reference = file("reference.ply", ply({"0 0 0", "1 0 0", "1 1.03 0"}));
  const Outcome text = evaluate({"map", cloud, reference});
  EXPECT_EQ(text.code, ExitCode::kDone) << text.complaint;
  EXPECT_NE(text.answer.find("50.0 % within 2 cm, 100.0 % within 5 cm  (2 points)"), std::string::npos) << text.answer;
  const Json json = Json::parse(evaluate({"map", cloud, reference, "--json"}).answer);
  EXPECT_NEAR(json["accuracy"]["mean_m"].get<double>(), 0.02, 1e-7);
  EXPECT_NEAR(json["completeness"]["max_m"].get<double>(), 1.0, 1e-6);
  EXPECT_EQ(json["completeness"]["shares"][1]["within_m"], 0.05);
}

TEST_F(Evaluate, HelpShowsExamples) {
  const Outcome run = evaluate({"trajectory", "--help"});
  EXPECT_EQ(run.code, ExitCode::kDone);
  EXPECT_NE(run.answer.find("oikos evaluate trajectory home/map/trajectory.txt drive/groundtruth.txt"), std::string::npos);
}

}  // namespace
}  // namespace oikos::tools
