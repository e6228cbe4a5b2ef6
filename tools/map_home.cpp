// SPDX-License-Identifier: Apache-2.0
#include "tools/map_home.h"

#include <iostream>

#include "core/base/error.h"
#include "semantic/xml/home_reader.h"
#include "tools/home_stage.h"
#include "tools/room_clouds.h"
#include "tools/terminal_progress.h"

namespace oikos::tools {

namespace {

/// A map can be made without a valid home.xml; what is wrong with it is told before the work.
std::optional<semantic::Home> findHome(const std::filesystem::path& home) {
  const std::filesystem::path file = home / "home.xml";
  if (!std::filesystem::exists(file)) {
    return std::nullopt;
  }
  try {
    return semantic::getHome(semantic::readHome(file), file);
  } catch (const base::Error& error) {
    std::cerr << "oikos: the rooms get no clouds of their own: " << error.what() << '\n';
    return std::nullopt;
  }
}

}  // namespace

mapping::MapResult mapIntoHome(const MapJob& job, const Session& session) {
  TerminalProgress progress(session.options);
  const mapping::MapRun run{
      .threads = session.options.threads, .seed = session.options.seed, .T_base_camera = job.T_base_camera, .progress = progress.sink()};
  const std::optional<semantic::Home> known = findHome(job.home);
  HomeStage stage(job.home, session.interrupts);
  const mapping::MapResult result = mapping::buildMap(job.recording, job.config, run, stage.mapFolder());
  if (known) {
    writeRoomClouds(*known, stage.mapFolder());
  }
  stage.commit();
  return result;
}

}  // namespace oikos::tools
