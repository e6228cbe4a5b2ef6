// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/keyframe_images.h"

#include <gtest/gtest.h>

#include <atomic>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <thread>
#include <vector>

namespace oikos::mapping {
namespace {

constexpr int kLevels = 2;

cv::Mat imageOf(int frame) {
  return {48, 64, CV_8UC1, cv::Scalar(frame % 256)};
}

int greyOf(const ImagePyramid& pyramid) {
  return pyramid.level(0).at<unsigned char>(0, 0);
}

std::shared_ptr<const ImagePyramid> pyramidOf(int frame) {
  return std::make_shared<const ImagePyramid>(imageOf(frame), kLevels);
}

/// Counts what is read again.
struct CountingLoader {
  std::vector<int> loaded;
  KeyframeImages::Loader loader() {
    return [this](int frame) {
      loaded.push_back(frame);
      return imageOf(frame);
    };
  }
};

TEST(KeyframeImages, WhatWasPutIsNotReadAgain) {
  CountingLoader files;
  KeyframeImages images(files.loader(), kLevels, 3);
  const auto pyramid = pyramidOf(7);
  images.put(7, pyramid);
  EXPECT_EQ(images.get(7), pyramid);
  EXPECT_TRUE(files.loaded.empty());
}

TEST(KeyframeImages, TheLeastRecentlyUsedIsLetGoAndReadAgain) {
  CountingLoader files;
  KeyframeImages images(files.loader(), kLevels, 3);
  for (const int frame : {1, 2, 3}) {
    images.put(frame, pyramidOf(frame));
  }
  EXPECT_EQ(greyOf(*images.get(1)), 1);  // now 2 is the oldest
  images.put(4, pyramidOf(4));
  for (const int frame : {1, 3, 4}) {
    EXPECT_EQ(greyOf(*images.get(frame)), frame);
  }
  EXPECT_TRUE(files.loaded.empty());
  const auto again = images.get(2);
  EXPECT_EQ(files.loaded, std::vector<int>{2});
  EXPECT_EQ(greyOf(*again), 2);
  EXPECT_EQ(again->levels(), kLevels);
}

TEST(KeyframeImages, AnImageThatSomebodyHoldsOutlivesItsPlace) {
  CountingLoader files;
  KeyframeImages images(files.loader(), kLevels, 1);
  images.put(5, pyramidOf(5));
  const auto held = images.get(5);
  const std::weak_ptr<const ImagePyramid> watched = images.get(6);
  EXPECT_EQ(greyOf(*held), 5);
  images.put(8, pyramidOf(8));
  EXPECT_TRUE(watched.expired());  // nobody held this one
}

TEST(KeyframeImages, PutReplacesAndFillsNoSecondPlace) {
  CountingLoader files;
  KeyframeImages images(files.loader(), kLevels, 2);
  images.put(1, pyramidOf(1));
  images.put(2, pyramidOf(2));
  images.put(2, pyramidOf(20));
  EXPECT_EQ(greyOf(*images.get(2)), 20);
  EXPECT_EQ(greyOf(*images.get(1)), 1);
  EXPECT_TRUE(files.loaded.empty());
}

TEST(KeyframeImages, AnErrorOfTheRecordingReachesTheCallerAndIsNotRemembered) {
  bool broken = true;
  KeyframeImages images(
      [&](int frame) {
        if (broken) {
          throw std::runtime_error("frame cannot be read");
        }
        return imageOf(frame);
      },
      kLevels, 2);
  EXPECT_THROW(static_cast<void>(images.get(3)), std::runtime_error);
  broken = false;
  EXPECT_EQ(greyOf(*images.get(3)), 3);
}

TEST(KeyframeImages, ManyThreadsGetWhatTheyAskFor) {
  std::atomic<int> wrong = 0;
  KeyframeImages images([](int frame) { return imageOf(frame); }, kLevels, 4);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 400; ++i) {
        const int frame = (i * (2 * t + 1)) % 13;
        if (i % 5 == 0) {
          images.put(frame, pyramidOf(frame));
        }
        wrong += greyOf(*images.get(frame)) == frame ? 0 : 1;
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace oikos::mapping
