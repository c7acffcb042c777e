#include "renderers/gl/pass_timer.h"

#include "renderers/core/error.h"

namespace ir::gl {
namespace {
constexpr std::size_t kept_tickets = 4096;
}

PassTimer::~PassTimer() {
    // Without its context the queries are gone already.
    if (!context_.is_current()) return;
    for (auto& interval : open_) recycle(interval);
    for (auto& [ticket, interval] : closed_) recycle(interval);
    if (!pool_.empty()) api_.DeleteQueries(static_cast<GLsizei>(pool_.size()), pool_.data());
}

void PassTimer::begin() {
    Interval interval;
    if (context_.info().software) {
        api_.Finish();
        interval.start = Clock::now();
    } else {
        interval.queries[0] = timestamp();
    }
    open_.push_back(interval);
}

int PassTimer::end() {
    if (open_.empty()) throw Error("a pass ends that did not begin");
    Interval interval = open_.back();
    open_.pop_back();
    if (context_.info().software) {
        api_.Finish();
        interval.milliseconds =
            std::chrono::duration<double, std::milli>(Clock::now() - interval.start).count();
        interval.done = true;
    } else {
        interval.queries[1] = timestamp();
    }
    closed_.emplace(next_ticket_, interval);
    if (closed_.size() > kept_tickets) {
        recycle(closed_.begin()->second);
        closed_.erase(closed_.begin());
    }
    return next_ticket_++;
}

double PassTimer::milliseconds(int ticket) {
    const auto found = closed_.find(ticket);
    if (found == closed_.end()) throw Error("no time is known for pass ticket " + std::to_string(ticket));
    Interval& interval = found->second;
    if (!interval.done) {
        GLuint64 nanoseconds[2] = {0, 0};
        for (int i = 0; i < 2; ++i)
            api_.GetQueryObjectui64v(interval.queries[i], GL_QUERY_RESULT, &nanoseconds[i]);
        interval.milliseconds = static_cast<double>(nanoseconds[1] - nanoseconds[0]) * 1e-6;
        interval.done = true;
        recycle(interval);
    }
    return interval.milliseconds;
}

GLuint PassTimer::timestamp() {
    GLuint query = 0;
    if (pool_.empty()) {
        api_.CreateQueries(GL_TIMESTAMP, 1, &query);
    } else {
        query = pool_.back();
        pool_.pop_back();
    }
    api_.QueryCounter(query, GL_TIMESTAMP);
    return query;
}

void PassTimer::recycle(Interval& interval) {
    for (GLuint& query : interval.queries) {
        if (query) pool_.push_back(query);
        query = 0;
    }
}

}  // namespace ir::gl
