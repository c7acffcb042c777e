#include "app/gui/gestures.h"

#include <QObject>

namespace ir::gui {

QList<QPair<QString, QString>> gestures() {
    return {
        {QObject::tr("Zoom the picture about the cursor"), QObject::tr("Wheel")},
        {QObject::tr("Move the picture"), QObject::tr("Middle drag, Space+drag")},
        {QObject::tr("Mark a pixel (Inspect)"), QObject::tr("Click")},
        {QObject::tr("Explain a pixel (Inspect)"), QObject::tr("Shift+click")},
        {QObject::tr("See what can be done at a pixel"), QObject::tr("Right click")},
        {QObject::tr("See one of several pictures (Wipe, Flip, Difference)"), QObject::tr("Hold 1 … 9")},
        {QObject::tr("Choose two of a row to be compared (Stages)"), QObject::tr("1 … 9, 0 for none")},
        {QObject::tr("See one of several pictures alone, and all again (Inspect)"),
         QObject::tr("Double click; Esc")},
        {QObject::tr("Go on to the next picture (Flip)"), QObject::tr("Tab")},
        {QObject::tr("Move the divider (Wipe)"), QObject::tr("Drag it")},
        {QObject::tr("Move, resize what is drawn (Rectangle, Line)"),
         QObject::tr("Drag, arrows; Shift+arrows")},
        {QObject::tr("Clear it (Rectangle, Line)"), QObject::tr("Esc, Del")},
        {QObject::tr("Draw a whole row, a whole column (Line)"), QObject::tr("← →, ↑ ↓")},
        {QObject::tr("Move, turn the chosen light by its handles"), QObject::tr("Drag; Esc takes it back")},
        {QObject::tr("Nudge the chosen light; nearer, farther; turn it"),
         QObject::tr("Arrows; Ctrl+↑ ↓; Alt+arrows")},
        {QObject::tr("Turn, slide, approach, frame (3D)"),
         QObject::tr("Drag, Shift+drag, wheel, double click")},
        {QObject::tr("Choose what an element stands for (3D, sphere)"), QObject::tr("Click it")},
        {QObject::tr("Turn the camera about its target (Orbit)"), QObject::tr("Drag")},
        {QObject::tr("Look around (Fly)"), QObject::tr("Drag")},
        {QObject::tr("Slide the camera (Orbit, Fly)"), QObject::tr("Shift+drag, right drag")},
        {QObject::tr("Camera nearer or farther (Orbit, Fly)"), QObject::tr("Ctrl+wheel")},
        {QObject::tr("Move the camera (Fly)"), QObject::tr("W A S D, Q E; Shift is faster")},
        {QObject::tr("Load a point's or variation's setting (Plots, Sweeps)"), QObject::tr("Click, Enter")},
        {QObject::tr("Zoom all pictures, move them, show all of them (Sweeps)"),
         QObject::tr("Ctrl+wheel, + −; drag; 0")},
        {QObject::tr("Walk through points (Plots)"), QObject::tr("Arrows, Home, End")},
    };
}

}  // namespace ir::gui
