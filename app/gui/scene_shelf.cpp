#include "app/gui/scene_shelf.h"

namespace ir::gui {
namespace {

constexpr std::size_t max_kept = 8;

}  // namespace

SceneShelf::SceneShelf(Renderer& renderer) : renderer_(renderer) {
    connect(&renderer_, &Renderer::scene_arrived, this, [this](const engine::SceneSummary& scene) {
        if (scenes_.size() >= max_kept)
            std::erase_if(scenes_, [this](const auto& each) { return each.first != key_; });
        scenes_[scene.composition_key] = scene;
        for (const auto& warning : scene.warnings)
            emit message({Severity::warning, "scene", warning, place_});
        if (scene.composition_key == key_) emit changed();
    });
    connect(&renderer_, &Renderer::failed, this,
            [this](const std::string& tag, const std::string& error, bool cancelled) {
                if (tag == "scene" && !cancelled) emit message({Severity::error, "scene", error, place_});
            });
}

void SceneShelf::choose(const std::vector<scene::Part>& parts) {
    const auto key = scene::composition_key(parts);
    if (key == key_) return;
    key_ = key;
    parts_ = parts;
    if (!current()) renderer_.load_scene(parts);
    emit changed();
}

void SceneShelf::clear() {
    key_.clear();
    parts_.clear();
    emit changed();
}

const engine::SceneSummary* SceneShelf::current() const {
    const auto found = scenes_.find(key_);
    return found == scenes_.end() ? nullptr : &found->second;
}

}  // namespace ir::gui
