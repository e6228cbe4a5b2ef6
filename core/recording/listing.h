// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/recording/recording.h"

namespace oikos::recording {

/// The files of one frame.
struct ListedFrame {
  std::int64_t stamp_ns = 0;  ///< of the colour image
  std::filesystem::path color;
  std::filesystem::path depth;
  std::string listed_at;  ///< "FILE:LINE" of the list that names the colour image; empty if the file's own name is the list
};

/// A recording's frames by stamp.
struct Listing {
  std::string format;  ///< for a person
  std::vector<ListedFrame> frames;
  ListingStatistics statistics;
};

/// An image of one list, before it has a partner.
struct ListedImage {
  std::int64_t stamp_ns = 0;
  std::filesystem::path file;
  std::string listed_at;
};

/// Pairs whose stamps are at most `max_difference_ns` apart, the closest pair first and each image once (the rule of the TUM benchmark's
/// associate.py; of equally close pairs the earlier goes first). Both lists ascend. The result ascends.
struct ImagePair {
  int color = -1;
  int depth = -1;
};
[[nodiscard]] std::vector<ImagePair> associate(const std::vector<ListedImage>& color, const std::vector<ListedImage>& depth,
                                               std::int64_t max_difference_ns);

/// TUM RGB-D: `rgb.txt` and `depth.txt`, a line `stamp file` each. Throws Error with file and line.
[[nodiscard]] bool looksLikeTum(const std::filesystem::path& folder);
/// The colour images alone, whatever depth there is; without duplicates.
[[nodiscard]] std::vector<ListedImage> listTumColor(const std::filesystem::path& folder);
[[nodiscard]] Listing listTum(const std::filesystem::path& folder, std::int64_t max_difference_ns);

/// 7-Scenes: `frame-NNNNNN.color.png` (or .jpg) and `frame-NNNNNN.depth.png`; the stamp is NNNNNN / rate_hz. Throws Error.
[[nodiscard]] bool looksLikeSevenScenes(const std::filesystem::path& folder);
[[nodiscard]] Listing listSevenScenes(const std::filesystem::path& folder, double rate_hz);

}  // namespace oikos::recording
