// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/base/parallel.h"
#include "mapping/volume/map_builder.h"

namespace oikos::mapping {

/// Goes through the views a few at a time: `prepare` runs for each on any thread, then `use` for the whole batch in order. `stage`: what
/// progress says.
template <class Item>
void forEachBatch(const std::vector<View>& views, const FusionInput& input, const char* stage,
                  const std::function<Item(const View&)>& prepare, const std::function<void(std::vector<Item>&)>& use) {
  const int batch = 2 * std::max(1, input.threads);
  for (int begin = 0; begin < static_cast<int>(views.size()); begin += batch) {
    std::vector<Item> items(static_cast<std::size_t>(std::min(batch, static_cast<int>(views.size()) - begin)));
    base::parallelFor(static_cast<int>(items.size()), input.threads, [&](int i) {
      items[static_cast<std::size_t>(i)] = prepare(views[static_cast<std::size_t>(begin) + static_cast<std::size_t>(i)]);
    });
    use(items);
    base::reportProgress(input.progress, {stage, begin + static_cast<int>(items.size()), static_cast<int>(views.size())});
  }
}

}  // namespace oikos::mapping
