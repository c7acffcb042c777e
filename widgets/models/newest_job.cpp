#include "widgets/models/newest_job.h"

#include <utility>

namespace ir::widgets {

NewestJob::~NewestJob() {
    cancelled_ = true;
    worker_.finish();
}

void NewestJob::start(Job job) {
    running_ ? void(waiting_ = std::move(job)) : run(std::move(job));
}

void NewestJob::run(Job job) {
    running_ = true;
    worker_.start([this, job = std::move(job)] {
        auto finish = job(cancelled_);
        if (cancelled_) return;
        QMetaObject::invokeMethod(
            this,
            [this, finish = std::move(finish)] {
                running_ = false;
                if (waiting_) run(std::exchange(waiting_, nullptr));
                finish();
            },
            Qt::QueuedConnection);
    });
}

}  // namespace ir::widgets
