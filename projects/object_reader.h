#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <set>
#include <string>

#include "projects/json.h"

namespace ir::projects {

/// Takes members out of a JSON object one by one. Wrong types and ranges throw InputError with the file and
/// the JSON pointer; what nobody took is left in rest().
class ObjectReader {
  public:
    /// Throws InputError when `object` is no object.
    ObjectReader(const Json& object, std::string file, std::string pointer);
    ObjectReader(const Json&& object, std::string file, std::string pointer) = delete;  ///< is referred to

    const std::string& file() const { return file_; }
    const std::string& pointer() const { return pointer_; }
    std::string pointer_to_member(const std::string& key) const;

    bool has(const std::string& key) const { return object_.contains(key); }
    /// The member, now known, or null.
    const Json* take(const std::string& key);

    std::string text(const std::string& key, std::string otherwise = {});
    std::string required_text(const std::string& key);
    /// A valid id, see document.h.
    std::string required_id(const std::string& key);
    bool flag(const std::string& key, bool otherwise);
    double number(const std::string& key, double otherwise, double min = -std::numeric_limits<double>::max(),
                  double max = std::numeric_limits<double>::max());
    std::int64_t integer(const std::string& key, std::int64_t otherwise, std::int64_t min, std::int64_t max);
    std::uint64_t natural(const std::string& key, std::uint64_t otherwise);
    /// The member is an array of so many numbers.
    void numbers(const std::string& key, double* out, std::size_t count);
    /// The member is an array of width and height; absent: `otherwise`.
    glm::ivec2 size(const std::string& key, glm::ivec2 otherwise, std::int64_t min, std::int64_t max);

    /// Calls `read(item, pointer)` for every item of the array; an absent member is empty.
    void each(const std::string& key, const std::function<void(const Json&, const std::string&)>& read);

    /// Members that were not taken, in their order.
    Json rest() const;

    [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

  private:
    const Json& object_;
    std::string file_, pointer_;
    std::set<std::string> known_;
};

}  // namespace ir::projects
