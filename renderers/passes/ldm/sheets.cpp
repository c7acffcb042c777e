#include <algorithm>

#include "renderers/core/record.h"
#include "renderers/gl/dispatch_items.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/ldm/points.h"
#include "shaders/passes/ldm/sheets.comp.h"

namespace ir::passes::ldm {
namespace {

/// Constants of sheets.comp.
struct MakeSheets {
    unsigned room;
    IR_FIELDS(room)
};

}  // namespace

void show_sheets(graph::GraphBuilder& builder, const Maps& maps, const Points& points) {
    const auto sheets = builder.output(
        "ldm.xray", {.fields = record_fields<Sheet>(), .elements = points.reserved, .growable = true});
    const auto count = builder.counter({.key = "ldm.shown_sheets",
                                        .name = "SheetCount",
                                        .label = "Pieces of surface shown",
                                        .growth_of = sheets});
    auto pass = builder.pass("x-ray");
    pass.reads(maps.frame_buffer, points.points).writes("Sheets", sheets).counts(points.count).counts(count);
    pass.execute([=, points = points.points](graph::PassContext& context) {
        const auto room = std::min(context.capacity(points), context.capacity(sheets));
        const auto& program = context.use({{"passes/ldm/sheets.comp"}});
        program.set(MakeSheets{static_cast<unsigned>(room)});
        gl::dispatch_items(program, 0, static_cast<std::int64_t>(room));
    });
}

}  // namespace ir::passes::ldm
