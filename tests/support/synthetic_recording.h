// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

namespace oikos::test {

constexpr int kTinyWidth = 64;
constexpr int kTinyHeight = 48;
constexpr const char* kTinyCamera = "width = 64\nheight = 48\nfx = 50.0\nfy = 50.0\ncx = 31.5\ncy = 23.5\ndepth_scale = 1000.0\n";

/// A colour picture with something to see in it; `seed` makes it another one.
inline cv::Mat tinyColor(int seed) {
  cv::Mat image(kTinyHeight, kTinyWidth, CV_8UC3);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      image.at<cv::Vec3b>(v, u) = {cv::saturate_cast<uchar>(u * 3), cv::saturate_cast<uchar>(v * 4),
                                   cv::saturate_cast<uchar>((u + v + seed) % 100)};
    }
  }
  return image;
}

/// Depth in millimetres, the same everywhere.
inline cv::Mat tinyDepth(int depth_mm) {
  return {kTinyHeight, kTinyWidth, CV_16UC1, cv::Scalar(depth_mm)};
}

inline void append(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::app | std::ios::binary);
  stream << text;
}

/// Frame i: stamp i / 10 s, depth (1000 + i) mm; colour as JPEG, camera.toml beside it.
inline void writeTumRecording(const std::filesystem::path& folder, int frames) {
  std::filesystem::create_directories(folder / "rgb");
  std::filesystem::create_directories(folder / "depth");
  append(folder / "camera.toml", kTinyCamera);
  append(folder / "rgb.txt", "# stamp file\n");
  append(folder / "depth.txt", "# stamp file\n");
  for (int i = 0; i < frames; ++i) {
    const std::string number = std::to_string(i);
    const std::string stamp = std::to_string(i / 10) + "." + std::to_string(i % 10);
    cv::imwrite((folder / "rgb" / (number + ".jpg")).string(), tinyColor(i));
    cv::imwrite((folder / "depth" / (number + ".png")).string(), tinyDepth(1000 + i));
    append(folder / "rgb.txt", stamp + " rgb/" + number + ".jpg\n");
    append(folder / "depth.txt", stamp + "01 depth/" + number + ".png\n");
  }
}

/// Keeps the first bytes of a file only.
inline void truncateFile(const std::filesystem::path& file, double share) {
  const auto size = static_cast<double>(std::filesystem::file_size(file));
  std::filesystem::resize_file(file, static_cast<std::uintmax_t>(size * share));
}

}  // namespace oikos::test
