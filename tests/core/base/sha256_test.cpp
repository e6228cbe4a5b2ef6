// SPDX-License-Identifier: Apache-2.0
#include "core/base/sha256.h"

#include <gtest/gtest.h>

namespace oikos::base {
namespace {

// FIPS 180-4's own examples.
constexpr const char* kOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kOfNothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr const char* kOfAMillion = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

TEST(Sha256, TheStandardsExamples) {
  Sha256 sum;
  sum.add("abc");
  EXPECT_EQ(sum.finish(), kOfAbc);
  EXPECT_EQ(sum.finish(), kOfNothing);  // it has begun anew
  for (int i = 0; i < 1000; ++i) {
    sum.add(std::string(1000, 'a'));
  }
  EXPECT_EQ(sum.finish(), kOfAMillion);
}

TEST(Sha256, PiecesAreOneContent) {
  Sha256 sum;
  sum.add("a");
  sum.add("");
  sum.add("bc");
  EXPECT_EQ(sum.finish(), kOfAbc);
}

}  // namespace
}  // namespace oikos::base
