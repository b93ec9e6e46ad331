#include "viewer/window/dataset_loader.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "scenegraph/thread_priority.h"

namespace stillframe::viewer {

using scenegraph::Status;
using scenegraph::StatusLevel;

/// One open() on its way. The worker writes under the mutex and asks the gate for a collect().
struct DatasetLoader::Job {
  std::function<void()> notify;
  std::atomic<bool> is_cancelled = false;
  std::atomic<double> fraction = 0.0;
  std::atomic<bool> is_finished = false;
  std::mutex mutex;  // guards dataset and error
  std::shared_ptr<scenegraph::Dataset> dataset;
  std::optional<Status> error;
  bool is_announced = false;    // GUI thread
  bool is_done = false;         // GUI thread: finished, and everything was told
  double told_fraction = -1.0;  // GUI thread
  std::thread thread;
};

DatasetLoader::DatasetLoader(RecordingOpener opener, QObject* parent)
    : QObject(parent), opener_(std::move(opener)), gate_([this] { collect(); }) {}

DatasetLoader::~DatasetLoader() {
  for (const auto& job : jobs_) {
    job->is_cancelled = true;
  }
  for (const auto& job : jobs_) {
    job->thread.join();
  }
}

void DatasetLoader::open(std::vector<std::filesystem::path> files) {
  // An older candidate that has not proved itself yet is dropped; the recording on show goes on loading.
  for (const auto& job : jobs_) {
    if (job.get() != current_) {
      job->is_cancelled = true;
    }
  }
  auto job = std::make_unique<Job>();
  job->notify = gate_.requester();
  Job& started = *job;
  jobs_.push_back(std::move(job));
  started.thread = std::thread([&started, opener = opener_, files = std::move(files)] { run(started, opener, files); });
}

bool DatasetLoader::isBusy() const noexcept {
  return std::ranges::any_of(jobs_, [](const auto& job) { return !job->is_cancelled && !job->is_done; });
}

void DatasetLoader::cancel() {
  for (const auto& job : jobs_) {
    job->is_cancelled = true;
  }
}

void DatasetLoader::run(Job& job, const RecordingOpener& opener, const std::vector<std::filesystem::path>& files) {
  const auto fail = [&job](Status status) {
    const std::scoped_lock lock(job.mutex);
    job.error = std::move(status);
  };
  try {
    auto recording = opener(files);
    if (!recording) {
      fail(recording.error());
    } else {
      {
        const std::scoped_lock lock(job.mutex);
        job.dataset = recording->dataset;
      }
      job.notify();
      scenegraph::standBack(scenegraph::StandBack::Loading);  // behind the first picture, of what has come so far
      recording->load([&job](double fraction) {
        job.fraction = fraction;
        job.notify();
        return !job.is_cancelled;
      });
    }
  } catch (const std::exception& error) {
    fail(Status{StatusLevel::Error, "OpenFailed", std::string("the recording cannot be read: ") + error.what()});
  }
  job.is_finished = true;
  job.notify();
}

void DatasetLoader::collect() {
  std::vector<Job*> jobs;  // a listener may open another one meanwhile
  for (const auto& job : jobs_) {
    jobs.push_back(job.get());
  }
  for (Job* const known : jobs) {
    Job& job = *known;
    const bool is_finished = job.is_finished;  // before the rest: what it finished with is then seen below
    std::shared_ptr<scenegraph::Dataset> dataset;
    std::optional<Status> error;
    {
      const std::scoped_lock lock(job.mutex);
      dataset = job.dataset;
      error = std::exchange(job.error, std::nullopt);
    }
    if (dataset != nullptr && !job.is_announced && !job.is_cancelled) {
      job.is_announced = true;
      if (current_ != nullptr) {
        current_->is_cancelled = true;
      }
      current_ = &job;
      Q_EMIT opened(dataset);
    }
    job.is_done = is_finished;
    if (!job.is_cancelled) {
      if (error) {
        Q_EMIT failed(*error);
      }
      if (&job == current_ && job.told_fraction != job.fraction) {
        job.told_fraction = job.fraction;
        Q_EMIT progressed(job.told_fraction);
      }
      if (&job == current_ && is_finished && !error) {
        Q_EMIT loaded();
      }
    }
  }
  std::erase_if(jobs_, [this](const std::unique_ptr<Job>& job) {
    if (!job->is_done) {
      return false;
    }
    job->thread.join();
    if (job.get() == current_) {
      current_ = nullptr;
    }
    return true;
  });
}

}  // namespace stillframe::viewer
