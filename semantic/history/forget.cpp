// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/forget.h"

#include <map>
#include <set>
#include <utility>

#include "semantic/history/evidence_folder.h"

namespace oikos::semantic {

namespace {

constexpr std::size_t kBatch = 10000;

bool fits(const ForgetSelection& selection, const Event& event) {
  return (!selection.recording || event.recording == *selection.recording) && (!selection.subject || event.subject == *selection.subject) &&
         (!selection.before_ns || event.time_ns < *selection.before_ns);
}

/// Where one image stands in the log.
struct Image {
  std::int64_t newest_use = 0;
  std::int64_t newest_forgetting = 0;
  bool selected = false;
  std::set<std::string> subjects;  ///< of the events that show it
};

/// By path. Evidence that was forgotten comes out of the log only with the events that say so.
std::map<std::string, Image> imagesOf(const History& history, const ForgetSelection& selection) {
  std::map<std::string, Image> images;
  for (std::int64_t last = 0;;) {
    const std::vector<Event> events = history.eventsAfter(last, kBatch);
    if (events.empty()) {
      return images;
    }
    last = events.back().number;
    for (const Event& event : events) {
      if (event.evidence.empty()) {
        continue;
      }
      Image& image = images[event.evidence];
      if (event.kind == EventKind::kForgotten) {
        image.newest_forgetting = event.number;
        continue;
      }
      image.newest_use = event.number;
      image.subjects.insert(event.subject);
      image.selected = image.selected || fits(selection, event);
    }
  }
}

Event forgottenEvent(const std::string& subject, const std::string& path, std::int64_t now_ns) {
  Event event;
  event.time_ns = now_ns;
  event.subject = subject;
  event.kind = EventKind::kForgotten;
  event.evidence = path;
  return event;
}

struct Plan {
  std::vector<std::string> images;  ///< to be removed
  std::vector<Event> forgotten;     ///< to be committed before
};

Plan planOf(const std::map<std::string, Image>& images, const EvidenceFolder& folder, std::int64_t now_ns, Forgetting& forgetting) {
  Plan plan;
  for (const auto& [path, image] : images) {
    if (!image.selected) {
      if (image.newest_forgetting > image.newest_use) {  // there still if a run was interrupted
        plan.images.push_back(path);
      }
      continue;
    }
    const EvidenceFolder::Image there = folder.look(path);
    if (there == EvidenceFolder::Image::kOther) {
      forgetting.untouched.push_back(path);
      continue;
    }
    if (there == EvidenceFolder::Image::kMissing) {
      forgetting.missing.push_back(path);
    }
    plan.images.push_back(path);
    for (const std::string& subject : image.subjects) {
      plan.forgotten.push_back(forgottenEvent(subject, path, now_ns));
    }
  }
  return plan;
}

}  // namespace

Forgetting forgetEvidence(History& history, const std::filesystem::path& home, const ForgetSelection& selection, std::int64_t now_ns) {
  Forgetting forgetting;
  const EvidenceFolder folder(home);
  const Plan plan = planOf(imagesOf(history, selection), folder, now_ns, forgetting);
  if (!plan.forgotten.empty()) {
    (void)history.append(plan.forgotten);
  }
  for (const std::string& path : plan.images) {
    if (folder.remove(path) == EvidenceFolder::Image::kFile) {
      forgetting.removed.push_back(path);
    }
  }
  return forgetting;
}

}  // namespace oikos::semantic
