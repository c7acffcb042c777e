#pragma once

#include <QObject>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "renderers/image/image.h"

namespace ir::gui {

/// All layers of an image file, the default one first.
using ImageFile = std::shared_ptr<const std::vector<ImageLayer>>;

/// Reads image files (environment maps, pictures of other renderers) on a thread of its own, so that a large
/// one never stops the window. Keeps what it has read until the file changes.
class ImageLoader : public QObject {
    Q_OBJECT
  public:
    using QObject::QObject;
    ~ImageLoader() override;
    /// The file when it is there; else null, and arrived() or failed() follows. A file that failed is tried
    /// again only when it has changed.
    ImageFile get(const std::filesystem::path& file);
    /// scene::hash_of() the default layer; empty where the file is not there.
    std::string hash(const std::filesystem::path& file) const;
    /// Why a file could not be read; empty when nothing is known against it.
    std::string error(const std::filesystem::path& file) const;
    bool is_reading() const { return reading_; }

  signals:
    void arrived(const QString& file);
    void failed(const QString& file, const QString& error);

  private:
    struct Entry {
        std::filesystem::file_time_type time;
        ImageFile layers;
        std::string error, hash;
    };
    void read_next();
    void finish(const std::filesystem::path& file, Entry entry);
    std::map<std::filesystem::path, Entry> entries_;
    std::vector<std::filesystem::path> waiting_;
    std::thread thread_;
    bool reading_ = false;
};

}  // namespace ir::gui
