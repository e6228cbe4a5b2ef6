// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/integration/process.h"

namespace oikos::test {
namespace {

using Arguments = std::vector<std::string>;

/// The commands that a help text lists.
std::vector<std::string> listedCommands(const std::string& help) {
  std::istringstream lines(help.substr(std::min(help.find("Subcommands:"), help.size())));
  std::vector<std::string> commands;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("  ")) {
    commands.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return commands;
}

void expectHelp(const Arguments& command) {
  Arguments arguments = command;
  arguments.emplace_back("--help");
  const ProcessResult result = runOikos(arguments);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("Examples:\n  oikos"), std::string::npos) << result.out;
  for (const std::string& name : listedCommands(result.out)) {
    SCOPED_TRACE(name);
    Arguments inner = command;
    inner.push_back(name);
    expectHelp(inner);
  }
}

void expectUsageError(const Arguments& arguments, const std::string& message) {
  const ProcessResult result = runOikos(arguments);
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(result.err.starts_with("oikos: ")) << result.err;
  EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
}

TEST(CommandLine, PrintsTheVersionOfTheProject) {
  const ProcessResult result = runOikos({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "oikos " OIKOS_PROJECT_VERSION "\n");
  EXPECT_EQ(result.err, "");
}

TEST(CommandLine, EveryCommandHasHelpWithExamples) {
  expectHelp({});
}

TEST(CommandLine, UsageErrorsExitWith2AndSayWhereHelpIs) {
  expectUsageError({}, "a command is missing (see oikos --help)");
  expectUsageError({"--frobnicate"}, "--frobnicate");
  expectUsageError({"--threads", "0"}, "--threads");
  expectUsageError({"--threads", "many"}, "--threads");
  expectUsageError({"--seed", "1.5"}, "--seed");
}

TEST(CommandLine, MissingInputIsAnIoErrorAndWrongInputAnInputError) {
  const TemporaryFolder folder;
  const ProcessResult missing = runOikos({"inspect", (folder.path() / "missing").string()});
  EXPECT_EQ(missing.exit_code, 4);
  EXPECT_NE(missing.err.find("missing"), std::string::npos) << missing.err;
  const ProcessResult empty = runOikos({"inspect", folder.path().string()});
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_TRUE(empty.err.starts_with("oikos: " + folder.path().string())) << empty.err;
  const auto config = folder.write("inspect.toml", "[inspection]\nmax_frame = 3\n");
  const ProcessResult unknown_key = runOikos({"inspect", folder.path().string(), "--config", config.string()});
  EXPECT_EQ(unknown_key.exit_code, 3);
  EXPECT_EQ(unknown_key.err,
            "oikos: " + config.string() + ":2: unknown key 'inspection.max_frame'; the nearest known key is 'inspection.max_frames'\n");
}

TEST(CommandLine, ParametersOnTheCommandLineAreUsageErrorsWhenWrong) {
  expectUsageError({"inspect", "x", "--set", "inspection.max_frames=1"}, "--set: inspection.max_frames = 1: must be >= 2");
  expectUsageError({"inspect", "x", "--set", "inspection.max_frames=many"}, "--set: inspection.max_frames = many");
  expectUsageError({"inspect"}, "RECORDING");
  expectUsageError({"evaluate"}, "a command is missing (see oikos evaluate --help)");
  expectUsageError({"evaluate", "trajctory"}, "did you mean 'trajectory'?");
}

TEST(CommandLine, AnswerThatCannotBeWrittenIsAnIoError) {
  Process process({oikosBinary(), "--help"}, "/dev/full");
  const ProcessResult result = process.finish();
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("stdout"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace oikos::test
