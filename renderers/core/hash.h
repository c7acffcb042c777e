#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace ir {

/// XXH3-128 of bytes that come in parts.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    void add(std::span<const std::byte> bytes);
    /// 32 lower-case hexadecimal digits.
    std::string hexadecimal() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// XXH3-128 as 32 lower-case hexadecimal digits.
std::string hash_bytes(std::string_view bytes);

}  // namespace ir
