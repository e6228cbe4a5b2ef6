// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "semantic/history/home_store.h"
#include "semantic/query/home_index.h"

namespace oikos::daemon {

/// A home at one moment, with the index to find things in it. Immutable.
struct HomeView {
  explicit HomeView(std::shared_ptr<const semantic::HomeSnapshot> home) : snapshot(std::move(home)), index(homeOf(snapshot)) {}
  /// Where nothing but states has changed since `earlier`: with its words, which is much faster.
  HomeView(std::shared_ptr<const semantic::HomeSnapshot> home, const HomeView& earlier)
      : snapshot(std::move(home)),
        index(snapshot->structure == earlier.snapshot->structure ? semantic::HomeIndex(earlier.index, homeOf(snapshot))
                                                                 : semantic::HomeIndex(homeOf(snapshot))) {}

  std::shared_ptr<const semantic::HomeSnapshot> snapshot;
  semantic::HomeIndex index;

 private:
  static std::shared_ptr<const semantic::Home> homeOf(const std::shared_ptr<const semantic::HomeSnapshot>& snapshot) {
    return {snapshot, &snapshot->home};
  }
};

struct ServiceConfig {
  std::chrono::milliseconds refresh{250};    ///< between looks for what other processes have committed
  std::chrono::milliseconds index_gap{100};  ///< between two indexes of a home that takes long to index
  std::chrono::milliseconds quick_index{1};  ///< a home indexed faster than this is never served old
  std::chrono::milliseconds checkpoint{60'000};
};

/// The home that is served: readers get an immutable view, writers commit, and two threads keep the view fresh and home.xml written. All
/// methods are thread-safe.
class Service {
 public:
  struct Hooks {
    std::function<std::int64_t()> now_ns;
    std::function<void(const std::string&)> report;  ///< a line for the operator
  };

  /// Takes the home's lock. Throws Error.
  Service(const std::filesystem::path& folder, Hooks hooks, const ServiceConfig& config = {});
  ~Service();  ///< without a checkpoint
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  /// Every event that was committed when the call began, if the home is indexed quickly; else at most as old as an index takes.
  [[nodiscard]] std::shared_ptr<const HomeView> view();
  /// With every event that was committed when the call began, however long an index takes.
  [[nodiscard]] std::shared_ptr<const semantic::HomeSnapshot> snapshot() const { return store_.snapshot(); }
  [[nodiscard]] const semantic::History& history() const { return store_.history(); }
  [[nodiscard]] semantic::Recollection& recollection() const { return store_.recollection(); }
  [[nodiscard]] std::int64_t now_ns() const { return hooks_.now_ns(); }

  /// As HomeStore's.
  std::int64_t append(std::vector<semantic::Event> events);
  /// Reads home.xml again. An invalid one is reported and refused; returns whether it was taken.
  bool reload();
  /// Stops the threads and writes home.xml. Throws Error.
  void close();

  /// What to call, from any thread, when there are new events.
  void onEvents(std::function<void()> listener);
  /// Why the home cannot be kept at the moment; empty: it can.
  [[nodiscard]] std::string problem() const;

  [[nodiscard]] std::int64_t indexBuilds() const { return index_builds_; }
  [[nodiscard]] std::int64_t checkpoints() const { return checkpoints_; }
  [[nodiscard]] std::int64_t checkpointFailures() const { return checkpoint_failures_; }

 private:
  void keepFresh();
  void keepWritten();
  void refresh();
  [[nodiscard]] std::chrono::milliseconds indexGap() const;
  void tell(std::int64_t last_event);
  void index(const std::shared_ptr<const semantic::HomeSnapshot>& snapshot);
  bool pause(std::unique_lock<std::mutex>& lock, std::chrono::milliseconds time, bool until_changed);
  void changed();
  void stop();
  void setProblem(std::string problem);

  const Hooks hooks_;
  const ServiceConfig config_;
  semantic::HomeStore store_;

  mutable std::mutex view_mutex_;  ///< of view_, which is read and exchanged under it
  std::shared_ptr<const HomeView> view_;
  std::mutex index_mutex_;  ///< one index at a time
  std::atomic<std::int64_t> index_took_ns_ = 0;

  mutable std::mutex mutex_;  ///< of what follows
  std::condition_variable wake_;
  bool stopping_ = false;
  bool changed_ = false;
  std::function<void()> listener_;
  std::int64_t told_ = -1;  ///< number of the last event that the listener knows of
  std::string problem_;

  std::atomic<std::int64_t> index_builds_ = 0;
  std::atomic<std::int64_t> checkpoints_ = 0;
  std::atomic<std::int64_t> checkpoint_failures_ = 0;
  std::thread freshener_;
  std::thread writer_;
};

}  // namespace oikos::daemon
