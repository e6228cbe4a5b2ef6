// SPDX-License-Identifier: Apache-2.0
//
// OctoMap's writers that take a file name report no full disk, and its non-const `writeBinary` flattens the probabilities of the
// tree it writes: here both formats go through a stream of ours. `writeBinaryConst` prints to stderr when it is done, so the header
// of the .bt is written here, byte for byte as it does.
#include "mapping/volume/octomap_files.h"

#include <locale>
#include <memory>
#include <ostream>

#include "core/base/atomic_file.h"
#include "mapping/volume/octomap_tree.h"

namespace oikos::mapping {

namespace {

void writeMostLikely(const octomap::OcTree& tree, std::ostream& stream) {
  stream << "# Octomap OcTree binary file\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
         << "id " << tree.getTreeType() << "\nsize " << tree.size() << "\nres " << tree.getResolution() << "\ndata\n";
  tree.writeBinaryData(stream);
}

}  // namespace

void writeOctomap(const OccupancyIntegrator& occupancy, const std::filesystem::path& folder) {
  const std::unique_ptr<octomap::OcTree> tree = makeOctomapTree(occupancy);
  base::AtomicFile most_likely(folder / "octomap.bt");
  most_likely.stream().imbue(std::locale::classic());
  writeMostLikely(*tree, most_likely.stream());
  base::AtomicFile full(folder / "octomap.ot");
  full.stream().imbue(std::locale::classic());
  tree->write(full.stream());
  most_likely.commit();
  full.commit();
}

}  // namespace oikos::mapping
