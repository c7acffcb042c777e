#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

/// One source is one target of libFuzzer: it gives LLVMFuzzerTestOneInput, and ends by a signal or an
/// exception where something does not hold that must hold for any input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace ir::fuzz {

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// A folder of this process in memory.
const std::filesystem::path& folder();
/// A file in it with these bytes.
std::string write_input(const std::string& name, const std::uint8_t* data, std::size_t size);

}  // namespace ir::fuzz
