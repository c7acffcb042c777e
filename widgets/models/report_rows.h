#pragma once

#include <QString>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "renderers/core/report.h"
#include "widgets/models/rows_model.h"

namespace ir::widgets {

/// "812 B", "1.5 MiB".
QString bytes_text(std::uint64_t bytes);
/// "0.12", "35", "1200": milliseconds with about three digits.
QString milliseconds_text(double ms);

/// Name of the icon of a kind of buffer.
const char* sign_of(OutputKind kind);

/// The method's results, in the order of `outputs`, then buffers under the passes that write them, the
/// scene's last. Columns: name, size, memory, meaning, format. A row's key is the resource's key; a pass has
/// "pass:NAME", the results have "group:results".
QStringList buffer_headings();
std::vector<Row> buffer_rows(const FrameReport& report, const std::map<std::string, QImage>& thumbnails,
                             const std::string& shown, const std::vector<std::string>& outputs = {});

/// Passes with their times. Columns: pass, queue, gpu ms, cpu ms, slices, memory; the last row is the total.
QStringList timing_headings();
std::vector<Row> timing_rows(const FrameReport& report);

/// Counters. Columns: name, value.
QStringList counter_headings();
std::vector<Row> counter_rows(const FrameReport& report);

/// A scene as the tree shows it: plain data, whoever loaded it.
struct SceneListing {
    struct Node {
        std::string name;
        int parent = -1;  ///< parents stand before their children
        std::size_t triangles = 0;
    };
    std::string name, content_hash;
    std::vector<Node> nodes;
    std::vector<std::string> cameras, lights, materials, warnings;
    std::size_t triangles = 0, textures = 0;
    std::string extent;  ///< "5.4 × 5.5 × 5.6 m"
    std::string used_camera;
};
/// Of a node, which need not have a name: "node 3".
QString node_name(const std::string& name, int node);
/// Columns: name, triangles. Cameras have keys "camera:NAME", groups "group:cameras" and so on.
QStringList scene_headings();
std::vector<Row> scene_rows(const SceneListing& scene);

}  // namespace ir::widgets
