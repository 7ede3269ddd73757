// Points change the sign of y. A product of inertia changes its sign once for every y in it. A mirrored spin axis would
// point to the right; all wheels of a vehicle spin about axes toward the left, so it is turned round: (a, b, c) becomes
// (-a, b, -c). The rack is one piece and its axis stays.
#include "hamilcar/io/mirror.hpp"

#include "hamilcar/tire/mirrored.hpp"

namespace hamilcar::io {

namespace {

template <class... Points>
void mirror_points(Points&... points) {
    ((points[1] = -points[1]), ...);
}

void mirror_hardpoints(MacPhersonDescription& p) {
    mirror_points(p.strut_top, p.slide_point, p.arm_front, p.arm_rear, p.ball_joint, p.rack_end, p.tie_rod_outer);
}

void mirror_hardpoints(SemiTrailingArmDescription& p) {
    mirror_points(p.inner_bush, p.outer_bush, p.spring_arm, p.spring_body, p.damper_arm, p.damper_body);
}

}  // namespace

void mirror(BodyDescription& body) {
    mirror_points(body.center_of_mass);
    auto& [xy, yz, xz] = body.products;
    xy = -xy, yz = -yz;
}

WheelDescription mirrored(WheelDescription wheel) {
    mirror_points(wheel.center);
    auto& [a, b, c] = wheel.spin_axis;
    a = -a, c = -c;
    return wheel;
}

CornerDescription mirrored(CornerDescription corner) {
    std::visit([](auto& points) { mirror_hardpoints(points); }, corner.suspension);
    mirror(corner.carrier);
    corner.wheel = mirrored(corner.wheel);
    corner.tire = hamilcar::mirrored(corner.tire);
    return corner;
}

}  // namespace hamilcar::io
