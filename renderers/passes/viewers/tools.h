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

/// Constants of shaders/passes/viewers/layer.glsl.
struct Eye {
    glm::vec3 eye_ws, view_axis_ws;
    bool orthographic;
    IR_FIELDS(eye_ws, view_axis_ws, orthographic)
};
Eye eye(const Sight& sight);

/// Constants of project.glsl, which goes with layer.glsl.
struct Projection {
    Eye eye;
    glm::mat4 clip_from_world;
    glm::vec2 size_px;
    float min_w;
    IR_FIELDS(eye, clip_from_world, size_px, min_w)
};
Projection projection(const Sight& sight);

/// Constants of shade.glsl.
struct Shade {
    glm::vec3 shade_eye_ws, shade_axis_ws, shade_light_ws;
    bool shade_orthographic;
    IR_FIELDS(shade_eye_ws, shade_axis_ws, shade_light_ws, shade_orthographic)
};
Shade shade(const Sight& sight);

}  // namespace ir::passes::viewers
