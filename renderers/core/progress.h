#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "renderers/core/error.h"

namespace ir {

/// Shared between the thread that works and those that watch or cancel it.
class CancelToken {
  public:
    void cancel() { cancelled_ = true; }
    void reset() { cancelled_ = false; }
    bool is_cancelled() const { return cancelled_; }
    /// Throws Cancelled when cancelled.
    void check() const {
        if (cancelled_) throw Cancelled();
    }

  private:
    std::atomic<bool> cancelled_{false};
};

/// Called by the working thread between slices: what is being done and which fraction of the frame is done.
using ProgressCallback = std::function<void(const std::string& what, double fraction)>;

}  // namespace ir
