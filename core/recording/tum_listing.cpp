// SPDX-License-Identifier: Apache-2.0
// Format: "File Formats", https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats
#include <algorithm>
#include <limits>
#include <sstream>

#include "core/base/error.h"
#include "core/base/read_file.h"
#include "core/recording/decimal.h"
#include "core/recording/listing.h"

namespace oikos::recording {

namespace {

namespace fs = std::filesystem;
using base::Error;
using base::ErrorCode;

constexpr const char* kColorList = "rgb.txt";
constexpr const char* kDepthList = "depth.txt";

struct ImageList {
  std::vector<ListedImage> images;
  int listed = 0;
  int duplicates = 0;
};

ListedImage parseEntry(const std::string& line, const fs::path& folder, const std::string& where) {
  const auto fields = splitFields(line);
  if (fields.size() != 2) {
    throw Error(ErrorCode::kInput, "'" + line + "' is not 'stamp file'", where);
  }
  const auto stamp_ns = parseStampNs(fields[0]);
  if (!stamp_ns) {
    throw Error(ErrorCode::kInput, "'" + std::string(fields[0]) + "' is not a stamp in decimal seconds", where);
  }
  return {*stamp_ns, folder / fields[1], where};
}

ImageList readList(const fs::path& folder, const char* name) {
  const fs::path file = folder / name;
  if (!fs::exists(file)) {
    throw Error(ErrorCode::kInput,
                std::string("no ") + name + "; a TUM recording lists its images in rgb.txt and depth.txt, a line 'stamp file' each",
                folder.string());
  }
  std::istringstream lines(base::readFile(file));
  ImageList list;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (splitFields(line).empty()) {
      continue;
    }
    const std::string where = file.string() + ":" + std::to_string(number);
    ListedImage image = parseEntry(line, folder, where);
    ++list.listed;
    if (!list.images.empty() && image.stamp_ns < list.images.back().stamp_ns) {
      throw Error(
          ErrorCode::kInput,
          "stamp " + formatStamp(image.stamp_ns) + " is out of order: the one above it is " + formatStamp(list.images.back().stamp_ns),
          where);
    }
    if (!list.images.empty() && image.stamp_ns == list.images.back().stamp_ns) {
      ++list.duplicates;
    } else {
      list.images.push_back(std::move(image));
    }
  }
  if (list.images.empty()) {
    throw Error(ErrorCode::kInput, "the list is empty; a line is 'stamp file'", file.string());
  }
  return list;
}

std::int64_t leastDifferenceNs(const std::vector<ListedImage>& color, const std::vector<ListedImage>& depth) {
  std::int64_t least_ns = std::numeric_limits<std::int64_t>::max();
  for (std::size_t c = 0, d = 0; c < color.size() && d < depth.size();) {
    least_ns = std::min(least_ns, std::abs(color[c].stamp_ns - depth[d].stamp_ns));
    (color[c].stamp_ns < depth[d].stamp_ns ? c : d)++;
  }
  return least_ns;
}

}  // namespace

bool looksLikeTum(const fs::path& folder) {
  return fs::exists(folder / kColorList) || fs::exists(folder / kDepthList) ||
         (fs::is_directory(folder / "rgb") && fs::is_directory(folder / "depth"));
}

std::vector<ListedImage> listTumColor(const fs::path& folder) {
  return readList(folder, kColorList).images;
}

Listing listTum(const fs::path& folder, std::int64_t max_difference_ns) {
  const ImageList color = readList(folder, kColorList);
  const ImageList depth = readList(folder, kDepthList);
  Listing listing;
  for (const ImagePair& pair : associate(color.images, depth.images, max_difference_ns)) {
    const ListedImage& image = color.images[static_cast<std::size_t>(pair.color)];
    listing.frames.push_back({image.stamp_ns, image.file, depth.images[static_cast<std::size_t>(pair.depth)].file, image.listed_at});
  }
  if (listing.frames.empty()) {
    throw Error(ErrorCode::kInput,
                "no colour image has a depth image within " + formatStamp(max_difference_ns) + " s; the closest pair is " +
                    formatStamp(leastDifferenceNs(color.images, depth.images)) + " s apart",
                (folder / kColorList).string());
  }
  const int paired = static_cast<int>(listing.frames.size());
  listing.statistics = {color.listed,
                        depth.listed,
                        color.duplicates,
                        depth.duplicates,
                        static_cast<int>(color.images.size()) - paired,
                        static_cast<int>(depth.images.size()) - paired};
  return listing;
}

}  // namespace oikos::recording
