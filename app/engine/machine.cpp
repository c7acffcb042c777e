#include "app/engine/execution.h"
#include "renderers/core/resources_path.h"

namespace ir::engine {

std::shared_ptr<const scene::Scene> SceneCache::load(const std::string& name) {
    auto& entry = scenes_[name];
    if (!entry) entry = std::make_shared<scene::Scene>(scene::load_scene(name));
    return entry;
}

void SceneCache::forget(const std::string& name) {
    scenes_.erase(name);
}

Machine::Machine(const Options& options) : options_(options) {
    const gl::ContextOptions context_options{options.debug, options.device};
    context_ = options.backend.empty()
                   ? gl::Context::create_best(context_options)
                   : gl::Context::create(gl::parse_backend(options.backend), context_options);
    context_->make_current();
    device_ = gl::make_gl_device(*context_);
    programs_ = std::make_unique<gl::ProgramLibrary>(*context_, shader_directory());
}

Machine::~Machine() {
    context_->make_current();
    programs_.reset();
    device_.reset();
}

}  // namespace ir::engine
