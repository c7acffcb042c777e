#include "renderers/core/named_files.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>

#include "renderers/core/error.h"
#include "renderers/core/percent_decoded.h"

namespace ir {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> outside_allowed = false;

bool leads_out(const fs::path& relative) {
    return relative.empty() || *relative.begin() == "..";
}

/// Below the folder by name, without a link on the way: what can be told without looking where the folder is.
bool lies_plainly_within(const fs::path& file, const fs::path& folder) {
    auto part = file.begin();
    for (const auto& each : folder)
        if (part == file.end() || *part++ != each) return false;
    auto place = folder;
    std::error_code error;
    for (; part != file.end(); ++part)
        if (*part == ".." || fs::is_symlink(place /= *part, error)) return false;
    return !folder.empty();
}

bool has_image_ending(const fs::path& file) {
    static constexpr std::array endings{".png", ".jpg", ".jpeg", ".webp"};
    auto ending = file.extension().string();
    for (auto& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

}  // namespace

bool lies_within(const fs::path& file, const fs::path& folder) {
    if (lies_plainly_within(file, folder)) return true;
    std::error_code error;
    const auto behind_links = [&](const fs::path& path) {
        const auto whole = fs::absolute(path, error);
        return error ? fs::path() : fs::weakly_canonical(whole, error);
    };
    const auto target = behind_links(file);
    if (error) return false;
    const auto place = behind_links(folder);
    return !error && !leads_out(target.lexically_relative(place));
}

void refuse_links_out(const fs::path& folder, Links which) {
    std::error_code error, ignored;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
    for (; !error && entry != end; entry.increment(error)) {
        if (!entry->is_symlink(ignored)) continue;
        if (which == Links::to_folders && !fs::is_directory(entry->path(), ignored)) continue;
        // Not what is there: a link to nothing makes a file where it leads.
        const auto target = entry->path().parent_path() / fs::read_symlink(entry->path(), ignored);
        if (!lies_within(target, folder))
            throw Error(entry->path().string() + ": is a link that leads out of " + folder.string() +
                        "; put there what it leads to");
    }
}

bool has_scheme(const std::string& uri) {
    const auto colon = uri.find(':');
    if (colon == std::string::npos || colon < 2) return false;
    return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                       [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '.' || c == '-'; });
}

std::string path_in_uri(const fs::path& gltf, const std::string& uri) {
    const auto decoded = percent_decoded(uri);
    if (decoded.empty() || decoded.find('\0') != std::string::npos) return {};
    const auto folder = gltf.parent_path();
    std::error_code ignored;
    const bool is_literal = uri.find('\0') == std::string::npos && !fs::exists(folder / decoded, ignored) &&
                            fs::exists(folder / uri, ignored);
    return is_literal ? uri : decoded;
}

bool may_read(const fs::path& gltf, const fs::path& named, NamedFile kind) {
    if (outside_allowed) return true;
    const auto folder = gltf.has_parent_path() ? gltf.parent_path() : fs::path(".");
    if (lies_within(named, folder)) return true;
    return kind == NamedFile::image && has_image_ending(named) && lies_within(named, folder / "..");
}

void allow_outside_files() {
    outside_allowed = true;
}

bool are_outside_files_allowed() {
    return outside_allowed;
}

}  // namespace ir
