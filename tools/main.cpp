// SPDX-License-Identifier: Apache-2.0
#include "tools/command.h"
#include "tools/program.h"

int main(int argc, char** argv) {
  oikos::tools::Program program;
  oikos::tools::addDemoCommand(program.root());
  oikos::tools::addMapCommand(program.root());
  oikos::tools::addLocateCommand(program.root());
  oikos::tools::addTrackCommand(program.root());
  oikos::tools::addInspectCommand(program.root());
  oikos::tools::addAskCommand(program.root());
  oikos::tools::addTellCommand(program.root());
  oikos::tools::addCheckCommand(program.root());
  oikos::tools::addServeCommand(program.root());
  oikos::tools::addSimulateCommand(program.root());
  oikos::tools::addRevertCommand(program.root());
  oikos::tools::addForgetCommand(program.root());
  oikos::tools::addModelCommand(program.root());
  oikos::tools::addEvaluateCommand(program.root());
  return static_cast<int>(program.run(argc, argv));
}
