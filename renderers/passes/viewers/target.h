#pragma once

#include <glm/glm.hpp>

#include "renderers/gl/device.h"
#include "renderers/passes/viewers/scene_3d.h"

namespace ir::passes::viewers {

/// The images that a 3D view is drawn to: colour, which layer and element, depth.
class Target {
  public:
    Target(const gl::Api& api, gl::Device& device) : api_(api), device_(device) {}
    ~Target() { release(); }
    Target(const Target&) = delete;

    /// Makes the images where the size has changed, binds and clears them.
    void begin(int width, int height);
    /// Unbinds them.
    void end() const;
    /// Brings colours and ids to the host.
    void read(Picture3D& picture) const;

    /// An image of unsigned numbers of the same size: element plus 1 at each pixel.
    gl::Name regions();

  private:
    void release();
    void make(int width, int height);
    const gl::Api& api_;
    gl::Device& device_;
    gl::ImageShape colour_shape_, id_shape_, depth_shape_, region_shape_;
    gl::Name colour_ = 0, ids_ = 0, depth_ = 0, regions_ = 0;
    GLuint framebuffer_ = 0;
};

}  // namespace ir::passes::viewers
