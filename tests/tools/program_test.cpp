// SPDX-License-Identifier: Apache-2.0
#include "tools/program.h"

#include <gtest/gtest.h>

#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace oikos::tools {
namespace {

struct Outcome {
  ExitCode code = ExitCode::kInternal;
  std::string out;
  std::string err;
};

/// A program with the commands `work` and `measure path`, both with this action.
Outcome run(std::vector<std::string> words, const Action& action) {
  Program program;
  CLI::App& work = addCommand(program.root(), {"work", "Works.", "  oikos work"});
  setAction(work, action);
  CLI::App& measure = addCommand(program.root(), {"measure", "Measures.", "  oikos measure path"});
  setAction(addCommand(measure, {"path", "Measures a path.", "  oikos measure path", true}), action);
  words.insert(words.begin(), "oikos");
  std::vector<char*> pointers;
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const ExitCode code = program.run(static_cast<int>(pointers.size()), pointers.data());
  return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

ExitCode doNothing(const Session& /*unused*/) {
  return ExitCode::kDone;
}

TEST(Program, GivesTheActionItsOptionsFromBothSidesOfTheCommand) {
  std::optional<GlobalOptions> seen;
  const Outcome result =
      run({"--threads", "3", "measure", "path", "--seed", "-7", "--json", "--quiet", "--config", "a.toml"}, [&](const Session& session) {
        seen = session.options;
        return ExitCode::kNoAnswer;
      });
  EXPECT_EQ(result.code, ExitCode::kNoAnswer);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->threads, 3);
  EXPECT_EQ(seen->seed, -7);
  EXPECT_TRUE(seen->json);
  EXPECT_TRUE(seen->quiet);
  EXPECT_EQ(seen->config, "a.toml");
}

TEST(Program, UsesAllCoresByDefault) {
  int threads = 0;
  static_cast<void>(run({"work"}, [&](const Session& session) {
    threads = session.options.threads;
    return ExitCode::kDone;
  }));
  EXPECT_GE(threads, 1);
}

TEST(Program, TurnsErrorsIntoTheirExitCodes) {
  const auto codeOf = [](auto failure) { return run({"work"}, [failure](const Session&) -> ExitCode { throw failure; }); };
  const Outcome input = codeOf(base::Error(base::ErrorCode::kInput, "is wrong", "file:3"));
  EXPECT_EQ(input.code, ExitCode::kInput);
  EXPECT_EQ(input.err, "oikos: file:3: is wrong\n");
  EXPECT_EQ(input.out, "");
  EXPECT_EQ(codeOf(base::Error(base::ErrorCode::kUsage, "x")).code, ExitCode::kUsage);
  EXPECT_EQ(codeOf(base::Error(base::ErrorCode::kIo, "x")).code, ExitCode::kIo);
  EXPECT_EQ(codeOf(std::bad_alloc()).code, ExitCode::kIo);
  EXPECT_EQ(codeOf(base::ContractViolation("a.cpp:1: contract broken")).code, ExitCode::kInternal);
  EXPECT_EQ(codeOf(std::runtime_error("x")).code, ExitCode::kInternal);
  EXPECT_EQ(codeOf(42).code, ExitCode::kInternal);
}

TEST(Program, NamesTheCommandThatWasMeant) {
  const Outcome misspelt = run({"wrok"}, doNothing);
  EXPECT_EQ(misspelt.code, ExitCode::kUsage);
  EXPECT_EQ(misspelt.err, "oikos: no command 'wrok'; did you mean 'work'? (see oikos --help)\n");
  const Outcome inner = run({"measure", "pth"}, doNothing);
  EXPECT_EQ(inner.code, ExitCode::kUsage);
  EXPECT_EQ(inner.err, "oikos: no command 'pth'; did you mean 'path'? (see oikos measure --help)\n");
}

TEST(Program, ConfigurationFileThatNobodyWouldReadIsAUsageError) {
  const Outcome result = run({"work", "--config", "a.toml"}, doNothing);
  EXPECT_EQ(result.code, ExitCode::kUsage);
  EXPECT_EQ(result.err, "oikos: --config: oikos work has no parameters that a file could give\n");
}

TEST(Program, CommandWithCommandsNeedsOne) {
  const Outcome result = run({"measure"}, doNothing);
  EXPECT_EQ(result.code, ExitCode::kUsage);
  EXPECT_EQ(result.err, "oikos: a command is missing (see oikos measure --help)\n");
}

TEST(Program, HelpOfACommandShowsItsExamples) {
  const Outcome result = run({"work", "--help"}, doNothing);
  EXPECT_EQ(result.code, ExitCode::kDone);
  EXPECT_NE(result.out.find("Examples:\n  oikos work"), std::string::npos) << result.out;
}

TEST(Program, UnknownOptionOfACommandIsAUsageError) {
  const Outcome result = run({"work", "--fast"}, doNothing);
  EXPECT_EQ(result.code, ExitCode::kUsage);
  EXPECT_NE(result.err.find("--fast"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("(see oikos work --help)"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace oikos::tools
