#pragma once

#include <QColor>
#include <QRectF>
#include <vector>

#include "widgets/image/camera_motion.h"

class QPainter;

namespace ir::widgets {

/// What is marked in world space over the picture of a 3D view, in front of all that is drawn.
struct SpaceMarks {
    struct Line {
        std::vector<glm::dvec3> points;
        QColor colour;
        double width = 1.5;  ///< logical pixels
        bool operator==(const Line&) const = default;
    };
    struct Pin {
        glm::dvec3 place{0};
        QColor colour;
        int number = 1;
        bool operator==(const Pin&) const = default;
    };
    std::vector<Line> lines;
    std::vector<Pin> pins;
    bool operator==(const SpaceMarks&) const = default;
};

/// The edges of what a camera sees, up to a distance from its eye in metres, with a tick on the upper side.
std::vector<SpaceMarks::Line> frustum(const CameraPose& pose, double aspect, double distance,
                                      const QColor& colour, double width);

/// `area` is the picture's, logical pixels. What lies behind the camera is left out.
void paint_marks(QPainter& painter, const SpaceMarks& marks, const CameraPose& camera, const QRectF& area);

}  // namespace ir::widgets
