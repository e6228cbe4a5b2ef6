// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>

#include "tools/command.h"
#include "tools/model_commands.h"

namespace oikos::tools {

void addModelCommand(CLI::App& root) {
  CLI::App& command = addCommand(root, {"model", "Models of furniture and small objects.",
                                        "  oikos model shapes cabinet\n"
                                        "  oikos model import cupboard.urdf\n"
                                        "  oikos model import --shape \"cabinet width_m=0.8 door_count=2\" --id cupboard\n"
                                        "  oikos model train knobs --out detector.txt"});
  addModelShapesCommand(command);
  addModelImportCommand(command);
  addModelTrainCommand(command);
}

}  // namespace oikos::tools
