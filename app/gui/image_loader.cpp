#include "app/gui/image_loader.h"

#include <algorithm>

#include "renderers/image/exr.h"
#include "renderers/scene/scene.h"

namespace ir::gui {
namespace {

std::filesystem::file_time_type time_of(const std::filesystem::path& file) {
    std::error_code missing;
    return std::filesystem::last_write_time(file, missing);
}

}  // namespace

ImageLoader::~ImageLoader() {
    if (thread_.joinable()) thread_.join();
}

ImageFile ImageLoader::get(const std::filesystem::path& file) {
    const auto found = entries_.find(file);
    if (found != entries_.end() && found->second.time == time_of(file)) return found->second.layers;
    if (std::find(waiting_.begin(), waiting_.end(), file) == waiting_.end()) waiting_.push_back(file);
    read_next();
    return nullptr;
}

std::string ImageLoader::hash(const std::filesystem::path& file) const {
    const auto found = entries_.find(file);
    return found == entries_.end() ? std::string() : found->second.hash;
}

std::string ImageLoader::error(const std::filesystem::path& file) const {
    const auto found = entries_.find(file);
    return found == entries_.end() ? std::string() : found->second.error;
}

void ImageLoader::read_next() {
    if (reading_ || waiting_.empty()) return;
    if (thread_.joinable()) thread_.join();
    reading_ = true;
    const auto file = waiting_.front();
    thread_ = std::thread([this, file] {
        Entry entry{time_of(file), nullptr, {}, {}};
        try {
            entry.layers = std::make_shared<const std::vector<ImageLayer>>(read_layers(file));
            entry.hash = scene::hash_of(entry.layers->front().image);
        } catch (const std::exception& reason) {
            entry.error = reason.what();
        }
        QMetaObject::invokeMethod(
            this, [this, file, entry] { finish(file, entry); }, Qt::QueuedConnection);
    });
}

void ImageLoader::finish(const std::filesystem::path& file, Entry entry) {
    reading_ = false;
    waiting_.erase(std::remove(waiting_.begin(), waiting_.end(), file), waiting_.end());
    const QString name = QString::fromStdString(file.string()), error = QString::fromStdString(entry.error);
    const bool good = entry.layers != nullptr;
    entries_[file] = std::move(entry);
    read_next();
    good ? emit arrived(name) : emit failed(name, error);
}

}  // namespace ir::gui
