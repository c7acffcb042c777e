#include "projects/edits.h"
#include "tests/gui/widgets/document/harness.h"

namespace ir::widgets {
namespace {

MethodDescription method(const char* id, const char* title) {
    MethodDescription description;
    description.id = id;
    description.title = title;
    OutputDescription result, normals;
    result.key = "accessibility";
    result.label = "Accessibility";
    normals.key = "normals";
    normals.label = "Normals";
    description.outputs = {result, normals};
    return description;
}

projects::LightSpec light(const char* spec) {
    return projects::parse_light(spec);
}

void add_scenes(projects::Project& project) {
    projects::Scene atrium, yard;
    atrium.id = "atrium";
    atrium.name = "Atrium";
    atrium.parts = {{"builtin:atrium@1", "", {}}};
    yard.id = "yard";
    yard.name = "Yard with statue";
    yard.parts = {{"scenes/yard.gltf", "1234", {}}, {"scenes/statue.glb", "5678", {}}};
    yard.parts[1].transform = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 0, -3, 1};
    yard.parts[0].materials["stone"].roughness = 0.4;
    project.scenes = {atrium, yard};
}

void add_cameras_and_lights(projects::Project& project) {
    projects::Camera nave, file;
    nave.id = "nave";
    nave.name = "Nave";
    nave.eye = {0.1, 1.7, 5};
    nave.target = {0, 1.5, 0};
    file.id = "from-file";
    file.name = "Gallery";
    file.scene_camera = "gallery";
    project.cameras = {nave, file};
    projects::LightSet evening, plain;
    evening.id = "evening";
    evening.name = "Evening";
    evening.lights = {light("spot:position=0,3,0;target=0,0,0;intensity=10;outer=30;inner=20"),
                      light("rect:position=1,2,0;direction=0,-1,0;size=1,2;radiance=4")};
    evening.environment.kind = projects::Environment::Kind::constant;
    evening.environment.constant = {0.1, 0.2, 0.4};
    plain.id = "plain";
    plain.name = "Plain";
    plain.use_scene_lights = true;
    project.lights = {evening, plain};
    projects::Motion walk;
    walk.id = "walk";
    walk.name = "Walk";
    walk.camera = "nave";
    walk.keys.resize(2);
    walk.keys[1].time = 2;
    project.motion = {walk};
}

}  // namespace

const Registry& sample_registry() {
    static const MethodDescription layers = method("layers", "Layered accessibility");
    static const MethodDescription paths = method("paths", "Paths");
    static const Registry registry({&layers, &paths});
    return registry;
}

projects::Project sample_project() {
    projects::Project project;
    project.name = "Figure 7";
    add_scenes(project);
    add_cameras_and_lights(project);
    auto layers =
        projects::edits::new_experiment(project, sample_registry(), "layers", "Layers", "yard", "nave");
    auto paths =
        projects::edits::new_experiment(project, sample_registry(), "paths", "Paths", "yard", "nave");
    layers.lights = "evening";
    layers.reference = "paths";
    project.experiments = {layers, paths};
    projects::ForeignImage image;
    image.id = "photo";
    image.name = "Photograph";
    image.source = "images/photo.exr";
    project.images = {image};
    projects::Comparison comparison;
    comparison.id = "both";
    comparison.name = "Layers against paths";
    comparison.a = "layers";
    comparison.b = "paths";
    project.comparisons = {comparison};
    projects::Sweep sweep;
    sweep.id = "sizes";
    sweep.name = "Sizes";
    sweep.experiment = "layers";
    sweep.axes.push_back({"frames", {1, 2, 4}});
    project.sweeps = {sweep};
    projects::ErrorPlot plot;
    plot.id = "error";
    plot.name = "Error of the layers";
    plot.reference = "paths";
    plot.experiments = {"layers"};
    project.plots = {plot};
    return project;
}

}  // namespace ir::widgets
