#include "widgets/models/worker.h"

#include <utility>

namespace ir::widgets {

void Worker::start(std::function<void()> job) {
    {
        const std::lock_guard lock(mutex_);
        jobs_.push_back(std::move(job));
    }
    changed_.notify_one();
    if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
}

void Worker::finish() {
    {
        const std::lock_guard lock(mutex_);
        jobs_.clear();
        is_ending_ = true;
    }
    changed_.notify_one();
    if (thread_.joinable()) thread_.join();
    is_ending_ = false;
}

void Worker::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return is_ending_ || !jobs_.empty(); });
        if (is_ending_) return;
        {
            const auto job = std::move(jobs_.front());
            jobs_.pop_front();
            lock.unlock();
            job();
        }  // what it holds is released before the next one
        lock.lock();
    }
}

}  // namespace ir::widgets
