#pragma once

#include <QObject>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/engine/kept_study.h"
#include "app/engine/study_thread.h"

namespace ir::gui {

/// Carries out plots and reads kept ones, as the window's thread sees it: every call returns at once, every
/// answer is a signal on the window's thread. Numbers are kept in the project's folder by the study's thread.
class Studies : public QObject {
    Q_OBJECT
  public:
    /// Without a runner studies get a machine of their own.
    explicit Studies(engine::StudyRunner runner, QObject* parent = nullptr);
    ~Studies() override;

    /// Replaces what runs of the same plot. `request.tag` is the plot's id.
    void run(engine::StudyRequest request, bool keep);
    void cancel(const std::string& plot);
    /// Nobody wants to hear of this plot any more.
    void release(const std::string& plot);
    /// Whether a study runs that somebody wants to hear of.
    bool is_running() const { return !wanted_.empty(); }

    /// Reads results/plots/ID.json.
    void read(const std::filesystem::path& folder, const std::string& plot);
    bool is_reading() const { return is_reading_; }

  signals:
    void point_arrived(const std::string& plot, const ir::engine::ErrorPoint& point);
    void progressed(const std::string& plot, const QString& what, double fraction);
    /// `keep_error` is not empty where the numbers could not be written.
    void finished(const std::string& plot, const ir::engine::ErrorStudy& study, const QString& keep_error);
    void failed(const std::string& plot, const QString& error, bool cancelled);
    /// Null where none is kept; then `error` may say why.
    void read_done(const std::string& folder, const std::string& plot,
                   std::shared_ptr<const ir::engine::KeptStudy> kept, const QString& error);

  private:
    struct Progress {
        QString what;
        double fraction = 0;
    };
    struct Place {
        std::filesystem::path folder;
        std::string plot;
        bool operator==(const Place&) const = default;
    };
    engine::StudyThread::Callbacks callbacks();
    template <class Function>
    void post(const std::string& plot, std::uint64_t serial, Function function);
    void study_progress(const std::string& plot, std::uint64_t serial, Progress progress);
    QString study_keep(const std::string& plot, std::uint64_t serial, const engine::ErrorStudy& study);
    void start_reading(const Place& place);

    std::map<std::string, std::uint64_t> wanted_;  ///< serials by plot; the window's thread
    std::mutex mutex_;                             ///< of the two below
    std::map<std::string, engine::StudyRequest> to_keep_;
    std::map<std::string, Progress> progress_;
    std::vector<Place> to_read_;
    bool is_reading_ = false;
    std::thread reader_;
    std::unique_ptr<engine::StudyThread> thread_;  // last member: starts when the rest exists
};

}  // namespace ir::gui
