#include <sstream>

#include "renderers/scene/compose.h"

namespace ir::scene {
namespace {

/// Floats in hexadecimal, which loses nothing.
class KeyWriter {
  public:
    KeyWriter() { text_ << std::hexfloat; }

    void add(const Part& part) {
        text_ << part.source.size() << ':' << part.source;
        if (part.transform != glm::mat4(1))
            for (int column = 0; column < 4; ++column) numbers(part.transform[column]);
        for (const auto& [name, change] : part.materials) {
            text_ << '{' << name.size() << ':' << name;
            for_each_field(change, [this](std::string_view word, const auto& value) {
                if (!value) return;
                text_ << ' ' << word;
                numbers(*value);
            });
            text_ << '}';
        }
        if (!part.motion.keys.empty()) add(part.motion);
        if (!part.variant.empty()) text_ << '<' << part.variant.size() << ':' << part.variant;
        text_ << ';';
    }

    std::string text() const { return text_.str(); }

  private:
    void add(const PartMotion& motion) {
        text_ << (motion.loop ? "[loop" : "[");
        for (const auto& key : motion.keys) {
            numbers(key.time);
            numbers(key.translation);
            const auto& q = key.rotation;
            numbers(glm::vec4(q.x, q.y, q.z, q.w));
            numbers(key.scale);
        }
        text_ << ']';
    }
    void numbers(double number) { text_ << ' ' << static_cast<float>(number); }
    template <glm::length_t n, class Number>
    void numbers(const glm::vec<n, Number>& vector) {
        for (int i = 0; i < n; ++i) numbers(vector[i]);
    }

    std::ostringstream text_;
};

bool is_plain(const std::vector<Part>& parts) {
    return parts.size() == 1 && parts.front() == Part{parts.front().source};
}

}  // namespace

std::string composition_key(const std::vector<Part>& parts) {
    if (is_plain(parts)) return parts.front().source;
    KeyWriter key;
    for (const auto& part : parts) key.add(part);
    return key.text();
}

std::string composition_name(const std::vector<Part>& parts) {
    std::string name;
    for (const auto& part : parts) name += (name.empty() ? "" : " + ") + part.source;
    return name;
}

}  // namespace ir::scene
