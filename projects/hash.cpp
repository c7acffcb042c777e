#include "projects/hash.h"

#include <xxhash.h>

#include <fstream>
#include <memory>
#include <vector>

#include "renderers/core/error.h"
#include "renderers/core/regular_file.h"

namespace ir::projects {
namespace {

std::string hexadecimal(XXH128_hash_t hash) {
    XXH128_canonical_t bytes;
    XXH128_canonicalFromHash(&bytes, hash);
    std::string text;
    for (const unsigned char byte : bytes.digest) {
        text += "0123456789abcdef"[byte >> 4];
        text += "0123456789abcdef"[byte & 15];
    }
    return text;
}

}  // namespace

std::string hash_bytes(std::string_view bytes) {
    return hexadecimal(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string hash_file(const std::filesystem::path& file, const CancelToken* cancel) {
    require_regular_file(file);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(file.string(), "", "cannot be opened; check its permissions");
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
    XXH3_128bits_reset(state.get());
    std::vector<char> block(1u << 20);
    while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0) {
        if (cancel) cancel->check();
        XXH3_128bits_update(state.get(), block.data(), static_cast<std::size_t>(stream.gcount()));
    }
    if (stream.bad()) throw InputError(file.string(), "", "cannot be read to its end; check the disk");
    return hexadecimal(XXH3_128bits_digest(state.get()));
}

std::string hash_json(const Json& json) {
    return hash_bytes(canonical_json(json));
}

}  // namespace ir::projects
