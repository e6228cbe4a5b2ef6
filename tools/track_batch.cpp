// SPDX-License-Identifier: Apache-2.0
#include "tools/track_batch.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <mutex>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/recording/content_digest.h"
#include "core/recording/image_codec.h"
#include "semantic/history/home_state.h"
#include "semantic/history/home_store.h"
#include "tools/interrupts.h"
#include "tools/locate_job.h"
#include "tools/terminal_progress.h"
#include "tracking/objects/missed_events.h"

namespace oikos::tools {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::int64_t kUnixFrom_ns = 1'000'000'000LL * 1'000'000'000LL;  // stamps above are times of the day, not of the recording
constexpr int kEvidenceQuality = 85;

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::int64_t startOf(const recording::Recording& recording, const TrackTask& task, const fs::path& folder) {
  if (const auto start_ns = recording.startNs()) {
    return *start_ns;
  }
  if (task.start_ns) {
    return *task.start_ns;
  }
  if (recording.frameCount() > 0 && recording.stampNs(0) >= kUnixFrom_ns) {
    return 0;
  }
  throw base::Error(base::ErrorCode::kInput,
                    "when it was made is not known: put start = \"2026-03-02T08:00:00Z\" into camera.toml, or give --start",
                    folder.string());
}

/// A recording on its way through the batch.
struct Job {
  TrackedRecording result;
  std::unique_ptr<recording::Recording> recording;
  std::int64_t time_ns = std::numeric_limits<std::int64_t>::max();  ///< of its first frame
  std::int64_t last_ns = 0;                                         ///< and of its last one
  bool is_read = false;
};

void fail(Job& job, const std::exception& error) {
  const auto* const known = dynamic_cast<const base::Error*>(&error);
  job.result.status = TrackStatus::kFailed;
  job.result.problem = error.what();
  job.result.code = known != nullptr ? static_cast<ExitCode>(known->code()) : ExitCode::kInternal;
}

/// `monday`, or, if that is the name of another recording in the history, `monday-1f3a9c2e`.
std::string nameOf(const Job& job, const std::vector<std::string>& taken) {
  const fs::path folder = fs::absolute(job.result.folder).lexically_normal();
  const std::string own = (folder.filename().empty() ? folder.parent_path() : folder).filename().string();
  return std::find(taken.begin(), taken.end(), own) == taken.end() ? own : own + "-" + job.result.digest.substr(0, 8);
}

class Batch {
 public:
  Batch(const TrackTask& task, const Session& session, const std::function<void(const TrackedRecording&)>& done)
      : task_(task), session_(session), done_(done), progress_(session.options), changes_(task.home / "map", task.config.changes) {
    takeEdits();
    home_ = semantic::loadHome(task.home);
    history_ = std::make_unique<semantic::History>(task.home / "history.sqlite",
                                                   task.is_dry ? semantic::HistoryAccess::kRead : semantic::HistoryAccess::kAppend);
    for (const fs::path& folder : task.recordings) {
      open(folder);
    }
    std::stable_sort(jobs_.begin(), jobs_.end(), [](const auto& a, const auto& b) { return a->time_ns < b->time_ns; });
  }

  TrackOutcome run() {
    base::parallelFor(static_cast<int>(jobs_.size()), task_.jobs, [&](int i) {
      Job& job = *jobs_[static_cast<std::size_t>(i)];
      if (job.result.problem.empty()) {
        guarded(job, [&] { read(job); });
      }
      foldThoseThatAreDue(job);
    });
    for (const auto& job : jobs_) {
      outcome_.recordings.push_back(std::move(job->result));
    }
    return std::move(outcome_);
  }

 private:
  template <class Step>
  static void guarded(Job& job, const Step& step) {
    try {
      step();
    } catch (const std::exception& error) {
      fail(job, error);
    }
  }

  /// What a person changed in home.xml counts before what the recordings say.
  void takeEdits() const {
    if (!task_.is_dry && fs::exists(task_.home / "history.sqlite")) {
      try {
        const semantic::HomeStore store(task_.home, now_ns);
      } catch (const base::Error& error) {
        if (error.code() != base::ErrorCode::kIo) {
          throw;
        }  // another process keeps the home, and takes them up
      }
    }
  }

  void open(const fs::path& folder) {
    auto job = std::make_unique<Job>();
    job->result.folder = folder;
    guarded(*job, [&] {
      job->recording = recording::openRecording(folder, {.camera = task_.camera});
      job->result.start_ns = startOf(*job->recording, task_, folder);
      if (job->recording->frameCount() == 0) {
        throw base::Error(base::ErrorCode::kInput, "has no frames", folder.string());
      }
      job->time_ns = job->result.start_ns + job->recording->stampNs(0);
      job->last_ns = job->result.start_ns + job->recording->stampNs(job->recording->frameCount() - 1);
    });
    jobs_.push_back(std::move(job));
  }

  void read(Job& job) {
    TrackedRecording& result = job.result;
    if (!task_.is_dry) {
      result.digest = recording::contentDigest(result.folder);
      if (const auto before = history_->findReadRecording(result.digest)) {
        result.name = before->recording;
        if (before->counts) {
          result.status = TrackStatus::kKnown;
          return;
        }
      }
    }
    const auto begin = Clock::now();
    const int threads = std::max(1, session_.options.threads / task_.jobs);
    LocateJob locate{*job.recording, task_.home, task_.config.locate, mountOf(task_.mount, *job.recording), task_.prior, task_.from};
    locate.config.landmarks.align.threads = threads;
    locate.known = &home_;
    locate.seed = session_.options.seed;
    const LocateWorkshop workshop(locate);
    tracking::Localiser localiser = workshop.makeLocaliser();
    tracking::StateConfig states = task_.config.states;
    double& distortion = states.registration.solver.depth_distortion;
    distortion = std::max(distortion, job.recording->depthDistortion());
    tracking::StateReader reader(home_, task_.home, job.recording->camera(), states, threads, task_.object);
    result.opening_s = std::chrono::duration<double>(Clock::now() - begin).count();
    const tracking::StateTools tools{home_,  task_.home, localiser,    reader,
                                     states, threads,    task_.object, task_.jobs == 1 ? progress_.sink() : base::ProgressSink()};
    result.states = tracking::readStates(*job.recording, tools);
    if (task_.has_changes && result.states.found > 0) {
      const auto read = Clock::now();
      result.changes = changes_.find(*job.recording, result.states, tools);
      result.comparing_s = std::chrono::duration<double>(Clock::now() - read).count();
    }
    result.status = result.states.found > 0 ? TrackStatus::kTracked : TrackStatus::kNotFound;
  }

  /// A recording is folded in when all that were made before it are.
  void foldThoseThatAreDue(Job& job) {
    const std::lock_guard lock(fold_mutex_);
    job.is_read = true;
    for (; next_ < jobs_.size() && jobs_[next_]->is_read; ++next_) {
      Job& due = *jobs_[next_];
      if (due.result.status == TrackStatus::kTracked) {
        guarded(due, [&] { fold(due); });
      }
      due.recording.reset();
      done_(due.result);
    }
  }

  void fold(Job& job) {
    TrackedRecording& result = job.result;
    if (result.name.empty()) {
      result.name = nameOf(job, history_->recordings());
    }
    const semantic::Home current = semantic::loadHome(task_.home);
    semantic::HomeState believed(semantic::homeAt(current, *history_, job.time_ns));
    for (const semantic::Event& event : dry_events_) {  // a miss says where it is believed to be: nothing new
      believed.set(event.subject, *event.after);
    }
    result.events = tracking::stateEvents(result.states, believed.home(), {result.name, result.start_ns}, task_.config.states);
    std::erase_if(result.events, [&](const tracking::StateEvent& event) { return isMissedAlready(event.event); });
    if (task_.is_dry) {
      for (const tracking::StateEvent& event : result.events) {
        dry_events_.push_back(event.event);
      }
      return;
    }
    session_.interrupts.runUninterrupted([&] { commit(job, semantic::HomeState(current)); },
                                         "interrupted; what was folded in stays, and the rest is tracked when the command is given again");
  }

  /// It was missed at that place before, and nothing was heard of it since.
  [[nodiscard]] bool isMissedAlready(const semantic::Event& event) const {
    if (event.kind != semantic::EventKind::kMissed) {
      return false;
    }
    return tracking::isKnown(event, *history_) || std::any_of(dry_events_.begin(), dry_events_.end(), [&](const semantic::Event& one) {
             return one.subject == event.subject && one.kind == event.kind && one.after == event.after;
           });
  }

  /// Pictures first: an event's evidence is there when the event is.
  void commit(Job& job, const semantic::HomeState& state) {
    TrackedRecording& result = job.result;
    std::vector<semantic::Event> events;
    for (tracking::StateEvent& event : result.events) {
      event.event.evidence = writeEvidence(job, {event.event.subject, event.evidence_frame, *event.event.frame, event.crop});
      events.push_back(event.event);
    }
    for (std::size_t i = 0; i < result.changes.size(); ++i) {
      const tracking::ChangeBox& box = result.changes[i];
      result.pictures.push_back(writeEvidence(job, {"change-" + std::to_string(i + 1), box.frame, box.frame, box.crop}));
    }
    std::map<std::string, semantic::State> changed;
    semantic::prepareForCommit(events, state, changed);
    const auto last = history_->appendRecording({result.digest, result.name, job.time_ns, job.last_ns}, events);
    if (!last) {  // another process was quicker
      result.status = TrackStatus::kKnown;
      result.events.clear();
      return;
    }
    for (std::size_t i = 0; i < events.size(); ++i) {
      result.events[i].event = events[i];
      result.events[i].event.number = *last - static_cast<std::int64_t>(events.size() - 1 - i);
    }
    if (!events.empty()) {
      checkpoint();
    }
  }

  struct Picture {
    std::string subject;
    int frame = 0;           ///< that is shown,
    std::int64_t named = 0;  ///< and that it is named after
    registration::PixelBox box;
  };
  std::string writeEvidence(const Job& job, const Picture& picture) const {
    const registration::PixelBox& box = picture.box;
    const cv::Mat color = job.recording->read(picture.frame, recording::Channels::kColor).color;
    const cv::Rect crop = cv::Rect(cv::Point(box.left, box.top), cv::Point(box.right, box.bottom)) & cv::Rect(cv::Point(), color.size());
    const std::vector<unsigned char> jpeg = recording::encodeJpeg((crop.empty() ? color : color(crop)).clone(), kEvidenceQuality);
    const std::string path = "evidence/" + job.result.name + "/" + picture.subject + "-" + std::to_string(picture.named) + ".jpg";
    fs::create_directories((task_.home / path).parent_path());
    base::writeFileAtomically(task_.home / path, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
    return path;
  }

  /// The events count already: whoever keeps the home writes them into home.xml.
  void checkpoint() {
    try {
      semantic::HomeStore(task_.home, now_ns).checkpoint();
      outcome_.checkpoint_problem.clear();
    } catch (const base::Error& error) {
      outcome_.checkpoint_problem = error.what();
    }
  }

  const TrackTask& task_;
  const Session& session_;
  const std::function<void(const TrackedRecording&)>& done_;
  TerminalProgress progress_;
  ChangeWatch changes_;
  semantic::Home home_;  ///< as it was at the batch's start: what all recordings see
  std::unique_ptr<semantic::History> history_;
  std::vector<std::unique_ptr<Job>> jobs_;  ///< in the order of time

  std::mutex fold_mutex_;  ///< of what follows
  std::size_t next_ = 0;
  std::vector<semantic::Event> dry_events_;
  TrackOutcome outcome_;
};

}  // namespace

TrackOutcome trackRecordings(const TrackTask& task, const Session& session, const std::function<void(const TrackedRecording&)>& done) {
  return Batch(task, session, done).run();
}

}  // namespace oikos::tools
