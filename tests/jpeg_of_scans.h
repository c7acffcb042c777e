#pragma once

#include <cstdint>
#include <string>

namespace ir::test {

/// The markers of a JPEG file of 64×48 pixels with so many scans, without their data.
inline std::string jpeg_of_scans(int scans) {
    using namespace std::string_literals;
    auto bytes = "\xff\xd8\xff\xe1\0\x06\xff\xda\xff\xda"s;    // two within another segment are none
    bytes += "\xff\xc2\0\x0b\x08\0\x30\0\x40\x01\x01\x11\0"s;  // progressive, one component
    for (int i = 0; i < scans; ++i) bytes += "\xff\xda\0\x08\x01\x01\0\x01\x3f\0\x55\xff\0\x55"s;
    return bytes + "\xff\xd9"s;
}

}  // namespace ir::test
