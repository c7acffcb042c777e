#include "renderers/core/error.h"
#include "renderers/image/metrics.h"

namespace ir {

const std::vector<MetricDescription>& metrics() {
    static const std::vector<MetricDescription> list = {
        {"rmse", "RMSE",
         "Root of the mean squared error √(mean (A − B)²), over all channels. Large errors of few pixels "
         "count "
         "most. In the images' unit.",
         ""},
        {"mae", "MAE", "Mean absolute error, mean |A − B|, over all channels. In the images' unit.", ""},
        {"relmse", "relMSE",
         "Mean squared error relative to the reference, mean (A − B)² / (B² + 0.01): errors in the dark "
         "count as "
         "much as those in the light.",
         "", false, "Rousselle11"},
        {"psnr", "PSNR",
         "Peak signal-to-noise ratio −10 log₁₀ MSE for values of 0 to 1; infinite for equal pictures.", "dB",
         true},
        {"ssim", "SSIM",
         "Structural similarity of neighbourhoods of 11 × 11 pixels in linear values of 0 to 1: 1 for equal "
         "pictures, 0 for unrelated ones.",
         "", true, "Wang04"},
        {"flip", "ꟻLIP",
         "Difference that a person sees who flips between both pictures on a screen, clipped to 0 to 1: 0 "
         "for "
         "none, 1 for the largest.",
         "", false, "Andersson20"},
        {"hdr-flip", "HDR-ꟻLIP",
         "The largest ꟻLIP over all exposures at which the reference shows something, tone mapped.", "",
         false, "Andersson21"},
    };
    return list;
}

const std::vector<std::string>& metric_names() {
    static const auto names = [] {
        std::vector<std::string> result;
        for (const auto& metric : metrics()) result.push_back(metric.name);
        return result;
    }();
    return names;
}

const MetricDescription& metric(const std::string& name) {
    std::string known;
    for (const auto& metric : metrics()) {
        if (metric.name == name) return metric;
        known += (known.empty() ? "" : ", ") + metric.name;
    }
    throw UsageError("unknown metric '" + name + "'; known are " + known);
}

}  // namespace ir
