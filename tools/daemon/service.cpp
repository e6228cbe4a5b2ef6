// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/service.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"

namespace oikos::daemon {

namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

Service::Service(const std::filesystem::path& folder, Hooks hooks, const ServiceConfig& config)
    : hooks_(std::move(hooks)), config_(config), store_(folder, hooks_.now_ns) {
  index(store_.snapshot());
  freshener_ = std::thread([this] { keepFresh(); });
  writer_ = std::thread([this] { keepWritten(); });
}

Service::~Service() {
  stop();
}

std::shared_ptr<const HomeView> Service::view() {
  const auto current = [this] {
    const std::lock_guard lock(view_mutex_);
    return view_;
  };
  std::shared_ptr<const HomeView> view = current();
  const std::shared_ptr<const semantic::HomeSnapshot> snapshot = store_.snapshot();
  if (view->snapshot == snapshot || index_took_ns_ > std::chrono::nanoseconds(config_.quick_index).count()) {
    return view;
  }
  index(snapshot);
  return current();
}

std::int64_t Service::append(std::vector<semantic::Event> events) {
  const std::int64_t number = store_.append(std::move(events));
  changed();
  return number;
}

bool Service::reload() {
  try {
    store_.reload();
  } catch (const base::Error& error) {
    hooks_.report(std::string("home.xml was not taken, the home goes on as it was: ") + error.what());
    return false;
  }
  changed();
  hooks_.report("home.xml was read again");
  return true;
}

void Service::close() {
  stop();
  store_.checkpoint();
}

void Service::onEvents(std::function<void()> listener) {
  const std::lock_guard lock(mutex_);
  listener_ = std::move(listener);
}

std::string Service::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

/// What comes while an index is being made is gathered for the next.
void Service::keepFresh() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    pause(lock, config_.refresh, true);
    changed_ = false;
    lock.unlock();
    refresh();
    lock.lock();
    pause(lock, indexGap(), false);
  }
}

/// An index never takes more than half of a core.
std::chrono::milliseconds Service::indexGap() const {
  const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::nanoseconds(index_took_ns_));
  return took < config_.quick_index ? std::chrono::milliseconds(1) : std::max(config_.index_gap, took);
}

void Service::refresh() {
  try {
    store_.refresh();
    setProblem({});
  } catch (const base::Error& error) {
    setProblem(error.what());
  }
  const std::shared_ptr<const semantic::HomeSnapshot> snapshot = store_.snapshot();
  tell(snapshot->home.as_of);
  index(snapshot);
}

void Service::tell(std::int64_t last_event) {
  std::function<void()> listener;
  {
    const std::lock_guard lock(mutex_);
    if (told_ == last_event) {
      return;
    }
    told_ = last_event;
    listener = listener_;
  }
  if (listener) {
    listener();
  }
}

void Service::index(const std::shared_ptr<const semantic::HomeSnapshot>& snapshot) {
  const std::lock_guard one_at_a_time(index_mutex_);
  std::shared_ptr<const HomeView> earlier;
  {
    const std::lock_guard lock(view_mutex_);
    earlier = view_;
    if (view_ && view_->snapshot->home.as_of >= snapshot->home.as_of && view_->snapshot->structure >= snapshot->structure) {
      return;
    }
  }
  const Clock::time_point start = Clock::now();
  auto view = earlier ? std::make_shared<const HomeView>(snapshot, *earlier) : std::make_shared<const HomeView>(snapshot);
  index_took_ns_ = std::chrono::nanoseconds(Clock::now() - start).count();
  ++index_builds_;
  const std::lock_guard lock(view_mutex_);
  view_.swap(view);
}

void Service::keepWritten() {
  std::unique_lock lock(mutex_);
  while (!pause(lock, config_.checkpoint, false)) {
    lock.unlock();
    try {
      store_.checkpoint();
      ++checkpoints_;
    } catch (const base::Error& error) {
      ++checkpoint_failures_;
      hooks_.report(std::string("home.xml could not be written, its history is complete: ") + error.what());
    }
    lock.lock();
  }
}

/// Returns whether the service stops.
bool Service::pause(std::unique_lock<std::mutex>& lock, std::chrono::milliseconds time, bool until_changed) {
  wake_.wait_for(lock, time, [&] { return stopping_ || (until_changed && changed_); });
  return stopping_;
}

void Service::changed() {
  {
    const std::lock_guard lock(mutex_);
    if (changed_) {
      return;
    }
    changed_ = true;
  }
  wake_.notify_all();
}

void Service::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    listener_ = nullptr;
  }
  wake_.notify_all();
  for (std::thread* const thread : {&freshener_, &writer_}) {
    if (thread->joinable()) {
      thread->join();
    }
  }
}

void Service::setProblem(std::string problem) {
  const bool is_new = !problem.empty() && problem != this->problem();
  if (is_new) {
    hooks_.report("the history cannot be read: " + problem);
  }
  const std::lock_guard lock(mutex_);
  problem_ = std::move(problem);
}

}  // namespace oikos::daemon
