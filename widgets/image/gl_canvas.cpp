#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>
#include <QOpenGLWidget>
#include <memory>

#include "renderers/image/colour_map.h"
#include "widgets/image/canvas.h"

namespace ir::widgets {
namespace {

// A triangle over the whole viewport; the picture's pixel is found from gl_FragCoord, so zoomed pixels have
// exact edges. This is a widget's own drawing, not a rendering pass, so it stands here.
constexpr const char* vertex_source = R"(#version 330 core
void main() {
    vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
)";

constexpr const char* fragment_source = R"(#version 330 core
uniform sampler2D picture, colour_map;
uniform vec2 offset_px, picture_px;   // device pixels, from the top left; pixels of the picture
uniform float zoom, view_height, exposure, low, high;
uniform int mode, channels, channel;
uniform bool mark_bad, negative_is_bad;
uniform vec3 surround;
out vec4 colour;

vec3 srgb(vec3 v) {
    v = clamp(v, 0.0, 1.0);
    return mix(1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, 12.92 * v, lessThanEqual(v, vec3(0.0031308)));
}
float fraction(float v) {
    return high == low ? (v > low ? 1.0 : 0.0) : clamp((v - low) / (high - low), 0.0, 1.0);
}
// Knuth's multiplicative hash, one octet per component.
vec3 id_colour(float v) {
    uint h = uint(int(v)) * 2654435761u;
    h ^= h >> 15u;
    h *= 2246822519u;
    h ^= h >> 13u;
    return vec3(64u + (h & 127u), 64u + ((h >> 8u) & 127u), 64u + ((h >> 16u) & 127u)) / 255.0;
}
vec3 shade(vec4 texel) {
    int count = min(channels, 3);
    if (channel >= 0) {
        texel = vec4(texel[min(channel, 3)]);
        count = 1;
    }
    vec3 v = count == 1 ? texel.xxx : count == 2 ? vec3(texel.xy, 0.0) : texel.xyz;
    if (mark_bad) {
        if (any(isnan(v))) return vec3(1.0, 0.0, 1.0);
        bvec3 infinite = isinf(v);
        if (any(infinite) && max(v.x, max(v.y, v.z)) > 3e38) return vec3(1.0, 1.0, 0.0);
        if (any(infinite)) return vec3(0.0, 1.0, 1.0);
        if (negative_is_bad && any(lessThan(v, vec3(0.0)))) return vec3(40.0, 80.0, 255.0) / 255.0;
    }
    if (mode == 0) return srgb(v * exp2(exposure));
    if (mode == 1) return vec3(fraction(v.x), fraction(v.y), fraction(v.z));
    if (mode == 2) return texelFetch(colour_map, ivec2(int(fraction(v.x) * 255.0 + 0.5), 0), 0).rgb;
    return id_colour(v.x);
}
void main() {
    vec2 view = vec2(gl_FragCoord.x, view_height - gl_FragCoord.y);
    vec2 pixel = (view - offset_px) / zoom;
    if (any(lessThan(pixel, vec2(0.0))) || any(greaterThanEqual(pixel, picture_px))) {
        colour = vec4(surround, 1.0);
        return;
    }
    if (zoom >= 1.0) {
        colour = vec4(shade(texelFetch(picture, ivec2(pixel), 0)), 1.0);
        return;
    }
    // Smaller than life: the mean of the colours of a few pixels in the footprint, so that marks survive.
    int taps = min(int(ceil(1.0 / zoom)), 8);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < taps; ++j)
        for (int i = 0; i < taps; ++i) {
            vec2 at = pixel + ((vec2(i, j) + 0.5) / float(taps) - 0.5) / zoom;
            sum += shade(texelFetch(picture, ivec2(clamp(at, vec2(0.0), picture_px - 1.0)), 0));
        }
    colour = vec4(sum / float(taps * taps), 1.0);
}
)";

class GlCanvas final : public QOpenGLWidget, public Canvas {
  public:
    GlCanvas(const CanvasState& state, QWidget* parent) : QOpenGLWidget(parent), state_(state) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
        QSurfaceFormat wanted;
        wanted.setVersion(3, 3);
        wanted.setProfile(QSurfaceFormat::CoreProfile);
        setFormat(wanted);
    }
    ~GlCanvas() override { release(); }
    QWidget* widget() override { return this; }
    void image_changed() override {
        picture_outdated_ = map_outdated_ = true;
        update();
    }
    void display_changed() override {
        map_outdated_ = true;
        update();
    }
    const char* kind() const override { return "OpenGL"; }

  protected:
    // Qt destroys the context when the widget moves to another window, so everything is made again here.
    void initializeGL() override {
        connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &GlCanvas::release,
                Qt::UniqueConnection);
        program_ = std::make_unique<QOpenGLShaderProgram>();
        program_->addShaderFromSourceCode(QOpenGLShader::Vertex, vertex_source);
        program_->addShaderFromSourceCode(QOpenGLShader::Fragment, fragment_source);
        if (!program_->link()) qWarning("view shader: %s", qPrintable(program_->log()));
        vertices_ = std::make_unique<QOpenGLVertexArrayObject>();
        vertices_->create();
        context()->extraFunctions()->glGenTextures(2, textures_);
        picture_outdated_ = map_outdated_ = true;
    }
    void paintGL() override {
        auto& gl = *context()->extraFunctions();
        gl.glClearColor(surround_colour.redF(), surround_colour.greenF(), surround_colour.blueF(), 1);
        gl.glClear(GL_COLOR_BUFFER_BIT);
        if (!state_.shown.empty() && program_ && program_->isLinked()) draw_picture(gl);
    }

  private:
    void release() {
        if (!program_) return;
        makeCurrent();
        program_.reset();
        vertices_.reset();
        if (context()) context()->extraFunctions()->glDeleteTextures(2, textures_);
        doneCurrent();
    }
    void prepare_texture(QOpenGLExtraFunctions& gl, int unit) {
        gl.glActiveTexture(GL_TEXTURE0 + unit);
        gl.glBindTexture(GL_TEXTURE_2D, textures_[unit]);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    }
    void upload_picture(QOpenGLExtraFunctions& gl) {
        static constexpr GLint internal[] = {GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F};
        static constexpr GLenum layout[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
        const Image& image = state_.shown;
        gl.glTexImage2D(GL_TEXTURE_2D, 0, internal[image.channels - 1], image.width, image.height, 0,
                        layout[image.channels - 1], GL_FLOAT, image.pixels.data());
        picture_outdated_ = false;
    }
    void upload_map(QOpenGLExtraFunctions& gl) {
        const auto& map = colour_map(state_.display.colour_map);
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, int(map.size()), 1, 0, GL_RGB, GL_UNSIGNED_BYTE,
                        map.data());
        map_outdated_ = false;
    }
    void set_uniforms() {
        const auto& t = state_.transform;
        const Display& d = state_.display;
        auto& p = *program_;
        p.setUniformValue("picture", 0);
        p.setUniformValue("colour_map", 1);
        p.setUniformValue("offset_px", QVector2D(t.offset()));
        p.setUniformValue("picture_px", QVector2D(float(state_.shown.width), float(state_.shown.height)));
        p.setUniformValue("zoom", float(t.zoom()));
        p.setUniformValue("view_height", float(t.view_size().height()));
        p.setUniformValue("exposure", float(d.exposure));
        p.setUniformValue("low", float(d.low));
        p.setUniformValue("high", float(d.high));
        p.setUniformValue("mode", int(d.mode));
        p.setUniformValue("channels", state_.shown.channels);
        p.setUniformValue("channel", state_.image.channels > 4 ? -1 : d.channel);
        p.setUniformValue("mark_bad", d.mark_bad);
        p.setUniformValue("negative_is_bad", d.negative_is_bad);
        p.setUniformValue(
            "surround", QVector3D(surround_colour.redF(), surround_colour.greenF(), surround_colour.blueF()));
    }
    void draw_picture(QOpenGLExtraFunctions& gl) {
        program_->bind();
        vertices_->bind();
        prepare_texture(gl, 0);
        if (picture_outdated_) upload_picture(gl);
        prepare_texture(gl, 1);
        if (map_outdated_) upload_map(gl);
        set_uniforms();
        gl.glDisable(GL_DEPTH_TEST);
        gl.glDisable(GL_BLEND);
        gl.glDrawArrays(GL_TRIANGLES, 0, 3);
        vertices_->release();
        program_->release();
        gl.glActiveTexture(GL_TEXTURE0);
    }

    const CanvasState& state_;
    std::unique_ptr<QOpenGLShaderProgram> program_;
    std::unique_ptr<QOpenGLVertexArrayObject> vertices_;
    GLuint textures_[2] = {0, 0};
    bool picture_outdated_ = true, map_outdated_ = true;
};

}  // namespace

bool has_opengl() {
    static const bool found = [] {
        QSurfaceFormat wanted;
        wanted.setVersion(3, 3);
        wanted.setProfile(QSurfaceFormat::CoreProfile);
        QOpenGLContext context;
        context.setFormat(wanted);
        if (!context.create()) return false;
        QOffscreenSurface surface;
        surface.setFormat(context.format());
        surface.create();
        if (!surface.isValid() || !context.makeCurrent(&surface)) return false;
        const auto version = context.format().version();
        context.doneCurrent();
        return version >= qMakePair(3, 3);
    }();
    return found;
}

Canvas* make_gl_canvas(const CanvasState& state, QWidget* parent) {
    return new GlCanvas(state, parent);
}

Canvas* make_canvas(const CanvasState& state, QWidget* parent) {
    return has_opengl() ? make_gl_canvas(state, parent) : make_raster_canvas(state, parent);
}

}  // namespace ir::widgets
