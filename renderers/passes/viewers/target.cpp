#include "renderers/passes/viewers/target.h"

#include <cstring>
#include <span>

#include "renderers/core/error.h"
#include "renderers/image/colour_map.h"

namespace ir::passes::viewers {

namespace {

gl::ImageShape shape(int width, int height, gl::Format format) {
    gl::ImageShape made;
    made.width = width;
    made.height = height;
    made.format = format;
    return made;
}

/// Constants of average.comp.
struct Average {
    int oversampling;
    IR_FIELDS(oversampling)
};

}  // namespace

void Target::release() {
    for (auto* framebuffer : {&framebuffer_, &translucent_}) {
        if (*framebuffer) api_.DeleteFramebuffers(1, framebuffer);
        *framebuffer = 0;
    }
    for (auto* image :
         {&colour_, &ids_, &depth_, &regions_, &weighted_, &optical_depth_, &mean_colour_, &mean_ids_}) {
        if (*image) device_.destroy_image(*image);
        *image = 0;
    }
}

GLuint Target::make_framebuffer(gl::Name first, gl::Name second) const {
    GLuint framebuffer = 0;
    api_.CreateFramebuffers(1, &framebuffer);
    api_.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, first, 0);
    api_.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT1, second, 0);
    api_.NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth_, 0);
    const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    api_.NamedFramebufferDrawBuffers(framebuffer, 2, buffers);
    if (api_.CheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE)
        return framebuffer;
    api_.DeleteFramebuffers(1, &framebuffer);
    throw Error("the driver cannot draw a 3D view of this size");
}

void Target::make(int width, int height) {
    colour_ = device_.create_image(shape(width, height, gl::Format::rgba32f), "3D view, colour");
    ids_ = device_.create_image(shape(width, height, gl::Format::rg32ui), "3D view, layer and element");
    depth_ = device_.create_image(shape(width, height, gl::Format::depth32f), "3D view, depth");
    framebuffer_ = make_framebuffer(colour_, ids_);
}

void Target::begin(int width, int height, int oversampling) {
    const int across = width * oversampling, down = height * oversampling;
    if (!framebuffer_ || width_ != width || height_ != height || oversampling_ != oversampling) {
        release();
        make(across, down);
        width_ = width;
        height_ = height;
        oversampling_ = oversampling;
    }
    api_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    api_.Viewport(0, 0, across, down);
    const float grey = linear_from_srgb(surround_code / 255.0f);
    const float background[4] = {grey, grey, grey, 1}, far = 1;
    const GLuint nothing[4] = {0, 0, 0, 0};
    api_.ClearBufferfv(GL_COLOR, 0, background);
    api_.ClearBufferuiv(GL_COLOR, 1, nothing);
    api_.ClearBufferfv(GL_DEPTH, 0, &far);
}

void Target::begin_translucent() {
    const int across = width_ * oversampling_, down = height_ * oversampling_;
    if (!translucent_) {
        // Where one cannot be made the next try finds the other.
        if (!weighted_)
            weighted_ = device_.create_image(shape(across, down, gl::Format::rgba32f),
                                             "3D view, translucent colours");
        if (!optical_depth_)
            optical_depth_ =
                device_.create_image(shape(across, down, gl::Format::r32f), "3D view, optical depth");
        translucent_ = make_framebuffer(weighted_, optical_depth_);
    }
    api_.BindFramebuffer(GL_FRAMEBUFFER, translucent_);
    const float nothing[4] = {0, 0, 0, 0};
    api_.ClearBufferfv(GL_COLOR, 0, nothing);
    api_.ClearBufferfv(GL_COLOR, 1, nothing);
}

void Target::end_translucent() const {
    api_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
}

void Target::end() const {
    api_.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

gl::Name Target::regions() {
    if (!regions_)
        regions_ =
            device_.create_image(shape(width_ * oversampling_, height_ * oversampling_, gl::Format::r32ui),
                                 "3D view, regions of a sphere");
    return regions_;
}

void Target::average() {
    if (!mean_colour_) {
        mean_colour_ =
            device_.create_image(shape(width_, height_, gl::Format::rgba32f), "3D view, mean colour");
        mean_ids_ =
            device_.create_image(shape(width_, height_, gl::Format::rg32ui), "3D view, ids of pixels");
    }
    const auto& program = programs_.get({{"passes/viewers/average.comp"}});
    program.use();
    program.bind_texture("colour_samples", colour_);
    program.bind_texture("id_samples", ids_);
    program.bind_image("colours", mean_colour_, gl::Format::rgba32f);
    program.bind_image("ids", mean_ids_, gl::Format::rg32ui);
    program.set(Average{oversampling_});
    program.dispatch(width_, height_);
    api_.UseProgram(0);
    api_.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
}

void Target::read(Picture3D& picture) {
    const bool averaged = oversampling_ > 1;
    if (averaged) average();
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    std::vector<glm::vec4> colours(pixels);
    device_.read_image(averaged ? mean_colour_ : colour_, shape(width_, height_, gl::Format::rgba32f), 0, 0,
                       std::as_writable_bytes(std::span(colours)));
    std::vector<glm::uvec2> ids(pixels);
    device_.read_image(averaged ? mean_ids_ : ids_, shape(width_, height_, gl::Format::rg32ui), 0, 0,
                       std::as_writable_bytes(std::span(ids)));
    picture.colour = Image(width_, height_, 3);
    picture.layer.resize(pixels);
    picture.element.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        std::memcpy(&picture.colour.pixels[3 * i], &colours[i], 3 * sizeof(float));
        picture.layer[i] = static_cast<std::int32_t>(ids[i].x) - 1;
        picture.element[i] = ids[i].x == 0 ? -1 : static_cast<std::int64_t>(ids[i].y);
    }
}

}  // namespace ir::passes::viewers
