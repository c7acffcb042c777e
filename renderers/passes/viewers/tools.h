#pragma once

#include <cstddef>
#include <span>

#include "renderers/gl/device.h"
#include "renderers/gl/program.h"
#include "renderers/scene/view.h"

namespace ir::passes::viewers {

/// What every part of the viewer draws with.
struct Tools {
    const gl::Api& api;
    gl::Device& device;
    gl::ProgramLibrary& programs;
};

/// A buffer on the device that is made anew when its size changes.
class DeviceStore {
  public:
    explicit DeviceStore(gl::Device& device) : device_(device) {}
    ~DeviceStore() { release(); }
    DeviceStore(const DeviceStore&) = delete;
    gl::Name name() const { return name_; }
    void write(std::span<const std::byte> bytes, const char* label) {
        reserve(bytes.size(), label);
        device_.write_buffer(name_, 0, bytes);
    }

    void reserve(std::size_t bytes, const char* label) {
        if (bytes == bytes_ && name_) return;
        release();
        name_ = device_.create_buffer(bytes, label);
        bytes_ = bytes;
    }

  private:
    void release() {
        if (name_) device_.destroy_buffer(name_);
        name_ = 0;
    }
    gl::Device& device_;
    gl::Name name_ = 0;
    std::size_t bytes_ = 0;
};

/// A view and what shaders want to know of it.
struct Sight {
    scene::View view;       ///< its size in samples
    int pixel_samples = 1;  ///< along a side of a pixel
    bool orthographic = false;
    glm::vec3 axis_ws{0, 0, -1};  ///< of view
    glm::vec3 light_ws{0, 0, 1};  ///< towards the light that shades, unit length
};

/// Width and height in pixels.
Sight make_sight(const scene::Camera& camera, int width, int height, int oversampling,
                 const scene::Bounds& bounds);

/// The uniforms of shaders/passes/viewers/project.glsl, shade.glsl, and the eye of layer.glsl.
void set_projection(const gl::Program& program, const Sight& sight);
void set_shade(const gl::Program& program, const Sight& sight);
void set_eye(const gl::Program& program, const Sight& sight);

}  // namespace ir::passes::viewers
