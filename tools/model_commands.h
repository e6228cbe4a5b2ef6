// SPDX-License-Identifier: Apache-2.0
// The commands of `oikos model`, one file each: tools/model_NAME.cpp.
#pragma once

#include "tools/command.h"

namespace oikos::tools {

void addModelImportCommand(CLI::App& model);
void addModelShapesCommand(CLI::App& model);
void addModelTrainCommand(CLI::App& model);

}  // namespace oikos::tools
