#pragma once

#include <QObject>
#include <atomic>
#include <functional>

#include "widgets/models/worker.h"

namespace ir::widgets {

/// Work away from the window's thread, one at a time. What is under way ends first; of jobs that come
/// meanwhile only the newest counts.
class NewestJob : public QObject {
    Q_OBJECT
  public:
    /// What it returns is carried out in the window's thread.
    using Job = std::function<std::function<void()>(const std::atomic<bool>& cancelled)>;

    explicit NewestJob(QObject* parent = nullptr) : QObject(parent) {}
    ~NewestJob() override;
    void start(Job job);
    void drop_waiting() { waiting_ = nullptr; }
    bool is_running() const { return running_; }

  private:
    void run(Job job);
    Job waiting_;
    std::atomic<bool> cancelled_ = false;
    bool running_ = false;
    Worker worker_;
};

}  // namespace ir::widgets
