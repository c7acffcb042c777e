#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace ir {

inline std::string read_text(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// A program that runs beside the test, to be looked at and sent signals.
class ChildProcess {
  public:
    /// Its output goes to stdout and stderr in `folder`.
    ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
                 const std::filesystem::path& folder)
        : out_(folder / "stdout"), err_(folder / "stderr") {
        std::vector<char*> words{const_cast<char*>(program.c_str())};
        for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
        words.push_back(nullptr);
        std::filesystem::create_directories(folder);
        // The files of a run before would be taken for this one's.
        for (const auto& file : {out_, err_}) std::ofstream(file, std::ios::trunc).close();
        pid_ = fork();
        if (pid_ != 0) return;
        for (const auto& [file, descriptor] : {std::pair{&out_, STDOUT_FILENO}, {&err_, STDERR_FILENO}})
            dup2(open(file->c_str(), O_WRONLY | O_APPEND), descriptor);
        // Whatever started the test may have had them ignored.
        for (const int each : {SIGINT, SIGTERM, SIGHUP}) ::signal(each, SIG_DFL);
        execv(program.c_str(), words.data());
        _exit(127);
    }
    ~ChildProcess() {
        if (!has_ended()) {
            ::kill(pid_, SIGKILL);
            wait();
        }
    }
    ChildProcess(const ChildProcess&) = delete;

    std::string out() const { return read_text(out_); }
    std::string err() const { return read_text(err_); }
    void send(int signal) { ::kill(pid_, signal); }

    /// Whether the condition came true while the program ran.
    bool reaches(const std::function<bool()>& condition) {
        for (const auto end = Clock::now() + std::chrono::minutes(4); Clock::now() < end; rest()) {
            if (condition()) return true;
            if (has_ended()) return condition();
        }
        return false;
    }
    /// Whether its standard error says so while it runs.
    bool says(const std::string& text) {
        return reaches([&] { return err().find(text) != std::string::npos; });
    }
    /// Whether it takes care of a signal itself.
    bool watches(int signal) const {
        std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
        for (std::string line; std::getline(status, line);)
            if (line.rfind("SigCgt:", 0) == 0)
                return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0;
        return false;
    }
    /// Whether it has the file open.
    bool has_open(const std::filesystem::path& file) const {
        std::error_code error;
        const std::filesystem::path open = "/proc/" + std::to_string(pid_) + "/fd";
        for (const auto& entry : std::filesystem::directory_iterator(open, error))
            if (std::filesystem::read_symlink(entry.path(), error) == file) return true;
        return false;
    }
    bool has_ended() {
        if (!ended_ && waitpid(pid_, &status_, WNOHANG) == pid_) ended_ = true;
        return ended_;
    }
    /// As a shell gives it.
    int wait() {
        if (!ended_ && waitpid(pid_, &status_, 0) == pid_) ended_ = true;
        return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
    }
    /// Whether a signal ended it, and not the program itself.
    bool was_killed() const { return WIFSIGNALED(status_); }
    static void rest() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

  private:
    using Clock = std::chrono::steady_clock;
    std::filesystem::path out_, err_;
    pid_t pid_ = -1;
    int status_ = 0;
    bool ended_ = false;
};

}  // namespace ir
