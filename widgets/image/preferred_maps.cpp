#include "widgets/image/preferred_maps.h"

#include <mutex>
#include <utility>

namespace ir::widgets {
namespace {

/// Pictures are made on several threads.
std::mutex maps_mutex;
PreferredMaps maps;

}  // namespace

void prefer_maps(PreferredMaps preferred) {
    const std::lock_guard lock(maps_mutex);
    maps = std::move(preferred);
}

std::string preferred_map(MappedKind kind) {
    const std::lock_guard lock(maps_mutex);
    const auto found = maps.find(kind);
    return found == maps.end() ? default_colour_map(kind) : found->second;
}

std::string preferred_map(Semantic semantic, const std::string& described) {
    const bool is_default = described.empty() || described == default_colour_map(semantic);
    return is_default ? preferred_map(mapped_kind(semantic)) : described;
}

}  // namespace ir::widgets
