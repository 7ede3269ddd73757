// Points change the sign of y. A product of inertia changes its sign once for every y in it. A mirrored spin axis would
// point to the right; all wheels of a vehicle spin about axes toward the left, so it is turned round: (a, b, c) becomes
// (-a, b, -c). The rack is one piece and its axis stays.
#include "hamilcar/io/mirror.hpp"

namespace hamilcar::io {

namespace {

template <class... Points>
void mirror(Points&... points) {
    ((points[1] = -points[1]), ...);
}

void mirror_hardpoints(MacPhersonDescription& p) {
    mirror(p.strut_top, p.slide_point, p.arm_front, p.arm_rear, p.ball_joint, p.rack_end, p.tie_rod_outer);
}

void mirror_hardpoints(SemiTrailingArmDescription& p) {
    mirror(p.inner_bush, p.outer_bush, p.spring_arm, p.spring_body, p.damper_arm, p.damper_body);
}

}  // namespace

CornerDescription mirrored(CornerDescription corner) {
    std::visit([](auto& points) { mirror_hardpoints(points); }, corner.suspension);
    mirror(corner.carrier.center_of_mass, corner.wheel.center);
    auto& [xy, yz, xz] = corner.carrier.products;
    xy = -xy, yz = -yz;
    auto& [a, b, c] = corner.wheel.spin_axis;
    a = -a, c = -c;
    return corner;
}

}  // namespace hamilcar::io
