// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/model/shapes/shape_text.h"
#include "tools/command.h"
#include "tools/model_commands.h"

namespace oikos::tools {

namespace {

constexpr const char* kExamples =
    "  oikos model shapes\n"
    "  oikos model shapes cabinet\n"
    "  oikos model shapes oven --json\n"
    "The kinds and dimensions of a <shape> in home.xml (docs/formats.md).";

ExitCode listKinds(bool as_json) {
  const std::vector<std::string> kinds = model::shapeKinds();
  if (as_json) {
    std::cout << nlohmann::ordered_json{{"kinds", kinds}}.dump(2) << '\n';
    return ExitCode::kDone;
  }
  for (const std::string& kind : kinds) {
    std::cout << kind << '\n';
  }
  return ExitCode::kDone;
}

ExitCode listDimensions(const std::string& kind, bool as_json) {
  const model::Dimensions dimensions = model::shapeDimensions(kind);
  if (as_json) {
    nlohmann::ordered_json defaults = nlohmann::ordered_json::object();
    for (const auto& [name, value] : dimensions) {
      defaults[name] = value;
    }
    std::cout << nlohmann::ordered_json{{"kind", kind}, {"defaults", defaults}}.dump(2) << '\n';
    return ExitCode::kDone;
  }
  for (const auto& [name, value] : dimensions) {
    std::cout << name << "=\"" << value << "\"\n";
  }
  return ExitCode::kDone;
}

}  // namespace

void addModelShapesCommand(CLI::App& model) {
  CLI::App& command =
      addCommand(model, {"shapes", "Lists what can be modelled by its dimensions, or a kind's with their defaults.", kExamples});
  const auto kind = std::make_shared<std::string>();
  command.add_option("KIND", *kind, "for instance cabinet; without it the kinds are listed");
  setAction(command, [kind](const Session& session) {
    return kind->empty() ? listKinds(session.options.json) : listDimensions(*kind, session.options.json);
  });
}

}  // namespace oikos::tools
