#include "renderers/methods/photon-mapping/bounces.h"

namespace ir::methods::photon_mapping {

Categories bounce_categories(const std::string& field) {
    return {field,
            {{1, "1st bounce", {255, 63, 63}},
             {2, "2nd bounce", {63, 255, 63}},
             {3, "3rd bounce", {89, 124, 255}},
             {4, "4th bounce", {255, 243, 63}},
             {5, "5th bounce", {255, 89, 255}},
             {6, "6th bounce", {63, 255, 255}},
             {7, "7th bounce", {255, 170, 39}},
             {8, "8th bounce", {255, 255, 255}}}};
}

}  // namespace ir::methods::photon_mapping
