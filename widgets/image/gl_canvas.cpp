#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>
#include <QOpenGLWidget>
#include <algorithm>
#include <memory>
#include <vector>

#include "renderers/image/colour_map.h"
#include "widgets/image/canvas.h"
#include "widgets/image/view_shader.h"

namespace ir::widgets {
namespace {

/// Textures by the object that they were made from. They live as long as it, the last few at most.
class TextureCache {
  public:
    /// The texture of `source`; 0: there is none.
    GLuint find(const std::shared_ptr<const void>& source) {
        const auto known = std::find_if(entries_.begin(), entries_.end(),
                                        [&](const Entry& entry) { return entry.source.lock() == source; });
        if (known == entries_.end()) return 0;
        std::rotate(known, known + 1, entries_.end());
        return entries_.back().texture;
    }
    /// A new texture for `source`, without contents.
    GLuint add(QOpenGLExtraFunctions& gl, const std::shared_ptr<const void>& source) {
        const auto drop = [&](const Entry& entry) { gl.glDeleteTextures(1, &entry.texture); };
        std::erase_if(entries_, [&](const Entry& entry) {
            if (entry.source.expired()) drop(entry);
            return entry.source.expired();
        });
        if (entries_.size() >= remembered) {
            drop(entries_.front());
            entries_.erase(entries_.begin());
        }
        entries_.push_back({source, 0});
        gl.glGenTextures(1, &entries_.back().texture);
        return entries_.back().texture;
    }
    bool empty() const { return entries_.empty(); }
    void clear(QOpenGLExtraFunctions* gl) {
        if (gl)
            for (const auto& entry : entries_) gl->glDeleteTextures(1, &entry.texture);
        entries_.clear();
    }

  private:
    static constexpr std::size_t remembered = 20;  // ten pictures with their covers
    struct Entry {
        std::weak_ptr<const void> source;
        GLuint texture;
    };
    std::vector<Entry> entries_;
};

class GlCanvas final : public QOpenGLWidget, public Canvas {
  public:
    GlCanvas(const CanvasState& state, QWidget* parent) : QOpenGLWidget(parent), state_(state) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
        QSurfaceFormat wanted;
        wanted.setVersion(3, 3);
        wanted.setProfile(QSurfaceFormat::CoreProfile);
        setFormat(wanted);
    }
    ~GlCanvas() override {
        // QOpenGLWidget ends the context after this part of the object: release() would be called without it.
        if (context()) disconnect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &GlCanvas::release);
        release();
    }
    QWidget* widget() override { return this; }
    void state_changed() override {
        if (!state_.has_image() && program_ && !textures_.empty()) {  // a hidden pane needs no memory
            makeCurrent();
            textures_.clear(context()->extraFunctions());
            doneCurrent();
        }
        update();
    }
    const char* kind() const override { return "OpenGL"; }
    int upload_count() const override { return upload_count_; }

  protected:
    // Qt destroys the context when the widget moves to another window, so everything is made again here.
    void initializeGL() override {
        connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &GlCanvas::release,
                Qt::UniqueConnection);
        program_ = std::make_unique<QOpenGLShaderProgram>();
        program_->addShaderFromSourceCode(QOpenGLShader::Vertex, view_shader::vertex);
        program_->addShaderFromSourceCode(QOpenGLShader::Fragment, view_shader::fragment);
        if (!program_->link()) qWarning("view shader: %s", qPrintable(program_->log()));
        vertices_ = std::make_unique<QOpenGLVertexArrayObject>();
        vertices_->create();
        context()->extraFunctions()->glGenTextures(1, &map_texture_);
        map_.clear();
    }
    void paintGL() override {
        auto& gl = *context()->extraFunctions();
        gl.glDisable(GL_SCISSOR_TEST);
        gl.glClearColor(surround_colour.redF(), surround_colour.greenF(), surround_colour.blueF(), 1);
        gl.glClear(GL_COLOR_BUFFER_BIT);
        if (!state_.has_image() || !program_ || !program_->isLinked()) return;
        program_->bind();
        vertices_->bind();
        gl.glDisable(GL_DEPTH_TEST);
        gl.glDisable(GL_BLEND);
        gl.glEnable(GL_SCISSOR_TEST);
        const QSize view = state_.transform.view_size().toSize();
        const int x = state_.divider_x();
        draw_picture(gl, state_.pictures[0], {0, 0, x, view.height()});
        if (const QRect area = state_.second_area(); !area.isEmpty())
            draw_picture(gl, state_.pictures[1], area);
        gl.glDisable(GL_SCISSOR_TEST);
        vertices_->release();
        program_->release();
        gl.glActiveTexture(GL_TEXTURE0);
    }

  private:
    enum Unit { picture_unit, map_unit, cover_unit };

    void release() {
        if (!program_) return;
        makeCurrent();
        program_.reset();
        vertices_.reset();
        textures_.clear(context() ? context()->extraFunctions() : nullptr);
        if (context()) context()->extraFunctions()->glDeleteTextures(1, &map_texture_);
        doneCurrent();
    }
    static void bind(QOpenGLExtraFunctions& gl, Unit unit, GLuint texture) {
        gl.glActiveTexture(GL_TEXTURE0 + unit);
        gl.glBindTexture(GL_TEXTURE_2D, texture);
    }
    static void prepare_upload(QOpenGLExtraFunctions& gl) {
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    }
    void use_image(QOpenGLExtraFunctions& gl, const std::shared_ptr<const Image>& image) {
        static constexpr GLint internal[] = {GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F};
        static constexpr GLenum layout[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
        const GLuint known = textures_.find(image);
        bind(gl, picture_unit, known ? known : textures_.add(gl, image));
        if (known) return;
        prepare_upload(gl);
        gl.glTexImage2D(GL_TEXTURE_2D, 0, internal[image->channels - 1], image->width, image->height, 0,
                        layout[image->channels - 1], GL_FLOAT, image->pixels.data());
        ++upload_count_;
    }
    void use_cover(QOpenGLExtraFunctions& gl, const PreparedPicture& picture) {
        if (!picture.cover) return;
        const GLuint known = textures_.find(picture.cover);
        bind(gl, cover_unit, known ? known : textures_.add(gl, picture.cover));
        if (known) return;
        prepare_upload(gl);
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, picture.shown->width, picture.shown->height, 0, GL_RED,
                        GL_UNSIGNED_BYTE, picture.cover->data());
        ++upload_count_;
    }
    void use_map(QOpenGLExtraFunctions& gl, const Display& display) {
        bind(gl, map_unit, map_texture_);
        auto map = colours_of(display);
        if (map == map_) return;
        prepare_upload(gl);
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, int(map.size()), 1, 0, GL_RGB, GL_UNSIGNED_BYTE,
                        map.data());
        map_ = std::move(map);
    }
    void set_place() {
        const auto& t = state_.transform;
        auto& p = *program_;
        p.setUniformValue("offset_px", QVector2D(t.offset()));
        p.setUniformValue("zoom", float(t.zoom()));
        p.setUniformValue("view_height", float(t.view_size().height()));
        p.setUniformValue("pattern_half", pattern_half(devicePixelRatioF()));
        p.setUniformValue(
            "surround", QVector3D(surround_colour.redF(), surround_colour.greenF(), surround_colour.blueF()));
    }
    void set_display(const Display& d) {
        auto& p = *program_;
        p.setUniformValue("exposure", float(d.exposure));
        p.setUniformValue("low", float(d.low));
        p.setUniformValue("high", float(d.high));
        p.setUniformValue("mode", int(d.mode));
        p.setUniformValue("tone_map", int(d.tone_map));
        p.setUniformValue("channel", d.channel);
        p.setUniformValue("mark_bad", d.mark_bad);
        p.setUniformValue("negative_is_bad", d.negative_is_bad);
        p.setUniformValue("zebra", d.zebra);
        p.setUniformValue("hide_invalid", d.hide_invalid);
        p.setUniformValue("grey_zero", d.grey_zero);
        p.setUniformValue("zero_grey", QVector3D(zero_grey[0], zero_grey[1], zero_grey[2]) / 255.0f);
    }
    void draw_picture(QOpenGLExtraFunctions& gl, const PreparedPicture& picture, const QRect& area) {
        if (area.isEmpty()) return;
        use_image(gl, picture.shown);
        use_cover(gl, picture);
        use_map(gl, picture.display);
        auto& p = *program_;
        p.setUniformValue("picture", int(picture_unit));
        p.setUniformValue("colour_map", int(map_unit));
        p.setUniformValue("cover_map", int(cover_unit));
        p.setUniformValue("covered", picture.cover != nullptr);
        p.setUniformValue("picture_px", QVector2D(float(picture.shown->width), float(picture.shown->height)));
        p.setUniformValue("channels", picture.shown->channels);
        set_place();
        set_display(picture.display);
        const int view_height = state_.transform.view_size().toSize().height();
        gl.glScissor(area.x(), view_height - area.y() - area.height(), area.width(), area.height());
        gl.glDrawArrays(GL_TRIANGLES, 0, 3);
    }

    const CanvasState& state_;
    std::unique_ptr<QOpenGLShaderProgram> program_;
    std::unique_ptr<QOpenGLVertexArrayObject> vertices_;
    TextureCache textures_;
    GLuint map_texture_ = 0;
    ColourMap map_;
    int upload_count_ = 0;
};

}  // namespace

bool has_opengl() {
    static const bool found = [] {
        // Beside an X server it makes contexts, but widgets that draw with one crash in Qt when it is shown.
        if (QGuiApplication::platformName() == QLatin1String("offscreen")) return false;
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
