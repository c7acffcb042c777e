#include "projects/session.h"

#include "renderers/core/error.h"

namespace ir::projects {
namespace {
constexpr const char* session_file_name = "session.json";
}

Json load_session(const std::filesystem::path& folder, FileSystem& files) {
    const auto file = folder / session_file_name;
    try {
        if (!files.exists(file)) return Json::object();
        Json session = parse_json(files.read(file, JsonLimits{}.bytes), file.string());
        return session.is_object() ? session : Json::object();
    } catch (const Error&) {
        return Json::object();
    }
}

void save_session(const std::filesystem::path& folder, const Json& session, FileSystem& files) {
    write_atomically(files, folder / session_file_name, pretty_json(session));
}

}  // namespace ir::projects
