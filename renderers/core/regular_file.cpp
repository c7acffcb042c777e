#include "renderers/core/regular_file.h"

#include "renderers/core/error.h"

namespace ir {

void require_regular_file(const std::filesystem::path& file) {
    std::error_code failure;
    const auto status = std::filesystem::status(file, failure);
    if (std::filesystem::is_regular_file(status)) return;
    if (std::filesystem::exists(status))
        throw InputError(file.string(), "", "is no regular file; give the path of another");
    if (failure && status.type() != std::filesystem::file_type::not_found)
        throw InputError(file.string(), "", "cannot be read: " + failure.message());
    throw InputError(file.string(), "", "there is no such file; check the path");
}

}  // namespace ir
