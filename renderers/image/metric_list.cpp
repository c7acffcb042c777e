#include <cmath>

#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/image/metrics.h"

namespace ir {

const std::vector<MetricDescription>& metrics() {
    static const std::vector<MetricDescription> list = {
        {"rmse", "RMSE",
         "Root of the mean squared error √(mean (A − B)²), over all channels. Large errors of few pixels "
         "count most. In the images' unit.",
         ""},
        {"mae", "MAE", "Mean absolute error, mean |A − B|, over all channels. In the images' unit.", ""},
        {"bias", "Bias",
         "Mean error, mean A − mean B, over all channels: above 0 where A is brighter. In the images' unit.",
         "", Best::near_zero},
        {"relbias", "Relative bias", "Bias divided by the mean of B: −0.05 where A is 5 % too dark.", "",
         Best::near_zero},
        {"relmse", "relMSE",
         "Mean squared error relative to the reference, mean (A − B)² / (B² + 0.01): errors in the dark "
         "count as much as those in the light.",
         "", Best::lowest, "Rousselle11"},
        {"psnr", "PSNR",
         "Peak signal-to-noise ratio −10 log₁₀ MSE for values of 0 to 1; infinite for equal pictures.", "dB",
         Best::highest},
        {"ssim", "SSIM",
         "Structural similarity of neighbourhoods of 11 × 11 pixels in linear values of 0 to 1: 1 for equal "
         "pictures, 0 for unrelated ones.",
         "", Best::highest, "Wang04"},
        {"flip", "ꟻLIP",
         "Difference that a person sees who flips between both pictures on a screen, clipped to 0 to 1: 0 "
         "for none, 1 for the largest.",
         "", Best::lowest, "Andersson20"},
        {"hdr-flip", "HDR-ꟻLIP",
         "The largest ꟻLIP over all exposures at which the reference shows something, tone mapped.", "",
         Best::lowest, "Andersson21"},
        {"mean", "Mean", "Mean of A over all channels of the compared pixels. In the images' unit.", "",
         Best::none},
        {"reference-mean", "Reference mean",
         "Mean of B over all channels of the compared pixels. In the images' unit.", "", Best::none},
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
    for (const auto& metric : metrics())
        if (metric.name == name) return metric;
    throw UsageError("unknown metric '" + name + "'" + known_are(name, metric_names()));
}

double badness(const MetricDescription& metric, double value) {
    switch (metric.best) {
        case Best::lowest:
            return value;
        case Best::highest:
            return -value;
        case Best::near_zero:
            return std::abs(value);
        case Best::none:
            break;
    }
    return std::nan("");
}

std::string why_not_finite(double value, const std::string& metric, std::size_t pixels) {
    if (std::isfinite(value)) return {};
    const std::string what = std::isnan(value) ? "undefined" : value > 0 ? "infinite" : "minus infinite";
    if (pixels == 0) return what + ": no pixel was compared";
    if (metric == "psnr" && value > 0) return what + ": the pictures are equal";
    if (metric == "relbias") return what + ": the mean of the reference is 0";
    return what;
}

}  // namespace ir
