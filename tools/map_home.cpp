// SPDX-License-Identifier: Apache-2.0
#include "tools/map_home.h"

#include "semantic/xml/home_reader.h"
#include "tools/home_stage.h"
#include "tools/room_clouds.h"
#include "tools/terminal_progress.h"

namespace oikos::tools {

mapping::MapResult mapIntoHome(const MapJob& job, const Session& session) {
  TerminalProgress progress(session.options);
  const mapping::MapRun run{
      .threads = session.options.threads, .seed = session.options.seed, .T_base_camera = job.T_base_camera, .progress = progress.sink()};
  std::optional<semantic::Home> known;  // read before the work: a broken home.xml is told at once
  const std::filesystem::path home_xml = job.home / "home.xml";
  if (std::filesystem::exists(home_xml)) {
    known = semantic::getHome(semantic::readHome(home_xml), home_xml);
  }
  HomeStage stage(job.home, session.interrupts);
  const mapping::MapResult result = mapping::buildMap(job.recording, job.config, run, stage.mapFolder());
  if (known) {
    writeRoomClouds(*known, stage.mapFolder());
  }
  stage.commit();
  return result;
}

}  // namespace oikos::tools
