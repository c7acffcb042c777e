#include "projects/hash.h"

#include <fstream>
#include <memory>

#include "renderers/core/error.h"
#include "renderers/core/file_system.h"

namespace ir::projects {
std::string hash_file(const std::filesystem::path& file, const CancelToken* cancel) {
    require_regular_file(file);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(file.string(), "", "cannot be opened; check its permissions");
    Hasher hasher;
    constexpr std::size_t block_size = 1u << 20;
    const auto block = std::make_unique_for_overwrite<char[]>(block_size);
    while (stream.read(block.get(), std::streamsize{block_size}) || stream.gcount() > 0) {
        if (cancel) cancel->check();
        hasher.add(std::as_bytes(std::span(block.get(), static_cast<std::size_t>(stream.gcount()))));
    }
    if (stream.bad()) throw InputError(file.string(), "", "cannot be read to its end; check the disk");
    return hasher.hexadecimal();
}

std::string hash_json(const Json& json) {
    return hash_bytes(canonical_json(json));
}

}  // namespace ir::projects
