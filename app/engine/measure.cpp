#include "app/engine/measure.h"

#include "app/engine/number_text.h"
#include "app/engine/pictures.h"
#include "renderers/core/error.h"
#include "renderers/image/metrics.h"

namespace ir::engine {

Measured measure(const Execution& execution, const StudyReference& reference, const CancelToken* cancel) {
    const auto image = main_result(execution);
    const auto valid = execution.graph().read_image("valid").value_or(Image());
    Measured measured;
    std::string refusal;
    for (const auto& name : metric_names()) {
        if (cancel) cancel->check();
        try {
            const auto result =
                compute_metrics(image, reference.image, {name},
                                {.valid_image = valid.empty() ? nullptr : &valid,
                                 .valid_reference = reference.valid.empty() ? nullptr : &reference.valid});
            measured.errors[name] = result.values.at(name);
            measured.pixels = result.pixels;
            measured.skipped = result.skipped;
        } catch (const UsageError& error) {
            refusal = error.what();  // a metric may not apply: too few pixels, too few channels
        }
    }
    if (measured.errors.empty()) throw UsageError(refusal);
    return measured;
}

void put_errors(projects::Json& json, const std::map<std::string, double>& errors, std::size_t pixels) {
    json["errors"] = projects::Json::object();
    for (const auto& [metric, error] : errors) {
        json["errors"][metric] = number_json(error);
        if (const auto why = why_not_finite(error, metric, pixels); !why.empty())
            json["reasons"][metric] = why;
    }
}

std::map<std::string, double> read_errors(projects::ObjectReader& reader) {
    std::map<std::string, double> all;
    const auto *errors = reader.take("errors"), *reasons = reader.take("reasons");
    if (!errors) return all;
    if (!errors->is_object()) reader.fail("errors", "must be an object of numbers by metric");
    for (auto it = errors->begin(); it != errors->end(); ++it) {
        const bool has_reason = reasons && reasons->contains(it.key()) && reasons->at(it.key()).is_string();
        all[it.key()] =
            number_from(*it, has_reason ? reasons->at(it.key()).get<std::string>() : "", reader, "errors");
    }
    return all;
}

}  // namespace ir::engine
