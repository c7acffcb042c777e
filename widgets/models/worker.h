#pragma once

#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>
#include <thread>

namespace ir::widgets {

/// A thread of its own, which carries out one job after the other: renderers want the cores. By the standard
/// library alone, so that the thread sanitizer sees what a job waits for (of Qt's pools it does not).
class Worker {
  public:
    Worker() = default;
    ~Worker() { finish(); }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    void start(std::function<void()> job);
    /// Waits for the job under way. Those that wait are forgotten.
    void finish();

  private:
    void work();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::list<std::function<void()>> jobs_;
    bool is_ending_ = false;
    std::thread thread_;  ///< since the first job
};

}  // namespace ir::widgets
