#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/engine/execution.h"
#include "renderers/core/progress.h"
#include "renderers/graph/graph.h"

namespace ir::python {

namespace py = pybind11;

/// What work tells Python while it runs without Python's lock, and how Python ends it: a signal such as
/// Ctrl-C, an exception of the progress function, or an event that another thread has set.
class Watch {
  public:
    /// Both may be None. Made, used and destroyed with Python's lock.
    Watch(py::object progress, py::object cancel);
    Watch(const Watch&) = delete;

    /// For the work; they take the lock themselves.
    ProgressCallback callback();
    const CancelToken* token() const { return &token_; }

    /// Runs `work`, and throws what Python raised meanwhile in place of Cancelled.
    template <class Work>
    auto around(Work work) {
        try {
            auto result = work();
            raise();
            return result;
        } catch (const std::exception&) {
            raise();
            throw;
        }
    }

  private:
    void raise();

    py::object progress_, cancel_;
    CancelToken token_;
    std::optional<py::error_already_set> raised_;
};

/// A context, its device and its programs, used by one thread of Python at a time. Others wait.
class Machine {
  public:
    explicit Machine(const engine::MachineOptions& options, std::uint64_t memory_budget);
    ~Machine();
    Machine(const Machine&) = delete;

    /// That of renderings that name none: made when it is first asked for.
    static std::shared_ptr<Machine> standard();
    /// At the end of the program, as long as there is one.
    static void forget_standard();

    std::uint64_t memory_budget() const { return memory_budget_; }
    const std::string& device() const { return device_; }
    std::string backend() const { return backend_; }

    /// Calls work(engine::Machine&) with the context current and without Python's lock. While others use it,
    /// `watch` is told, and ends the waiting. Throws UsageError where this thread is using the machine
    /// already.
    template <class Work>
    auto use(Watch& watch, Work work) {
        const py::gil_scoped_release unlocked;
        const Use use(*this, watch.callback(), watch.token());
        return work(*machine_);
    }

  private:
    class Use {
      public:
        Use(Machine& machine, const ProgressCallback& look, const CancelToken* cancel);
        ~Use();

      private:
        Machine& machine_;
    };
    std::timed_mutex mutex_;
    std::atomic<std::thread::id> user_;
    std::unique_ptr<engine::Machine> machine_;
    const std::uint64_t memory_budget_;
    std::string device_, backend_;
};

}  // namespace ir::python
