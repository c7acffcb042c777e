#include "app/engine/execution.h"
#include "renderers/core/error.h"
#include "renderers/core/resources_path.h"

namespace ir::engine {

std::shared_ptr<const scene::Scene> SceneCache::load(const std::string& name) {
    auto& entry = scenes_[name];
    if (!entry) entry = std::make_shared<scene::Scene>(scene::load_scene(name));
    return entry;
}

std::shared_ptr<const scene::Scene> SceneCache::load(const std::vector<scene::Part>& parts) {
    const auto key = scene::composition_key(parts);
    if (parts.size() == 1 && key == parts.front().source) return load(key);
    std::erase_if(compositions_, [](const auto& entry) { return entry.second.expired(); });
    auto composed = compositions_[key].lock();
    if (!composed) {
        composed = std::make_shared<scene::Scene>(
            scene::compose(parts, [this](const std::string& name) { return load(name); }));
        compositions_[key] = composed;
    }
    // A window asks for the summary first and for the picture next.
    newest_composition_ = composed;
    return composed;
}

void SceneCache::forget(const std::string& name) {
    scenes_.erase(name);
    compositions_.clear();
    newest_composition_.reset();
}

Machine::Machine(const Options& options) : options_(options) {
#ifdef INTERREFLECT_DEBUG
    options_.debug = true;
#endif
    const gl::ContextOptions context_options{options_.debug, options.device};
    context_ = options.backend.empty()
                   ? gl::Context::create_best(context_options)
                   : gl::Context::create(gl::parse_backend(options.backend), context_options);
    const auto& info = context_->info();
    if (!options.device.empty() && info.renderer.find(options.device) == std::string::npos &&
        info.platform.find(options.device) == std::string::npos)
        throw Error("no OpenGL device matches '" + options.device + "'; the best one here is '" +
                    info.renderer + "'");
    context_->make_current();
    device_ = gl::make_gl_device(*context_);
    programs_ = std::make_unique<gl::ProgramLibrary>(*context_, shader_folder());
}

std::filesystem::path Machine::shader_folder() const {
    return options_.shaders.empty() ? shader_directory() : options_.shaders;
}

Processor Machine::processor() const {
    return options_.processor.value_or(device_->software() ? Processor::host : Processor::gl);
}

Machine::~Machine() {
    context_->make_current();
    programs_.reset();
    device_.reset();
}

}  // namespace ir::engine
