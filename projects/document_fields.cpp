#include "projects/document_fields.h"

#include <array>

#include "projects/analyses.h"
#include "renderers/core/limits.h"

namespace ir::projects {
namespace {

using Writing = FieldText::Writing;
using Type = LightSpec::Type;

constexpr double unlimited = Range{}.max;

bool has_own_pose(const Camera& camera) {
    return camera.scene_camera.empty();
}

bool has_place(const LightSpec& light) {
    return light.type != Type::directional;
}
bool has_direction(const LightSpec& light) {
    return light.type != Type::point;
}
bool is_spot(const LightSpec& light) {
    return light.type == Type::spot;
}
bool is_area(const LightSpec& light) {
    return light.type == Type::rect || light.type == Type::disk;
}
bool has_target(const LightSpec& light) {
    return looks(light.type);
}

bool has_frames(const Analysis& analysis) {
    const auto* kind = find_analysis_kind(analysis.kind);
    return kind && kind->takes_frames;
}

const Field<Motion::Key> time_field{&Motion::Key::time,
                                    {"time",
                                     "Time",
                                     "s",
                                     "Seconds; between two keys all is interpolated linearly",
                                     {-max_seconds, max_seconds}}};

}  // namespace

const Fields<ScenePart>& part_fields() {
    static const Fields<ScenePart> fields{
        {&ScenePart::source, {.key = "source", .label = "File", .writing = Writing::required}},
        {&ScenePart::content_hash, {.key = "content_hash", .writing = Writing::unless_default}},
        {&ScenePart::variant,
         {.key = "variant",
          .label = "Variant",
          .doc =
              "Name of a variant of the file's materials (KHR_materials_variants); nothing: the default ones",
          .writing = Writing::unless_default}}};
    return fields;
}

const Fields<MaterialOverride>& material_fields() {
    using Change = MaterialOverride;
    static const Fields<Change> fields{
        {&Change::base_colour,
         {"base_colour",
          "Colour",
          "",
          "Base colour factor: linear red, green, blue and opacity, 0 … 1",
          {0, 1}}},
        {&Change::metallic, {"metallic", "Metallic", "", "0: dielectric, 1: metal", {0, 1}}},
        {&Change::roughness, {"roughness", "Roughness", "", "0: mirror-like, 1: fully rough", {0, 1}}},
        {&Change::emission,
         {"emission",
          "Emission",
          "W/(m² sr)",
          "Radiance that it emits: red, green, blue in W/(m² sr)",
          {0, max_emission}}},
        {&Change::normal_scale,
         {"normal_scale",
          "Bumps",
          "",
          "Strength of the normal map; 0: none",
          {-max_normal_scale, max_normal_scale}}},
        {&Change::ior, {"ior", "IOR", "", "Index of refraction, 1 … 10", {min_ior, max_ior}}},
        {&Change::transmission, {"transmission", "Transmission", "", "0: opaque, 1: glass", {0, 1}}}};
    return fields;
}

const Fields<Camera>& camera_fields() {
    static const Fields<Camera> fields{
        {&Camera::scene_camera, {.key = "scene_camera", .writing = Writing::unless_default}},
        {&Camera::eye,
         {"eye", "Eye", "m", "Where the camera is: x, y, z in metres, world space"},
         has_own_pose},
        {&Camera::target,
         {"target", "Target", "m", "What it looks at: x, y, z in metres; orbits turn about this point"},
         has_own_pose},
        {&Camera::up,
         {"up", "Up", "", "Direction that is up in the picture: x, y, z, any length"},
         has_own_pose},
        {&Camera::fov_y_degrees,
         {"fov_y_degrees",
          "View angle",
          "°",
          "Vertical field of view in degrees",
          {min_fov_degrees, max_fov_degrees}},
         has_own_pose,
         [](const Camera& camera) { return !camera.orthographic; }},
        {&Camera::orthographic, {.key = "orthographic", .writing = Writing::unless_default}, has_own_pose},
        {&Camera::height,
         {"height",
          "Height",
          "m",
          "Metres from the picture's lower to its upper edge",
          {1e-9, 1e9},
          Writing::unless_default},
         has_own_pose,
         [](const Camera& camera) { return camera.orthographic; }}};
    return fields;
}

const Fields<LightSpec>& light_fields() {
    static const Fields<LightSpec> fields{
        {&LightSpec::position, {"position", "Position", "m", "x, y, z in metres, world space"}, has_place},
        {&LightSpec::target,
         {"target", "Target", "m", "Point that the light looks at: x, y, z in metres"},
         has_target,
         [](const LightSpec& light) { return light.target.has_value(); }},
        {&LightSpec::direction,
         {"direction", "Direction", "", "Direction in which the light travels: x, y, z, any length"},
         has_direction,
         [](const LightSpec& light) { return !light.target; }},
        {&LightSpec::color,
         {"color", "Colour", "", "Linear red, green and blue; may be brighter than 1", {0}}},
        {&LightSpec::outer,
         {"outer", "Outer", "°", "Half-angle in degrees where the light ends", {0, 90, true}},
         is_spot},
        {&LightSpec::inner,
         {"inner",
          "Inner",
          "°",
          "Half-angle up to which the light is full; equal to the outer: a hard edge",
          {0, 90}},
         is_spot},
        {&LightSpec::size,
         {"size",
          "Size",
          "m",
          "Sides of the rectangle or diameters of the disk, metres",
          {0, unlimited, true}},
         is_area}};
    return fields;
}

const FieldText& quantity_text(LightSpec::Quantity quantity) {
    const auto text = [](const char* key, const char* label, const char* unit, const char* more = "") {
        return FieldText{key, label, unit, std::string("Per colour channel, times the colour") + more, {0}};
    };
    static const std::array texts{
        text("intensity", "Intensity", "W/sr"),
        text("flux", "Flux", "W", ": all that leaves the light; it stays when cone or size change"),
        text("irradiance", "Irradiance", "W/m²"), text("radiance", "Radiance", "W/(m² sr)")};
    return texts.at(static_cast<std::size_t>(quantity));
}

const FieldText& constant_environment_text() {
    static const FieldText text{"environment",
                                "Radiance",
                                "W/(m² sr)",
                                "The same from everywhere: red, green, blue in W/(m² sr)",
                                {0}};
    return text;
}

const Fields<Environment>& map_fields() {
    static const Fields<Environment> fields{
        {&Environment::source, {.key = "source", .label = "File", .writing = Writing::required}},
        {&Environment::content_hash, {.key = "content_hash", .writing = Writing::unless_default}}};
    return fields;
}

const Fields<Motion>& motion_fields(Motion::Kind kind) {
    static const Fields<Motion> camera{{&Motion::camera, {.key = "camera"}}};
    static const Fields<Motion> light{{&Motion::lights, {.key = "lights"}}};
    static const Fields<Motion> part{{&Motion::scene, {.key = "scene"}},
                                     {&Motion::part, {.key = "part", .range = {0, max_moved}}}};
    static const std::array tables{&camera, &light, &part};
    return *tables.at(static_cast<std::size_t>(kind));
}

const Fields<Motion::Key>& key_fields(Motion::Kind kind) {
    using Key = Motion::Key;
    static const Fields<Key> camera{
        time_field,
        {&Key::eye, {"eye", "Eye", "m", "Where the camera is then: x, y, z in metres"}},
        {&Key::target, {"target", "Target", "m", "What it looks at then: x, y, z in metres"}},
        {&Key::up, {"up", "Up", "", "Direction that is up in the picture then"}}};
    static const Fields<Key> light{
        time_field,
        {&Key::position, {"position", "Position", "m", "Where the light is then: x, y, z in metres"}},
        {&Key::look_at, {"target", "Looks at", "m", "The point that it looks at then: x, y, z in metres"}},
        {&Key::direction,
         {"direction", "Direction", "", "Along which it shines then; turned at a constant speed"}},
        {&Key::intensity,
         {"intensity", "Intensity", "", "Factor on the light's strength then; 1 is as in its set", {0}}}};
    static const Fields<Key> part{
        time_field,
        {&Key::translation,
         {"translation", "Position", "m", "Where the file's origin is then: x, y, z in metres"}},
        {&Key::rotation,
         {"rotation", "Rotation", "°",
          "Degrees about x, then y, then z; between two keys it turns the shorter way"}},
        {&Key::scale,
         {"scale", "Scale", "", "Along its own x, y and z; the motion takes the place of its transform"}}};
    static const std::array tables{&camera, &light, &part};
    return *tables.at(static_cast<std::size_t>(kind));
}

const Fields<Experiment>& experiment_fields() {
    static const Fields<Experiment> fields{
        {&Experiment::size,
         {"size", "Size", "px", "Width and height of the picture in pixels", {1, max_image_side}}},
        {&Experiment::seed, {"seed", "Seed", "", "Seed of everything random"}},
        {&Experiment::frames,
         {"frames",
          "Frames",
          "",
          "Frames to run from empty history; each is 1/30 s after the one before, unless the method adds "
          "frames up",
          {1, max_frames}}},
        {&Experiment::time,
         {"time", "Time", "s", "Time of the first frame in seconds", {-max_seconds, max_seconds}}}};
    return fields;
}

const Fields<Preset>& preset_fields() {
    static const Fields<Preset> fields{{&Preset::size, field_of(experiment_fields(), "size").text},
                                       {&Preset::frames, field_of(experiment_fields(), "frames").text}};
    return fields;
}

const Fields<ForeignImage>& image_fields() {
    static const Fields<ForeignImage> fields{
        {&ForeignImage::source,
         {.key = "source",
          .label = "File",
          .doc = "EXR or PNG, relative to the project's folder",
          .writing = Writing::required}},
        {&ForeignImage::content_hash, {.key = "content_hash", .writing = Writing::unless_default}},
        {&ForeignImage::notes,
         {.key = "notes",
          .label = "Notes",
          .doc = "Where it comes from and what light transport it shows: nobody can see that from the pixels",
          .writing = Writing::unless_default}}};
    return fields;
}

const Fields<Comparison>& comparison_fields() {
    static const Fields<Comparison> fields{
        {&Comparison::a,
         {.key = "a", .label = "A", .doc = "First picture: an experiment or a foreign image"}},
        {&Comparison::b,
         {.key = "b", .label = "B", .doc = "Second picture: an experiment or a foreign image"}},
        {&Comparison::output,
         {.key = "output",
          .label = "Output",
          .doc = "Which buffer of both is compared",
          .writing = Writing::unless_default}},
        {&Comparison::mode, {.key = "mode", .label = "Mode", .doc = "How the two are shown"}},
        {&Comparison::range,
         {.key = "range",
          .label = "Range",
          .doc = "Values shown as the first and the last colour, in the output's unit"}},
        {&Comparison::notes,
         {.key = "notes",
          .label = "Notes",
          .doc = "What the comparison shows",
          .writing = Writing::unless_default}}};
    return fields;
}

const Fields<Sweep>& sweep_fields() {
    static const Fields<Sweep> fields{
        {&Sweep::experiment,
         {.key = "experiment", .label = "Varies", .doc = "The experiment of which variations are made"}}};
    return fields;
}

const Fields<Sweep::Axis>& axis_fields() {
    using Axis = Sweep::Axis;
    static const Fields<Axis> fields{
        {&Axis::key, {.key = "key", .label = "Varies", .writing = Writing::required}},
        {&Axis::values, {.key = "values", .label = "Values"}}};
    return fields;
}

const Fields<ErrorPlot>& plot_fields() {
    static const Fields<ErrorPlot> fields{
        {&ErrorPlot::reference,
         {.key = "reference",
          .label = "Reference",
          .doc = "Experiment or foreign image that all others are judged by"}},
        {&ErrorPlot::experiments,
         {.key = "experiments",
          .label = "Experiments",
          .doc = "Those that are drawn; Space adds or removes one"}},
        {&ErrorPlot::over,
         {.key = "over",
          .label = "Varies",
          .doc = "What differs from point to point",
          .writing = Writing::required}},
        {&ErrorPlot::values,
         {.key = "values",
          .label = "Values",
          .doc = "Separated by commas: 32, 64, 128. Of frames they may be left out: then 1, 2, 4, … of each "
                 "experiment",
          .writing = Writing::unless_default}},
        {&ErrorPlot::metric,
         {.key = "metric",
          .label = "Metric",
          .doc = "Error that is drawn; all metrics are measured, so that changing it is free",
          .writing = Writing::required}},
        {&ErrorPlot::against_time,
         {.key = "axis",
          .label = "Drawn over",
          .doc = "Horizontal axis: the time that rendering took, or the values",
          .choices = {"values", "time"}}},
        {&ErrorPlot::notes,
         {.key = "notes",
          .label = "Notes",
          .doc = "What the plot shows",
          .writing = Writing::unless_default}}};
    return fields;
}

const Fields<Analysis>& analysis_fields() {
    static const Fields<Analysis> fields{
        {&Analysis::kind,
         {.key = "kind", .label = "Question", .doc = "What is asked", .writing = Writing::required}},
        {&Analysis::experiments,
         {.key = "experiments",
          .label = "Experiments",
          .doc = "Those that are asked about, in the order in which they were added; Space adds or removes "
                 "one"}},
        {&Analysis::reference,
         {.key = "reference",
          .label = "Reference",
          .doc = "Experiment or foreign image that is the truth; without one the experiments are compared "
                 "with each other",
          .writing = Writing::unless_default}},
        {&Analysis::parameters,
         {.key = "parameters",
          .label = "Parameters",
          .doc = std::string("Keys of those that take part, separated by commas; empty: all. Of a divergence "
                             "the two machines: ") +
                 machine_words + "; empty: " + default_machines[0] + ", " + default_machines[1],
          .writing = Writing::unless_default}},
        {&Analysis::output,
         {.key = "output",
          .label = "Output",
          .doc = "Which image of each frame; of one with levels or layers also KEY.level2, KEY.layer3",
          .writing = Writing::unless_default},
         has_frames},
        {&Analysis::frames,
         {.key = "frames",
          .label = "Frames",
          .doc = "How many: the last ones of the experiment, or the parts into which its samples are divided",
          .range = {min_analysis_frames, max_analysis_frames}},
         has_frames},
        {&Analysis::notes,
         {.key = "notes",
          .label = "Notes",
          .doc = "What the analysis shows",
          .writing = Writing::unless_default}}};
    return fields;
}

}  // namespace ir::projects
