#pragma once

#include <cstdint>

#include "renderers/gl/context.h"

namespace ir::methods::deep_screen_space {

/// Transform feedback that goes on over several draws with other work between them. Of a thread whose context
/// is current.
class Capture {
  public:
    /// Into the first `bytes` of `buffer`; the program that is captured must be in use.
    Capture(const gl::Api& gl, GLuint buffer, std::int64_t bytes);
    ~Capture();
    Capture(const Capture&) = delete;

    /// Between them draws are captured, with the first program in use.
    void resume();
    void pause();

  private:
    const gl::Api& gl_;
    GLuint name_ = 0;
};

}  // namespace ir::methods::deep_screen_space
