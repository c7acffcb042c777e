#pragma once

#include <QObject>
#include <filesystem>
#include <memory>
#include <thread>

#include "renderers/image/image.h"

namespace ir::gui {

/// Reads environment maps on a thread of its own, so that a large one never stops the window. Keeps the last.
class EnvironmentLoader : public QObject {
    Q_OBJECT
  public:
    using QObject::QObject;
    ~EnvironmentLoader() override;
    /// The map when it is there; else null, and arrived() or failed() follows.
    std::shared_ptr<const Image> get(const std::filesystem::path& file);

  signals:
    void arrived();
    void failed(const std::string& error);

  private:
    void finish(const std::filesystem::path& file, std::shared_ptr<const Image> map,
                const std::string& error);
    std::filesystem::path held_, reading_;
    std::filesystem::file_time_type held_time_;
    std::shared_ptr<const Image> map_;
    std::thread thread_;
};

}  // namespace ir::gui
