#include <dlfcn.h>

#include "renderers/core/error.h"
#include "renderers/core/resources_path.h"
#include "renderers/image/codecs/codecs.h"

namespace ir {
namespace {

const ImageCodecs& load() {
    const auto file = module_directory() / "image_codecs.so";
    void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) throw Error("images other than EXR cannot be read or written: " + std::string(dlerror()));
    const auto symbol = dlsym(module, image_codecs_symbol);
    if (!symbol) throw Error(file.string() + ": is of another version of this program");
    return *reinterpret_cast<const ImageCodecs* (*)()>(symbol)();
}

}  // namespace

const ImageCodecs& image_codecs() {
    static const ImageCodecs& codecs = load();
    return codecs;
}

}  // namespace ir
