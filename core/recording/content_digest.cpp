// SPDX-License-Identifier: Apache-2.0
#include "core/recording/content_digest.h"

#include <cmath>

#include "core/base/read_file.h"
#include "core/base/sha256.h"
#include "core/recording/listing.h"
#include "core/recording/recording.h"

namespace oikos::recording {

namespace {

namespace fs = std::filesystem;

/// With its length before it: where one file ends and the next begins is part of the content.
void addFile(const fs::path& file, base::Sha256& sum) {
  const std::string content = base::readFile(file);
  sum.add(std::to_string(content.size()) + "\n");
  sum.add(content);
}

}  // namespace

std::string contentDigest(const fs::path& folder) {
  const bool is_tum = looksLikeTum(folder);
  constexpr double kAnyRate_hz = 30.0;  // of numbers that are stamps only in the end
  const Listing listing =
      is_tum ? listTum(folder, std::llround(RecordingConfig().max_association_s * 1e9)) : listSevenScenes(folder, kAnyRate_hz);
  base::Sha256 sum;
  for (const char* const name : {"camera.toml", "rgb.txt", "depth.txt"}) {
    if (fs::exists(folder / name)) {
      sum.add(name);
      addFile(folder / name, sum);
    }
  }
  for (const ListedFrame& frame : listing.frames) {
    sum.add(std::to_string(frame.stamp_ns) + "\n");
    addFile(frame.color, sum);
    addFile(frame.depth, sum);
  }
  return sum.finish();
}

}  // namespace oikos::recording
