#pragma once

#include "renderers/core/file_system.h"

namespace ir::gui {

/// The machine's files as the window's thread uses them. What takes long, as on a slow disk or network, is
/// done on a thread of its own: meanwhile the window draws, pictures arrive and timers run, while keys and
/// clicks wait. Other threads wait as usual.
class PatientFiles final : public FileSystem {
  public:
    /// Any work that waits for the disk.
    void wait_for(const std::function<void()>& work);
    /// Whether something is waited for now: what is called then by events must not begin anew.
    bool is_waiting() const { return waiting_ > 0; }

    /// While it lives no events come, as their receivers go.
    class Silence {
      public:
        Silence();
        ~Silence();
        Silence(const Silence&) = delete;
        Silence& operator=(const Silence&) = delete;
    };

    bool exists(const std::filesystem::path& path) override;
    std::string read(const std::filesystem::path& file, std::size_t limit) override;
    void write(const std::filesystem::path& temporary, const std::filesystem::path& target,
               const Fill& fill) override;
    void sync_directory(const std::filesystem::path& folder) override;
    void rename(const std::filesystem::path& from, const std::filesystem::path& to) override;
    void remove(const std::filesystem::path& file) override;
    void create_directories(const std::filesystem::path& folder) override;
    void pour(const std::filesystem::path& file, std::ostream& out) override;
    std::vector<std::filesystem::path> list(const std::filesystem::path& folder) override;
    void remove_all(const std::filesystem::path& folder) override;
    std::int64_t modified(const std::filesystem::path& file) override;

  private:
    template <class Work>
    auto patiently(const Work& work);
    int waiting_ = 0, silences_ = 0;
};

/// Of the window's thread.
PatientFiles& patient_files();

}  // namespace ir::gui
