#include "app/gui/environment_loader.h"

#include "renderers/image/exr.h"

namespace ir::gui {
namespace {

std::filesystem::file_time_type time_of(const std::filesystem::path& file) {
    std::error_code missing;
    return std::filesystem::last_write_time(file, missing);
}

}  // namespace

EnvironmentLoader::~EnvironmentLoader() {
    if (thread_.joinable()) thread_.join();
}

std::shared_ptr<const Image> EnvironmentLoader::get(const std::filesystem::path& file) {
    if (map_ && held_ == file && held_time_ == time_of(file)) return map_;
    if (!reading_.empty()) return nullptr;  // one at a time: its end asks again
    if (thread_.joinable()) thread_.join();
    reading_ = file;
    thread_ = std::thread([this, file] {
        std::shared_ptr<const Image> map;
        std::string error;
        try {
            map = std::make_shared<const Image>(read_image(file));
        } catch (const std::exception& reason) {
            error = reason.what();
        }
        QMetaObject::invokeMethod(
            this, [this, file, map, error] { finish(file, map, error); }, Qt::QueuedConnection);
    });
    return nullptr;
}

void EnvironmentLoader::finish(const std::filesystem::path& file, std::shared_ptr<const Image> map,
                               const std::string& error) {
    reading_.clear();
    if (!map) return emit failed(error);
    held_ = file;
    held_time_ = time_of(file);
    map_ = std::move(map);
    emit arrived();
}

}  // namespace ir::gui
