#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/experiment.h"
#include "app/engine/part.h"
#include "projects/document.h"
#include "renderers/core/inspection.h"
#include "renderers/core/report.h"
#include "renderers/image/image.h"
#include "renderers/passes/viewers/scene_3d.h"

/// What a window and the render thread say to each other. Plain data.
namespace ir::engine {

/// How fine a picture is. Only full ones count; the others are for the eye, until the full one is there.
enum class Fineness {
    preview,  ///< the surfaces under a light at the eye
    quarter,  ///< the method at a quarter of the picture's sides
    half,
    full
};

/// What is wanted of an experiment. Requests of one tag replace each other: the newest wins. One tag is one
/// execution; a request that differs from the last in `parts`, `kept` or `inspection` alone runs no method
/// again unless something asked for was not computed.
struct LiveRequest {
    std::string tag;
    Experiment experiment;
    std::vector<Part> parts;             ///< sent back with each frame
    std::vector<std::string> buffers;    ///< keys of buffers sent back as they are, for tables
    std::vector<std::string> kept = {};  ///< patterns of further resources to compute: for 3D views, probes
    /// Buffers, and what 3D views draw, are as they were when this pass had run; empty: at the end of the
    /// frame. Parts have their own.
    std::string after = {};
    Inspection inspection;
    std::optional<glm::ivec2> traced = {};  ///< pixel whose changes the report has
    bool thumbnails = false;                ///< also send a small image of each image resource
    std::uint64_t memory_budget = 0;
    /// Where a history is lost (something else is computed, a parameter changed), only so many of the last
    /// frames are run again, the first of them with an empty history; 0: all, as the picture is defined.
    int frames_again = 0;
    /// Coarser pictures come before the full one, and a request for another picture interrupts it.
    bool drafts = false;
    /// Equal texts of one tag ask for the same picture; empty: nobody knows.
    std::string picture = {};
    /// Stored history to begin with (stored_state.h); empty, absent or of something else: from nothing.
    std::string state_file = {};
};

/// The elements of a buffer as they lie in memory.
struct BufferContents {
    static constexpr std::uint64_t max_bytes = 64ull << 20;
    std::vector<Field> fields;
    std::uint64_t elements = 0;    ///< in the buffer
    std::vector<std::byte> bytes;  ///< of the first elements, at most max_bytes
};

/// After each frame of a request, and once more when only what is looked at has changed.
struct LiveResult {
    std::string tag;
    std::uint64_t serial = 0;  ///< of the request
    int frame = 0, frames = 1;
    int history = 0;               ///< frames since the history was empty, this one included
    std::uint64_t run = 0;         ///< another number for each frame that ran, of all tags
    double time = 0;               ///< seconds at which the frame saw the scene
    std::map<Part, Image> images;  ///< by the parts asked for; absent: not available
    std::map<std::string, BufferContents> buffers;
    std::string after;                        ///< LiveRequest::after, of the buffers
    Image valid;                              ///< 1 channel, may be empty
    std::map<std::string, Image> thumbnails;  ///< at most 96 pixels wide, by resource key
    Inspection inspection;
    FrameReport report;
    scene::Camera camera;  ///< in force
    /// Coarse images are enlarged to the full size; parts whose size is not the picture's are not there.
    Fineness fineness = Fineness::full;
    bool drafts_left = false;  ///< a finer one comes before the full one
    bool finished = false;     ///< all frames asked for are committed
};

/// A picture of buffers in space; drawn between the slices of whatever is rendered. Newest of a tag wins.
struct SceneViewRequest {
    std::string tag;        ///< of the view
    std::string execution;  ///< tag of the live request whose buffers are drawn
    passes::viewers::Scene3D view;
};

struct SceneViewResult {
    std::string tag;
    std::uint64_t serial = 0;
    std::string error;  ///< not empty: no picture
    std::string after;  ///< Scene3D::after
    passes::viewers::Picture3D picture;
};

/// All channels of all images of an execution at some pixels. Newest of a tag wins.
struct ProbeRequest {
    std::string tag;  ///< of an execution
    struct Pixel {
        int x = 0, y = 0;
        bool operator==(const Pixel&) const = default;
    };
    std::vector<Pixel> pixels;  ///< of the main result
};

struct ProbeResult {
    std::string tag;
    std::vector<ProbeRequest::Pixel> pixels;
    struct Row {
        std::string key, label, unit;
        Semantic semantic = Semantic::generic;
        bool available = false;
        int channels = 0;
        /// One by pixel. Images of another size are read at the texel that covers the pixel's centre; level
        /// and layer 0.
        std::vector<std::vector<float>> values;
    };
    std::vector<Row> rows;  ///< in the order of the report
};

/// The same of images that were sent, those of whole levels and layers apart; what was not sent is not
/// available. `main`: key of the main result, of which the pixels are. No rows where it is not there.
ProbeResult probe(const LiveResult& result, const std::string& main,
                  const std::vector<ProbeRequest::Pixel>& pixels);

/// What a ray meets first in an execution's scene, as its last frame saw it. Newest of a tag and asker wins.
struct SurfaceRequest {
    std::string tag;  ///< of an execution
    glm::dvec3 origin{0}, direction{0, 0, -1};
    std::string asker = {};  ///< comes back with the answer
};

struct SurfacePoint {
    glm::dvec3 position{0}, normal{0, 1, 0};  ///< of the triangle, of length one, on the side that is seen
    double free_way = 0;  ///< metres along the normal to the next surface; infinite for none
    int part = 0;         ///< of Experiment::composition()
    int node = 0;         ///< that draws it, index into SceneSummary::nodes
    std::string object = {}, material = {};  ///< names; the node's may be empty
};

struct SurfaceResult {
    std::string tag;
    std::string error;                  ///< not empty: nobody looked
    std::optional<SurfacePoint> point;  ///< absent: the ray leaves the scene
    std::string asker = {};
};

/// Writes resources that match patterns, and the main result, to one EXR file with all attributes.
struct ExportRequest {
    std::string tag;  ///< of an execution
    std::string file;
    std::vector<std::string> patterns;
};

/// Keeps what an execution rendered as a result of a project, once nothing of its tag is left to render.
/// Refused where the execution shows something else than the experiment now asks for. Where a
/// picture was cancelled with fewer samples than asked for, the answer's key is that of the picture as it is.
struct KeepRequest {
    std::string tag;  ///< of an execution
    projects::Project project;
    std::string experiment;  ///< id in the project
    std::string folder;      ///< of the project, which must have been saved
};

struct KeepResult {
    std::string tag, experiment;
    std::string key;    ///< of the kept result
    std::string error;  ///< not empty: one line why nothing was kept
};

struct SceneSummary {
    std::string name, content_hash;
    std::string composition_key;  ///< scene::composition_key of the parts asked for
    std::vector<std::string> cameras, lights, materials, warnings;
    std::vector<std::vector<std::string>> variants;  ///< of the materials, part by part
    struct NodeRow {
        std::string name;
        int parent = -1;
        std::size_t triangles = 0;
    };
    std::vector<NodeRow> nodes;
    std::size_t triangles = 0, textures = 0;
    std::vector<LightSource> sources;  ///< all that emits
    scene::Bounds bounds;
    std::vector<scene::Camera> camera_values;
};

}  // namespace ir::engine
