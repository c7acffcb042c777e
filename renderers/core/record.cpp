#include "renderers/core/record.h"

namespace ir {

std::string plain_name(std::string_view member) {
    for (const std::string_view suffix : {"_ws", "_m", "_"})
        if (member.ends_with(suffix)) return std::string(member.substr(0, member.size() - suffix.size()));
    return std::string(member);
}

}  // namespace ir
