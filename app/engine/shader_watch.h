#pragma once

#include <filesystem>
#include <functional>
#include <thread>

namespace ir::engine {

/// Hears that files below a folder have changed, on a thread that sleeps meanwhile (inotify). What another
/// computer writes on a network, nobody tells. Where the system has no descriptor to listen with, it is asked
/// again until it has one, and something may have changed then.
class ShaderWatch {
  public:
    /// `changed` is called on that thread, once for changes that follow each other closely.
    ShaderWatch(std::filesystem::path folder, std::function<void()> changed);
    ~ShaderWatch();
    ShaderWatch(const ShaderWatch&) = delete;
    ShaderWatch& operator=(const ShaderWatch&) = delete;

  private:
    void watch_folders() const;
    bool hear_all() const;  ///< false: the descriptor fails, and would be ready for ever
    bool begin_anew();
    void wait();

    std::filesystem::path folder_;
    std::function<void()> changed_;
    int stop_, events_;  ///< descriptors; negative: the system had none left
    std::thread thread_;
};

}  // namespace ir::engine
