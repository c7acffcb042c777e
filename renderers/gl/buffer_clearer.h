#pragma once

#include <cstdint>

#include "renderers/gl/context.h"
#include "renderers/gl/device.h"

namespace ir::gl {

/// Writes zeros by a program. Datacentre cards clear buffers as they rasterise, with few of their units: an
/// H200 takes 8 ms for 5 MB by glClearNamedBufferSubData.
class BufferClearer {
  public:
    explicit BufferClearer(Context& context) : context_(context) {}
    ~BufferClearer();
    BufferClearer(const BufferClearer&) = delete;

    /// Whether clear() takes the range: whole words, and a begin that buffers may be bound at.
    bool takes(std::uint64_t offset, std::uint64_t bytes) const;
    /// Program and bindings of the context stay as they are, but that a program which was deleted is current
    /// no more. Throws Error where the driver has no such program.
    void clear(Name buffer, std::uint64_t offset, std::uint64_t bytes);

  private:
    void make_program();

    Context& context_;
    GLuint program_ = 0;
    std::uint64_t group_size_ = 0;  ///< of the program
};

}  // namespace ir::gl
