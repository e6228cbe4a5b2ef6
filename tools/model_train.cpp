// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/config.h"
#include "core/base/number_text.h"
#include "recognition/knobs/training/detector_training.h"
#include "tools/command.h"
#include "tools/model_commands.h"
#include "tools/terminal_progress.h"

namespace oikos::tools {

namespace {

constexpr const char* kExamples =
    "  oikos model train knobs --out detector.txt\n"
    "  oikos model train knobs --out detector.txt --seed 1 --config training.toml\n"
    "Nothing but renders is needed. The detector that the program was built with was made by the first line "
    "(recognition/knobs/detector.txt).";

ExitCode trainKnobs(const std::filesystem::path& out, const Session& session) {
  const auto config = base::loadConfig<recognition::DetectorTrainingConfig>({session.options.config, {}});
  recognition::TrainingRun run;
  run.seed = static_cast<std::uint64_t>(session.options.seed);
  run.threads = session.options.threads;
  base::AtomicFile file(out);  // a place that cannot be written to is refused before minutes of training
  TerminalProgress progress(session.options);
  run.progress = progress.sink();
  const recognition::TrainedDetector trained = recognition::trainDetector(recognition::trainingLook(), config, run);
  file.stream() << recognition::writeDetector(trained.model);
  file.commit();
  if (session.options.json) {
    std::cout << nlohmann::ordered_json{{"written", out.string()},    {"panels", config.panels},
                                        {"knobs", trained.positives}, {"others", trained.negatives},
                                        {"recall", trained.recall},   {"false_alarms_per_panel", trained.false_alarms_per_panel}}
                     .dump(2)
              << '\n';
    return ExitCode::kDone;
  }
  std::cout << out.string() << ": trained on " << trained.positives << " knobs and " << trained.negatives << " other windows of "
            << config.panels << " renders; finds " << base::toFixedText(100.0 * trained.recall, 1)
            << " % of the knobs on panels that were held back, " << base::toFixedText(trained.false_alarms_per_panel, 3)
            << " false alarms on each\n";
  return ExitCode::kDone;
}

}  // namespace

void addModelTrainCommand(CLI::App& model) {
  CLI::App& train = addCommand(model, {"train", "Trains recognition from renders.", kExamples});
  CLI::App& knobs =
      addCommand(train, {.name = "knobs", .purpose = "Trains the knob detector.", .examples = kExamples, .takes_config = true});
  const auto out = std::make_shared<std::filesystem::path>();
  knobs.add_option("--out", *out, "the file to write")->required();
  setAction(knobs, [out](const Session& session) { return trainKnobs(*out, session); });
}

}  // namespace oikos::tools
