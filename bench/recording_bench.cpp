// SPDX-License-Identifier: Apache-2.0
// What reading one frame of a recording costs, step by step, on one thread: milliseconds of processor time, mean over the frames.
//   recording_bench [RECORDING [CAMERA]]
// The recording is OIKOS_DATA/kitchen if none is given.
#include <time.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "core/camera/calibration.h"
#include "core/camera/depth_registration.h"
#include "core/camera/rectifier.h"
#include "core/recording/image_file.h"
#include "core/recording/listing.h"
#include "core/recording/recording.h"

namespace {

using namespace oikos;

/// Processor time of this thread, so that other programs on the machine count little.
double threadMs() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double meanMs(const std::vector<recording::ListedFrame>& frames, const std::function<void(const recording::ListedFrame&)>& step) {
  const double begin_ms = threadMs();
  for (const auto& frame : frames) {
    step(frame);
  }
  return (threadMs() - begin_ms) / static_cast<double>(frames.size());
}

void printRow(const char* step, double ms) {
  std::printf("%-32s %7.2f\n", step, ms);
}

void run(const std::string& folder, const std::string& camera_name) {
  const auto calibration = camera::getCalibration(camera_name.empty() ? folder + "/camera.toml" : camera_name);
  const auto listing =
      recording::looksLikeTum(folder) ? recording::listTum(folder, 20'000'000) : recording::listSevenScenes(folder, calibration.rate_hz);
  const camera::Rectifier rectifier(calibration.color, calibration.distortion);
  const camera::DepthRegistration registration(calibration, rectifier);
  const auto& frames = listing.frames;
  const cv::Mat gray = recording::readGrayImage(frames.front().color);
  const cv::Mat depth = recording::readDepthImage(frames.front().depth);

  std::printf("%s: %zu frames, one thread\n%-32s %7s\n", folder.c_str(), frames.size(), "step", "ms");
  printRow("colour file to grey", meanMs(frames, [](const auto& f) { (void)recording::readGrayImage(f.color); }));
  printRow("colour file to BGR", meanMs(frames, [](const auto& f) { (void)recording::readColorImage(f.color); }));
  printRow("depth file to 16 bit", meanMs(frames, [](const auto& f) { (void)recording::readDepthImage(f.depth); }));
  printRow("rectify grey", meanMs(frames, [&](const auto&) { (void)rectifier.rectifyColor(gray); }));
  printRow("depth to metres and colour", meanMs(frames, [&](const auto&) { (void)registration.toMetres(depth); }));
  const auto recorded = recording::openRecording(folder, {camera_name, 0.02});
  int index = 0;
  printRow("whole frame, grey", meanMs(frames, [&](const auto&) { (void)recorded->read(index++, recording::Channels::kGray); }));
  index = 0;
  printRow("whole frame, grey and colour",
           meanMs(frames, [&](const auto&) { (void)recorded->read(index++, recording::Channels::kColor); }));
}

}  // namespace

int main(int argc, char** argv) {
  const char* const data = std::getenv("OIKOS_DATA");
  const std::string folder = argc > 1 ? argv[1] : data != nullptr ? std::string(data) + "/kitchen" : "";
  if (argc < 2 && !std::filesystem::is_directory(folder)) {
    std::printf("SKIPPED: recording_bench needs a recording, or OIKOS_DATA with kitchen in it\n");
    return 0;
  }
  try {
    cv::setNumThreads(1);
    run(folder, argc > 2 ? argv[2] : "");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  return 0;
}
