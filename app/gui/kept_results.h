#pragma once

#include <QObject>
#include <QTimer>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "app/gui/session.h"
#include "projects/results.h"

namespace ir::gui {

/// The kept results of the open project, as results/index.json lists them. The disk is read, and results are
/// deleted, on a thread of their own: answers are signals.
class KeptResults : public QObject {
    Q_OBJECT
  public:
    explicit KeptResults(Session& session, QObject* parent = nullptr);
    ~KeptResults() override;

    /// False until the index of a project that was just opened has been read.
    bool is_known() const { return is_known_; }
    const std::vector<projects::KeptResult>& entries() const { return index_.entries(); }
    const projects::KeptResult* find(const std::string& key) const { return index_.find(key); }
    const std::string& error() const { return error_; }  ///< why the index could not be read; one line
    /// The file of a role, absolute; empty where the result has none.
    std::filesystem::path file(const projects::KeptResult& result, const std::string& role) const;
    std::uint64_t bytes(const std::string& key) const;  ///< of all files of a result
    bool is_missing(const std::string& key) const;      ///< its picture is not on the disk
    /// The stored history that an experiment begins with, whatever its number of samples; empty: none.
    std::string state_file(const projects::Experiment& experiment) const;

    /// Reads the index again where it has changed on the disk.
    void look();
    /// For good. changed() follows, or failed().
    void remove(const std::vector<std::string>& keys);
    bool is_busy() const { return is_busy_; }

  signals:
    void changed();
    void failed(const QString& error);

  private:
    /// What is on the disk.
    struct Reading {
        projects::ResultIndex index;
        std::map<std::string, std::uint64_t> bytes;
        std::map<std::string, bool> missing;
        std::string stamp, error;
    };
    static Reading read(const std::filesystem::path& folder);
    void follow_session();
    void start(std::function<void()> before);
    void finish(const std::filesystem::path& folder, Reading reading, const std::string& failure);

    Session& session_;
    std::filesystem::path folder_;  ///< of the project that the index is of
    projects::ResultIndex index_;
    std::map<std::string, std::uint64_t> bytes_;
    std::map<std::string, bool> missing_;
    std::string stamp_, error_;
    std::vector<std::function<void()>> waiting_;
    std::thread thread_;
    QTimer looking_;
    bool is_known_ = true, is_busy_ = false;
};

}  // namespace ir::gui
