#pragma once

#include "renderers/passes/viewers/scene_3d.h"
#include "renderers/passes/viewers/tools.h"

namespace ir::passes::viewers {

/// The images that a 3D view is drawn to: colour, which layer and element, depth.
class Target {
  public:
    explicit Target(const Tools& tools) : api_(tools.api), device_(tools.device), programs_(tools.programs) {}
    ~Target() { release(); }
    Target(const Target&) = delete;

    /// Makes the images where the size has changed, binds and clears them.
    /// `oversampling` samples along a side of each pixel.
    void begin(int width, int height, int oversampling);
    /// Binds and clears what translucent fragments are summed in, with the depths of what is drawn already.
    void begin_translucent();
    /// Binds the picture again; what was summed is in weighted() and optical_depth().
    void end_translucent() const;
    /// Unbinds them.
    void end() const;
    /// Averages the samples and brings colours and ids to the host.
    void read(Picture3D& picture);

    /// An image of unsigned numbers of the same size: element plus 1 at each pixel.
    gl::Name regions();
    gl::Name depth() const { return depth_; }
    gl::Name weighted() const { return weighted_; }
    gl::Name optical_depth() const { return optical_depth_; }

  private:
    void release();
    void make(int width, int height);
    GLuint make_framebuffer(gl::Name first, gl::Name second) const;
    void average();
    const gl::Api& api_;
    gl::Device& device_;
    gl::ProgramLibrary& programs_;
    int width_ = 0, height_ = 0, oversampling_ = 1;
    gl::Name colour_ = 0, ids_ = 0, depth_ = 0, regions_ = 0;  ///< of samples
    gl::Name weighted_ = 0, optical_depth_ = 0;                ///< of translucent fragments, see put.glsl
    gl::Name mean_colour_ = 0, mean_ids_ = 0;                  ///< of pixels, where they have several samples
    GLuint framebuffer_ = 0, translucent_ = 0;
};

}  // namespace ir::passes::viewers
