#pragma once

#include <memory>

namespace ir {

/// Allocator of vectors whose elements begin with no value: threads that fill them touch the memory first.
template <class T>
struct Uninitialised : std::allocator<T> {
    template <class U>
    struct rebind {
        using other = Uninitialised<U>;
    };
    template <class U>
    void construct(U* at) {
        ::new (static_cast<void*>(at)) U;
    }
};

}  // namespace ir
