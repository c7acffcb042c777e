#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>

#include "app/engine/render_thread.h"

namespace ir::engine {

/// A render thread whose answers are written down.
class RenderThreadTest : public testing::Test {
  protected:
    using Clock = std::chrono::steady_clock;
#ifdef __SANITIZE_THREAD__
    /// The sanitizer does not see how the tasks of an uninstrumented TBB are ordered.
    static constexpr int workers = 1;
#else
    static constexpr int workers = 0;  ///< all
#endif
    struct Failure {
        std::string tag, error;
        bool cancelled = false;
    };
    struct Export {
        std::string tag, file, error;
    };
    std::optional<Processor> processor;
    std::filesystem::path shaders;  ///< empty: the product's
    /// Everything that came back so far.
    struct Answers {
        std::vector<LiveResult> results;
        std::vector<SceneViewResult> views;
        std::vector<ProbeResult> probes;
        std::vector<SurfaceResult> surfaces;
        std::vector<Export> exports;
        std::vector<KeepResult> keeps;
        std::vector<Failure> failures;
        std::vector<SceneSummary> scenes;
        std::vector<std::pair<std::string, std::string>> progress;  ///< tag, pass
        std::vector<std::vector<ShaderFault>> faults;
        std::string no_device;
    };

    void SetUp() override {
        RenderThread::Callbacks c;
        c.on_result = [this](LiveResult result) { note(&Answers::results, std::move(result)); };
        c.on_scene_view = [this](SceneViewResult view) { note(&Answers::views, std::move(view)); };
        c.on_probe = [this](ProbeResult probe) { note(&Answers::probes, std::move(probe)); };
        c.on_surface = [this](SurfaceResult found) { note(&Answers::surfaces, std::move(found)); };
        c.on_exported = [this](std::string tag, std::string file, std::string error) {
            note(&Answers::exports, {tag, file, error});
        };
        c.on_kept = [this](KeepResult kept) { note(&Answers::keeps, std::move(kept)); };
        c.on_failure = [this](std::string tag, std::string error, bool cancelled) {
            note(&Answers::failures, {tag, error, cancelled});
        };
        c.on_scene = [this](SceneSummary scene) { note(&Answers::scenes, std::move(scene)); };
        c.on_progress = [this](std::string tag, std::string pass, double) {
            note(&Answers::progress, {tag, pass});
        };
        c.on_shader_faults = [this](std::vector<ShaderFault> now) { note(&Answers::faults, std::move(now)); };
        c.on_no_device = [this](std::string error) {
            const std::lock_guard lock(mutex_);
            answers_.no_device = error;
        };
        thread = std::make_unique<RenderThread>(MachineOptions{"egl", {}, false, workers, processor, shaders},
                                                std::move(c));
    }
    void TearDown() override {
        thread.reset();
    }

    template <class Value>
    void note(std::vector<Value> Answers::*list, Value value) {
        const std::lock_guard lock(mutex_);
        (answers_.*list).push_back(std::move(value));
        changed_.notify_all();
    }

    /// Waits until `test(answers)`; false after five minutes or without a device.
    template <class Test>
    bool wait(Test test) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::minutes(5), [&] {
            EXPECT_EQ(answers_.no_device, "");
            return test(answers_);
        });
    }
    Answers answers() {
        const std::lock_guard lock(mutex_);
        return answers_;
    }
    void forget() {
        const std::lock_guard lock(mutex_);
        answers_ = {};
    }
    /// The finished result of a request.
    LiveResult finished(std::uint64_t serial) {
        LiveResult found;
        EXPECT_TRUE(wait([&](const Answers& a) {
            for (const auto& failure : a.failures) EXPECT_EQ(failure.error, "");
            for (const auto& result : a.results)
                if (result.serial == serial && result.finished) return found = result, true;
            return !a.failures.empty();
        }));
        return found;
    }
    LiveResult render(LiveRequest request) {
        return finished(thread->request(std::move(request)));
    }

    /// Of the reference: ambient occlusion, whose picture has one channel.
    static LiveRequest request_of(const std::string& tag, const std::string& method) {
        LiveRequest request;
        request.tag = tag;
        request.experiment.scene = "builtin:cornell";
        request.experiment.method = method;
        if (method == "reference") request.experiment.settings = {{"paths", std::string("ao")}};
        request.experiment.width = 24;
        request.experiment.height = 16;
        request.parts = {Part{}};
        return request;
    }
    /// A frame of many seconds, in slices.
    static LiveRequest long_request(const std::string& tag) {
        auto request = request_of(tag, "reference");
        request.experiment.width = 64;
        request.experiment.height = 48;
        request.experiment.settings["samples"] = std::int64_t{400000};
        return request;
    }
    /// Waits until the long frame is being traced.
    bool is_tracing(const std::string& tag) {
        return wait([&](const Answers& a) {
            return std::count(a.progress.begin(), a.progress.end(),
                              std::pair<std::string, std::string>{tag, "trace visibility"}) >= 3;
        });
    }

    std::unique_ptr<RenderThread> thread;

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    Answers answers_;
};

}  // namespace ir::engine
