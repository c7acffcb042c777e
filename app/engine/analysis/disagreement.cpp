#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "app/engine/analysis/analysis_run.h"
#include "app/engine/analysis/bars.h"
#include "renderers/core/error.h"

namespace ir::engine {
namespace {

/// In the order of PlotStyle::screen(): where both list experiments alike, one has one colour in both.
constexpr std::array colours{tints::sky,       tints::orange, tints::green, tints::yellow,
                             tints::vermilion, tints::purple, tints::blue};
/// One wins a pixel that is so much nearer, or farther, than the next: others are alike there.
constexpr float margin = 1.05f;
constexpr int alike = 0;  ///< category; those of the experiments count from 1

/// Square root of the mean variance over the channels of each pixel.
Image spread_of(const std::vector<Image>& pictures) {
    const auto& first = pictures.front();
    Image spread(first.width, first.height, 1);
    const auto channels = std::size_t(first.channels);
    for (std::size_t pixel = 0; pixel < spread.pixels.size(); ++pixel) {
        double variance = 0;
        for (std::size_t at = pixel * channels; at < (pixel + 1) * channels; ++at) {
            double sum = 0, squares = 0;
            for (const auto& picture : pictures) sum += picture.pixels[at];
            const double mean = sum / double(pictures.size());
            for (const auto& picture : pictures) squares += std::pow(picture.pixels[at] - mean, 2);
            variance += squares / double(pictures.size());
        }
        spread.pixels[pixel] = float(std::sqrt(variance / double(channels)));
    }
    return spread;
}

/// Of each value of all pictures.
Image median_of(const std::vector<Image>& pictures) {
    Image median = pictures.front();
    std::vector<float> values(pictures.size());
    for (std::size_t at = 0; at < median.pixels.size(); ++at) {
        for (std::size_t i = 0; i < pictures.size(); ++i) values[i] = pictures[i].pixels[at];
        std::ranges::sort(values);
        const auto half = values.size() / 2;
        median.pixels[at] = values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
    }
    return median;
}

/// Which of the distances stands out at a pixel, counted from 1: the least or the largest.
int outstanding(const std::vector<Image>& distances, std::size_t pixel, bool is_least) {
    const auto before = [&](std::size_t a, std::size_t b) {
        const float x = distances[a].pixels[pixel], y = distances[b].pixels[pixel];
        return is_least ? x < y : x > y;
    };
    std::size_t first = 0, second = 1;
    if (before(second, first)) std::swap(first, second);
    for (std::size_t i = 2; i < distances.size(); ++i)
        if (before(i, first))
            second = std::exchange(first, i);
        else if (before(i, second))
            second = i;
    const float a = distances[first].pixels[pixel], b = distances[second].pixels[pixel];
    return (is_least ? b > margin * a : a > margin * b) ? int(first) + 1 : alike;
}

double mean_of(const Image& image, const AnalysisRun& run) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (run.is_valid(i)) sum += image.pixels[i];
    return sum / double(std::max<std::size_t>(1, run.count_valid()));
}

/// Pictures are compared pixel by pixel: what differs in what they see is said.
void require_one_view(AnalysisRun& run) {
    const auto first = run.experiment(0);
    for (std::size_t i = 1; i < run.analysis().experiments.size(); ++i) {
        const auto other = run.experiment(i);
        for (const auto& [what, a, b] :
             {std::tuple{"scene", first.scene, other.scene}, {"camera", first.camera, other.camera}})
            if (a != b)
                throw UsageError("experiments '" + first.id + "' and '" + other.id + "' differ in their " +
                                 what + "; their pixels show different places");
        if (first.lights != other.lights) run.note("the experiments have different lights");
        const auto paths = first.values.find("paths"), theirs = other.values.find("paths");
        if (paths != first.values.end() && theirs != other.values.end() && paths->second != theirs->second)
            run.note("the experiments compute different light: a part of the disagreement is no error");
    }
}

}  // namespace

AnalysisResult disagreement(AnalysisRun& run) {
    require_one_view(run);
    const auto count = run.analysis().experiments.size();
    const bool is_judged = run.has_reference();
    run.expect(count + (is_judged ? 1 : 0));
    std::vector<Image> pictures;
    for (std::size_t i = 0; i < count; ++i) pictures.push_back(run.picture(run.experiment(i), run.name(i)));
    const Image middle = is_judged ? run.reference() : median_of(pictures);
    run.check();
    std::vector<Image> distances;
    for (const auto& picture : pictures) distances.push_back(run.distance(picture, middle));

    AnalysisResult result;
    result.pictures.push_back({"spread",
                               "Spread",
                               "How far the experiments are apart: the square root of their variance.",
                               false,
                               {},
                               spread_of(pictures)});
    const bool has_winner = is_judged || count > 2;  // two are as far from their middle
    std::vector<std::size_t> won(count + 1);
    if (has_winner) {
        Image winners(middle.width, middle.height, 1);
        for (std::size_t pixel = 0; pixel < winners.pixels.size(); ++pixel) {
            const int winner = outstanding(distances, pixel, is_judged);
            winners.pixels[pixel] = float(winner);
            if (run.is_valid(pixel)) ++won[std::size_t(winner)];
        }
        std::vector<Category> names{{alike, "alike", tints::dark}};
        for (std::size_t i = 0; i < count; ++i) names.push_back({int(i) + 1, run.name(i), colours[i]});
        const std::string doc = " by at least 5 % of the distance; elsewhere the first two are alike.";
        result.pictures.push_back(
            is_judged
                ? AnalysisPicture{"nearest", "Nearest", "Who is nearest to the reference" + doc, false, names,
                                  std::move(winners)}
                : AnalysisPicture{"farthest", "Farthest", "Who is farthest from the median of all" + doc,
                                  false, names, std::move(winners)});
    }

    const auto valid = double(std::max<std::size_t>(1, run.count_valid()));
    const auto title = is_judged ? "Nearest to the reference" : "Farthest from the others";
    const auto error = is_judged ? run.error_title("") : "RMSE to the median";
    Bars bars(has_winner ? title : "Distance from the middle", has_winner ? "Share of the pixels" : error,
              {"Experiment", "Share of the pixels", error});
    for (std::size_t i = 0; i < count; ++i) {
        const double rmse = run.rmse(pictures[i], middle), share = double(won[i + 1]) / valid;
        bars.begin_row(run.name(i));
        auto& bar =
            bars.add((is_judged ? "nearest:" : "farthest:") + run.analysis().experiments[i], 0,
                     has_winner ? share : rmse,
                     {{run.name(i)}, has_winner ? percent_cell(share) : PlotCell{"—"}, number_cell(rmse)});
        if (has_winner) bar.colour = colours[i];  // as in the picture
    }
    if (has_winner)
        run.note(percent_cell(double(won[alike]) / valid).text + " of the pixels are alike: none is " +
                 (is_judged ? "nearer" : "farther") + " than the next by 5 %");
    run.note("the mean spread is " + number_cell(mean_of(result.pictures.front().image, run)).text);
    result.data = std::move(bars).finish(run.notes());
    return result;
}

}  // namespace ir::engine
