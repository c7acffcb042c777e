#pragma once

#include "projects/document.h"
#include "projects/fields.h"

/// The fields of the document's items, see fields.h. Rules that bind several fields are in validate.h.
namespace ir::projects {

const Fields<ScenePart>& part_fields();
const Fields<MaterialOverride>& material_fields();
const Fields<Camera>& camera_fields();
/// Without its strength, which stands in the file by the name of its quantity.
const Fields<LightSpec>& light_fields();
const FieldText& quantity_text(LightSpec::Quantity quantity);
const FieldText& constant_environment_text();
/// Of an environment whose kind is map.
const Fields<Environment>& map_fields();
/// What a motion of this kind moves, but for a light's number or name.
const Fields<Motion>& motion_fields(Motion::Kind kind);
/// Of a motion's key: its time, and what things of this kind have.
const Fields<Motion::Key>& key_fields(Motion::Kind kind);
/// What an experiment has besides its method's parameters and the items that it names.
const Fields<Experiment>& experiment_fields();
/// What of it a preset may have in its place.
const Fields<Preset>& preset_fields();
const Fields<ForeignImage>& image_fields();
const Fields<Comparison>& comparison_fields();
const Fields<Sweep>& sweep_fields();
const Fields<Sweep::Axis>& axis_fields();
const Fields<ErrorPlot>& plot_fields();
const Fields<Analysis>& analysis_fields();

}  // namespace ir::projects
