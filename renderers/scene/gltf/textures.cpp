#include "renderers/scene/gltf/textures.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <thread>

#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/scene/gltf/image_file.h"

namespace ir::scene::gltf {
namespace {

constexpr std::size_t max_total_texels = std::size_t{1} << 28;  // 1 GiB as RGBA8
constexpr std::size_t texel_bytes = 4;

Wrap wrap_of(int value) {
    if (value == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp_to_edge;
    return value == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirrored_repeat : Wrap::repeat;
}

Sampler sampler_of(const tinygltf::Sampler& source) {
    Sampler sampler;
    sampler.wrap_s = wrap_of(source.wrapS);
    sampler.wrap_t = wrap_of(source.wrapT);
    if (source.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) sampler.mag = Filter::nearest;
    const int min = source.minFilter;
    if (min == TINYGLTF_TEXTURE_FILTER_NEAREST || min == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
        min == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR)
        sampler.min = Filter::nearest;
    sampler.mipmaps = min != TINYGLTF_TEXTURE_FILTER_NEAREST && min != TINYGLTF_TEXTURE_FILTER_LINEAR;
    return sampler;
}

std::string place_of(std::size_t image) {
    return element("images", image);
}

}  // namespace

int TextureTable::add(int texture, bool srgb) {
    const auto& source = document_.model.textures[texture];
    if (source.source < 0) {
        document_.warnings.add(element("textures", texture) +
                               " has no PNG, JPEG or WebP image and was ignored");
        return -1;
    }
    Request request{source.source, {}, srgb, source.name};
    if (source.sampler >= 0) request.sampler = sampler_of(document_.model.samplers[source.sampler]);
    const auto same = [&](const Request& r) {
        return r.image == request.image && r.srgb == request.srgb && r.sampler == request.sampler;
    };
    const auto found = std::find_if(requests_.begin(), requests_.end(), same);
    const auto index = static_cast<int>(found - requests_.begin());
    if (found == requests_.end()) requests_.push_back(request);
    return index;
}

std::vector<std::vector<std::uint8_t>> TextureTable::decode_images(std::vector<std::size_t> wanted) const {
    std::vector<std::vector<std::uint8_t>> result(document_.images.size());
    std::vector<std::exception_ptr> failures(wanted.size());
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < wanted.size(); i = next++) try {
                const auto& bytes = document_.images[wanted[i]].bytes;
                const auto place = place_of(wanted[i]);
                const auto size = probe_image(document_.file, place, bytes);
                result[wanted[i]] = decode_image(document_.file, place, bytes, size);
            } catch (...) {
                failures[i] = std::current_exception();
            }
    };
    const auto cores = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::thread> helpers;
    for (std::size_t i = 1; i < std::min<std::size_t>(cores, wanted.size()); ++i) helpers.emplace_back(work);
    work();
    for (auto& helper : helpers) helper.join();
    for (const auto& failure : failures)
        if (failure) std::rethrow_exception(failure);
    return result;
}

std::vector<Texture> TextureTable::decode() const {
    std::set<std::size_t> wanted;
    std::size_t texels = 0, bytes = 0;
    std::vector<ImageSize> sizes(document_.images.size());
    for (const auto& request : requests_) {
        const auto& image = document_.images[request.image];
        if (image.problem) std::rethrow_exception(image.problem);
        auto& size = sizes[request.image];
        if (wanted.insert(request.image).second) {
            size = probe_image(document_.file, place_of(request.image), image.bytes);
            bytes += size.texels() * size.working_bytes;
        }
        texels += size.texels();
        bytes += size.texels() * texel_bytes;
        if (texels > max_total_texels)
            throw InputError(document_.file, place_of(request.image),
                             "all textures together have more than 2^28 texels; scale them down");
        if (bytes > max_expanded(document_.total_bytes))
            throw InputError(
                document_.file, place_of(request.image),
                "all textures together have far more texels than the files have bytes; scale them "
                "down");
    }
    auto decoded = decode_images({wanted.begin(), wanted.end()});
    std::vector<Texture> textures;
    for (std::size_t i = 0; i < requests_.size(); ++i) {
        const auto& request = requests_[i];
        const auto size = sizes[request.image];
        const bool is_needed_again =
            std::any_of(requests_.begin() + static_cast<std::ptrdiff_t>(i) + 1, requests_.end(),
                        [&](const Request& later) { return later.image == request.image; });
        auto texels_now = is_needed_again ? decoded[request.image] : std::move(decoded[request.image]);
        textures.push_back(
            {request.name, size.width, size.height, std::move(texels_now), request.srgb, request.sampler});
    }
    return textures;
}

}  // namespace ir::scene::gltf
