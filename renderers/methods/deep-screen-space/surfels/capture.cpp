#include "renderers/methods/deep-screen-space/surfels/capture.h"

namespace ir::methods::deep_screen_space {

Capture::Capture(const gl::Api& gl, GLuint buffer, std::int64_t bytes) : gl_(gl) {
    gl_.CreateTransformFeedbacks(1, &name_);
    gl_.TransformFeedbackBufferRange(name_, 0, buffer, 0, bytes);
    gl_.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, name_);
    gl_.BeginTransformFeedback(GL_POINTS);
    pause();
}

Capture::~Capture() {
    gl_.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, name_);
    gl_.EndTransformFeedback();
    gl_.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    gl_.DeleteTransformFeedbacks(1, &name_);
}

void Capture::resume() {
    gl_.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, name_);
    gl_.ResumeTransformFeedback();
}

void Capture::pause() {
    gl_.PauseTransformFeedback();
    gl_.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
}

}  // namespace ir::methods::deep_screen_space
