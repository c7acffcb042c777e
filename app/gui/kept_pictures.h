#pragma once

#include <string>

namespace ir::gui {

/// What views call a kept result: "result:KEY".
inline std::string kept_owner(const std::string& key) {
    return "result:" + key;
}
inline bool is_kept_owner(const std::string& owner) {
    return owner.rfind("result:", 0) == 0;
}
/// The result's key of such a name.
inline std::string kept_key(const std::string& owner) {
    return owner.substr(7);
}

}  // namespace ir::gui
