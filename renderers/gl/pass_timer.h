#pragma once

#include <chrono>
#include <map>
#include <vector>

#include "renderers/gl/context.h"

namespace ir::gl {

/// Measures passes on the device: pairs of timestamp queries, taken from a pool, on hardware; glFinish and a
/// steady clock on software drivers, whose queries mean nothing. Passes may be nested.
class PassTimer {
  public:
    explicit PassTimer(const Context& context) : context_(context), api_(context.api()) {}
    ~PassTimer();
    PassTimer(const PassTimer&) = delete;
    PassTimer& operator=(const PassTimer&) = delete;

    void begin();
    /// A ticket for milliseconds(); the newest 4096 tickets stay known.
    int end();
    /// Waits for the result. Throws Error for a ticket that is not known.
    double milliseconds(int ticket);

  private:
    using Clock = std::chrono::steady_clock;
    struct Interval {
        Clock::time_point start{};
        GLuint queries[2] = {0, 0};
        bool done = false;
        double milliseconds = 0;
    };
    GLuint timestamp();
    void recycle(Interval& interval);

    const Context& context_;
    const Api& api_;
    std::vector<Interval> open_;
    std::map<int, Interval> closed_;
    std::vector<GLuint> pool_;
    int next_ticket_ = 0;
};

}  // namespace ir::gl
