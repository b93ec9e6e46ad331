#pragma once

#include <functional>
#include <memory>

namespace stillframe::scenegraph {

/// Where background work (decoding, conversion) runs. Jobs are short, independent, own what they touch and throw
/// nothing.
class Executor {
 public:
  virtual ~Executor() = default;
  /// Runs `job` some time, or at once. Any thread.
  virtual void submit(std::function<void()> job) = 0;
  /// Runs `job` when nothing else is to be done, or never. Any thread.
  virtual void submitSpare(std::function<void()> job) = 0;
  /// Returns when every job of submit() so far has run. Not from within a job.
  virtual void drain() = 0;
  /// What a job that submits another calls, when it may outlive this: the executor behind this one, which its jobs do
  /// not outlive. Any thread.
  [[nodiscard]] virtual Executor& backing() { return *this; }
};

/// Runs each job inside submit(), and no spare one: tests and headless rendering, where the first picture must be the
/// complete one.
[[nodiscard]] std::unique_ptr<Executor> makeSynchronousExecutor();
/// `threads` workers, at least one, and one more of the lowest priority for spare jobs, each of which begins while the
/// others have nothing to do. The destructor runs what is queued to its end, spare jobs not.
[[nodiscard]] std::unique_ptr<Executor> makeThreadPoolExecutor(unsigned threads);

}  // namespace stillframe::scenegraph
