// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/home_store.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "semantic/history/commit_queue.h"
#include "semantic/history/home_edits.h"
#include "semantic/history/home_lock.h"
#include "semantic/history/home_state.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/home_writer.h"

namespace oikos::semantic {

namespace {

/// home.xml, and what stands in it.
struct HomeFile {
  std::string content;
  Home home;
};

}  // namespace

class HomeStore::Impl {
 public:
  Impl(const std::filesystem::path& folder, std::function<std::int64_t()> now_ns)
      : file_(folder / "home.xml"),
        now_ns_(std::move(now_ns)),
        lock_(folder),
        history_(folder / "history.sqlite", HistoryAccess::kAppend),
        state_(open()),
        queue_([this](const std::vector<CommitQueue::Batch*>& batches) { commit(batches); }) {
    state_.takeNewFrom(history_);
    publish();
  }

  [[nodiscard]] std::shared_ptr<const HomeSnapshot> snapshot() const {
    const std::lock_guard lock(snapshot_mutex_);
    return snapshot_;
  }
  [[nodiscard]] const History& history() const { return history_; }
  [[nodiscard]] Recollection& recollection() { return recollection_; }

  std::int64_t append(std::vector<Event> events) { return queue_.run(std::move(events)); }

  bool refresh() {
    const std::lock_guard lock(state_mutex_);
    const std::int64_t before = state_.home().as_of;
    takeNew();
    if (state_.home().as_of == before) {
      return false;
    }
    publish();
    return true;
  }

  bool reload() {
    const std::lock_guard file_lock(file_mutex_);
    return takeEdits(base::readFile(file_));
  }

  void checkpoint() {
    constexpr int kTries = 5;
    const std::lock_guard file_lock(file_mutex_);
    for (int i = 0; i < kTries; ++i) {
      takeEdits(base::readFile(file_));
      const Home home = snapshot()->home;
      if (home.as_of == file_home_.as_of || write(home)) {
        return;
      }
    }
    throw base::Error(base::ErrorCode::kIo, "another program writes it at this very moment; it is left to that", file_.string());
  }

 private:
  /// What home.xml reads, with the edits since the last checkpoint in the history.
  Home open() {
    HomeFile file;
    file.content = base::readFile(file_);
    file.home = getHome(readHomeText(file.content, file_.string()), file_);
    const std::vector<History::Checkpoint> checkpoints = history_.checkpoints();
    const auto same = std::find_if(checkpoints.begin(), checkpoints.end(),
                                   [&](const History::Checkpoint& checkpoint) { return checkpoint.content == file.content; });
    if (same != checkpoints.end()) {
      file.home.as_of = same->as_of;  // in the file a person may have left anything
      is_newest_checkpoint_ = same == checkpoints.begin();
      file_home_ = file.home;
      known_content_ = file.content;
    } else if (checkpoints.empty()) {
      file.home.as_of = std::min(file.home.as_of, history_.lastNumber());
      remember(file, {});
    } else {
      const History::Checkpoint& edited = editedOne(checkpoints, file.home.as_of);
      Home prior = getHome(readHomeText(edited.content, file_.string()), file_);
      prior.as_of = edited.as_of;
      takeEditsFrom(file, prior);
    }
    return file_home_;
  }

  /// Which of the two was edited: the newer one, unless a crash kept it from ever becoming home.xml.
  static const History::Checkpoint& editedOne(const std::vector<History::Checkpoint>& checkpoints, std::int64_t as_of) {
    const auto found =
        std::find_if(checkpoints.begin(), checkpoints.end(), [&](const auto& checkpoint) { return checkpoint.as_of == as_of; });
    return found == checkpoints.end() ? checkpoints.front() : *found;
  }

  /// False: the file is no longer as it was read.
  bool write(const Home& home) {
    if (!is_newest_checkpoint_) {  // one that never became home.xml would push it out of the history
      const History::Checkpoint current{file_home_.as_of, known_content_};
      history_.append({}, &current);
    }
    History::Checkpoint next{home.as_of, spliceVerified(known_content_, file_home_, home, file_.string())};
    is_newest_checkpoint_ = false;
    history_.append({}, &next);  // first: a crash in between must not look like an edit
    if (!base::replaceFileIfUnchanged(file_, known_content_, next.content)) {
      return false;
    }
    is_newest_checkpoint_ = true;
    known_content_ = std::move(next.content);
    file_home_ = home;
    return true;
  }

  /// Whether there were any.
  bool takeEdits(const std::string& content) {
    if (content == known_content_) {
      return false;
    }
    HomeFile file{content, getHome(readHomeText(content, file_.string()), file_)};
    const std::lock_guard lock(state_mutex_);
    const Home prior = file_home_;
    takeEditsFrom(file, prior);
    state_ = HomeState(file_home_);
    state_.takeNewFrom(history_);
    recollection_.clear();
    ++structure_;
    publish();
    return true;
  }

  void takeEditsFrom(HomeFile& file, const Home& prior) {
    file.home.as_of = prior.as_of;  // whatever the person left there
    remember(file, editsBetween(prior, file.home, now_ns_()));
  }

  void remember(HomeFile& file, const std::vector<Event>& edits) {
    const History::Checkpoint checkpoint{file.home.as_of, file.content};
    history_.append(edits, &checkpoint);
    is_newest_checkpoint_ = true;
    file_home_ = std::move(file.home);
    known_content_ = std::move(file.content);
  }

  void commit(const std::vector<CommitQueue::Batch*>& batches) {
    const std::lock_guard lock(state_mutex_);
    std::map<std::string, State> changed;  // by the events before it that are to be committed with it
    std::vector<Event> together;
    for (CommitQueue::Batch* batch : batches) {
      try {
        prepareForCommit(batch->events, state_, changed);
        together.insert(together.end(), batch->events.begin(), batch->events.end());
      } catch (const base::Error&) {
        batch->failure = std::current_exception();
      }
    }
    if (together.empty()) {
      return;
    }
    std::int64_t number = history_.append(together) - static_cast<std::int64_t>(together.size());
    for (std::size_t i = 0; i < together.size(); ++i) {
      together[i].number = number + static_cast<std::int64_t>(i) + 1;
    }
    takeCommitted(together, number);
    for (CommitQueue::Batch* batch : batches) {
      if (!batch->failure) {
        number += static_cast<std::int64_t>(batch->events.size());
        batch->last_number = number;
      }
    }
    publish();
  }

  void takeCommitted(const std::vector<Event>& events, std::int64_t number_before) {
    if (number_before != state_.home().as_of) {
      takeNew();  // another process has committed something in between
      return;
    }
    for (const Event& event : events) {
      state_.apply(event, history_);
      recollection_.take(event);
    }
    state_.setAsOf(number_before + static_cast<std::int64_t>(events.size()));
  }

  void takeNew() {
    state_.takeNewFrom(history_, [this](const Event& event) { recollection_.take(event); });
  }

  void publish() {
    auto next = std::make_shared<const HomeSnapshot>(HomeSnapshot{state_.home(), structure_});
    const std::lock_guard lock(snapshot_mutex_);
    snapshot_.swap(next);
  }

  const std::filesystem::path file_;
  const std::function<std::int64_t()> now_ns_;
  const HomeLock lock_;
  History history_;
  Recollection recollection_{history_};

  std::mutex file_mutex_;  // taken before state_mutex_; of home.xml and:
  std::string known_content_;
  Home file_home_;                     // what known_content_ reads
  bool is_newest_checkpoint_ = false;  // of the history

  std::mutex state_mutex_;  // of:
  HomeState state_;
  std::int64_t structure_ = 0;

  mutable std::mutex snapshot_mutex_;
  std::shared_ptr<const HomeSnapshot> snapshot_;

  CommitQueue queue_;
};

HomeStore::HomeStore(const std::filesystem::path& folder, std::function<std::int64_t()> now_ns)
    : impl_(std::make_unique<Impl>(folder, std::move(now_ns))) {}

HomeStore::~HomeStore() = default;

std::shared_ptr<const HomeSnapshot> HomeStore::snapshot() const {
  return impl_->snapshot();
}

const History& HomeStore::history() const {
  return impl_->history();
}

Recollection& HomeStore::recollection() const {
  return impl_->recollection();
}

std::int64_t HomeStore::append(std::vector<Event> events) {
  return impl_->append(std::move(events));
}

bool HomeStore::refresh() {
  return impl_->refresh();
}

bool HomeStore::reload() {
  return impl_->reload();
}

void HomeStore::checkpoint() {
  impl_->checkpoint();
}

}  // namespace oikos::semantic
