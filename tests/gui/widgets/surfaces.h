#pragma once

#include <gtest/gtest.h>

#include <QTest>

#include "widgets/image/image_view.h"

namespace ir::widgets {

inline void show(QWidget& widget, QSize size = {320, 240}) {
    widget.resize(size);
    widget.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&widget));
}

/// On both surfaces that pictures are drawn on; the parameter says whether on OpenGL.
class SurfaceTest : public testing::TestWithParam<bool> {
  protected:
    void SetUp() override {
        if (GetParam() && !has_opengl())
            GTEST_SKIP() << "Qt has no OpenGL here; start under a virtual X server";
    }
    ImageView::Surface surface() const {
        return GetParam() ? ImageView::Surface::best : ImageView::Surface::raster;
    }
};

inline std::string surface_name(const testing::TestParamInfo<bool>& info) {
    return info.param ? "OpenGL" : "raster";
}

}  // namespace ir::widgets
