// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <mutex>

#include "mapping/extend/earlier_map.h"
#include "mapping/extend/gone_space.h"
#include "mapping/graph/front_end.h"
#include "mapping/graph/keyframe_store.h"
#include "mapping/volume/map_builder.h"

namespace oikos::mapping {

/// Writes `keyframes.sqlite` while the keyframes go through the fusion.
class KeyframeSaver {
 public:
  /// What is saved of a keyframe beside its pictures; all of it outlives the saver.
  struct Sources {
    const FrontEndResult& drive;
    const EarlierMap* earlier;  ///< may be null; its keyframes' pictures are taken over without loss
    const GoneSpace& gone;      ///< what earlier keyframes saw in there is not saved any more
  };

  KeyframeSaver(const std::filesystem::path& file, const camera::PinholeCamera& camera, const Sources& sources);

  [[nodiscard]] ViewObserver observer();
  void commit() { store_.commit(); }

 private:
  void prepare(const camera::RgbdFrame& frame);
  void add(const camera::RgbdFrame& frame);
  [[nodiscard]] EncodedPictures picturesOf(int node, const camera::RgbdFrame& frame) const;
  [[nodiscard]] StoredKeyframe toStored(int node) const;
  void dropGone(StoredKeyframe& keyframe) const;

  Sources sources_;
  camera::PinholeCamera camera_;
  KeyframeStoreWriter store_;
  std::map<int, int> node_of_frame_;
  std::mutex mutex_;
  std::map<int, EncodedPictures> pictures_;  ///< by frame, until they are written
};

}  // namespace oikos::mapping
