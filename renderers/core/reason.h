#pragma once

#include <exception>
#include <new>
#include <string>

namespace ir {

/// Why something failed, in one line for people, also where no memory was left.
inline std::string reason_of(const std::exception& error) {
    return dynamic_cast<const std::bad_alloc*>(&error)
               ? "out of memory; lower the image size or the method's sizes"
               : error.what();
}

}  // namespace ir
