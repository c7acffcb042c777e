#include "renderers/graph/shared_contents.h"

namespace ir::graph {

void SharedContents::put(const std::string& key, const std::string& fingerprint, Entry entry) {
    if (entries_.count({key, fingerprint}) == 0)
        std::erase_if(entries_, [](const auto& each) { return !each.second.is_there(); });
    entries_[{key, fingerprint}] = std::move(entry);
}

const SharedContents::Entry* SharedContents::find(const std::string& key,
                                                  const std::string& fingerprint) const {
    const auto found = entries_.find({key, fingerprint});
    return found != entries_.end() && found->second.is_there() ? &found->second : nullptr;
}

}  // namespace ir::graph
