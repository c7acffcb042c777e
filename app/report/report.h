#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/compared_sides.h"
#include "renderers/image/image.h"
#include "renderers/plot/plot_data.h"

/// What a report says, whatever it is made from: plain data that write_html() makes a page of.
namespace ir::report {

struct Picture {
    std::string name;
    std::string caption;  ///< a line below it; may be empty
    std::string warning;  ///< "stale: …"; empty: it is what it says
    engine::Side side;    ///< values, valid pixels, and what the file says
};

/// Two pictures that are looked at together, by their places in the gallery.
struct Pair {
    std::size_t a = 0, b = 0;
    std::string name = {}, notes = {};
    std::string mode = "wipe";             ///< as Comparison::mode
    bool is_offered = true;                ///< by a button of its own; metrics are of all
    std::optional<glm::dvec2> range = {};  ///< that colours show; absent: the gallery's own
};

/// What colours show: values from `low` to `high`, brightened by stops.
struct Shown {
    double low = 0, high = 1, exposure = 0;
};

/// Pictures that are looked at together: of one size, wiped and compared pixel by pixel.
struct Gallery {
    std::string title;
    std::vector<Picture> pictures;
    std::vector<Pair> pairs;  ///< measured; the first is what one sees first
    Shown shown = {};
};

struct Cell {
    std::string text;
    std::optional<double> number = {};  ///< in full, beside a text with fewer digits
    bool is_best = false;
    std::string tip = {};  ///< explains it
};

/// The first cell of a row is its heading.
struct Table {
    std::string caption;
    std::vector<Cell> headings;
    std::vector<std::vector<Cell>> rows;
    std::vector<std::string> notes = {};  ///< a line each, below it
};

/// Of each picture of a gallery what its file tells, by key.
struct Settings {
    std::string title;  ///< the gallery's
    Table differing;    ///< the keys that at least two pictures have, with different values
    Table all;
};

struct Plot {
    PlotData data;
    std::string notes, warning;
};

struct Report {
    std::string title, kind;              ///< kind: "Project", "Comparison", "Sweep"
    std::string notes = {};               ///< Markdown as it is written, without note links
    std::vector<std::string> lacks = {};  ///< what is missing or stale, a line each
    std::vector<Gallery> galleries = {};
    std::vector<Table> metrics = {};
    std::vector<Plot> plots = {};
    std::vector<Table> tables = {};       ///< what else there is, such as the variations of a sweep
    std::vector<Settings> settings = {};  ///< of each gallery
    Table provenance = {};
};

}  // namespace ir::report
