// SPDX-License-Identifier: Apache-2.0
//
// OctoMap's writers that take a file name report no full disk, and its non-const `writeBinary` flattens the probabilities of the
// tree it writes: here both formats go through a stream of ours, and `writeBinaryConst` is used.
#include "mapping/volume/octomap_files.h"

#include <locale>
#include <memory>

#include "core/base/atomic_file.h"
#include "mapping/volume/octomap_tree.h"

namespace oikos::mapping {

void writeOctomap(const OccupancyIntegrator& occupancy, const std::filesystem::path& folder) {
  const std::unique_ptr<octomap::OcTree> tree = makeOctomapTree(occupancy);
  base::AtomicFile most_likely(folder / "octomap.bt");
  most_likely.stream().imbue(std::locale::classic());
  tree->writeBinaryConst(most_likely.stream());
  base::AtomicFile full(folder / "octomap.ot");
  full.stream().imbue(std::locale::classic());
  tree->write(full.stream());
  most_likely.commit();
  full.commit();
}

}  // namespace oikos::mapping
