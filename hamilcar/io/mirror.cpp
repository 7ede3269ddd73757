// Points change the sign of y. A product of inertia changes its sign once for every y in it. A mirrored spin axis would
// point to the right; all wheels of a vehicle spin about axes toward the left, so it is turned round: (a, b, c) becomes
// (-a, b, -c). The rack is one piece and its axis stays.
#include "hamilcar/io/mirror.hpp"

namespace hamilcar::io {

namespace {

template <class... Points>
void mirror_points(Points&... points) {
    ((points[1] = -points[1]), ...);
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

}  // namespace hamilcar::io
