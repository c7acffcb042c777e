#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ir::scene::gltf {

using Json = nlohmann::json;

/// Reads one object of an untrusted document. Every value that is asked for is checked for type and range and
/// copied to `result`; nothing else is, so that only checked values reach tinygltf. Throws InputError naming
/// the file and the place ("accessors[3].sparse.count").
class CheckedObject {
  public:
    CheckedObject(const std::string& file, std::string place, const Json& object);

    /// Absent members give nullopt.
    std::optional<std::int64_t> integer(const char* key, std::int64_t low, std::int64_t high);
    std::optional<int> index(const char* key, std::size_t count, const char* what);
    std::optional<double> number(const char* key);
    std::optional<std::vector<double>> numbers(const char* key, std::size_t count);
    std::optional<std::vector<int>> indices(const char* key, std::size_t count, const char* what);
    std::optional<std::string> text(const char* key);
    std::optional<bool> boolean(const char* key);

    /// Nested values, unchecked and not copied; null when absent.
    const Json* object(const char* key) const;
    const Json* array(const char* key) const;
    /// extensions.NAME where it is an object; null when absent.
    const Json* extension(const char* name) const;
    /// A nested object; throws when absent.
    const Json& required_object(const char* key) const;

    /// The value of an optional, which the document must have.
    template <class T>
    T required(std::optional<T> value, const char* key) const {
        if (!value) fail(key, "is missing; export the file again");
        return *value;
    }

    std::string place(const std::string& key) const { return place_.empty() ? key : place_ + "." + key; }
    const std::string& place() const { return place_; }
    [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

    Json result = Json::object();

  private:
    const Json* find(const char* key) const;
    std::int64_t whole(const Json& value, const std::string& key, std::int64_t low, std::int64_t high) const;
    double finite(const Json& value, const std::string& key) const;

    const std::string& file_;
    std::string place_;
    const Json& object_;
};

/// "meshes[3]"
std::string element(const std::string& array, std::size_t index);

}  // namespace ir::scene::gltf
