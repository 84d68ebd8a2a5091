/// What Choi & Sung 2017 print, as far as the text at hand shows it: the images of Tables 1 to 3 are not in
/// it, the numbers of LS3 (Discussion and Table 3) are.
#pragma once

#include <array>

namespace touchmark::bench::experiments::papers::choi_sung_printed {

/// LS3 at levels 0 to 3, without and with clustering.
struct Level {
  int spheres, clustered_spheres;
  double detection_ms, clustered_detection_ms;
  int update_hz, clustered_update_hz;
  int sphere_reduction_percent, detection_reduction_percent, update_increment_percent;
};
inline constexpr std::array<Level, 4> ls3{{
    {902, 728, 2.014, 1.675, 1095, 1314, 19, 17, 20},
    {3580, 1686, 2.620, 2.140, 562, 797, 53, 18, 42},
    {13668, 2469, 3.466, 2.517, 374, 642, 82, 27, 72},
    {40730, 2896, 8.019, 2.619, 139, 601, 93, 67, 332},
}};

/// Not printed: what MeshLab's filters make of the paper's bunny with the paper's threshold (levels 1 to 3,
/// in the order of choi_sung_methods). The row of LS3 equals the printed numbers of spheres.
inline constexpr std::array<std::array<int, 3>, 5> tool_triangles{{{3580, 13620, 41768},
                                                                   {5412, 21648, 86592},
                                                                   {3580, 13590, 41120},
                                                                   {3580, 13600, 38444},
                                                                   {3580, 13668, 40730}}};

}  // namespace touchmark::bench::experiments::papers::choi_sung_printed
