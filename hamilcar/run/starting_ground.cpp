#include "hamilcar/run/starting_ground.hpp"

#include <cmath>

namespace hamilcar {

Mat3<double> heading_on(const Vec3<double>& normal, double yaw) {
    const Vec3<double> ahead(std::cos(yaw), std::sin(yaw), 0);
    Mat3<double> R;
    R.col(2) = normal;
    R.col(1) = normal.cross(ahead).normalized();
    R.col(0) = R.col(1).cross(R.col(2));
    return R;
}

StartingGround starting_ground(const Model<double>& model, const VehicleDescription& vehicle,
                               const InitialDescription& initial) {
    const Vec3<double>& n = model.road.normal;
    const double x = initial.position[0], y = initial.position[1], c = std::cos(initial.yaw), s = std::sin(initial.yaw);
    const double foot = -(n[0] * x + n[1] * y) / n[2];
    const Surface* surface = model.surface;
    if (!surface) return {n, foot};
    Mat3<double> A = Mat3<double>::Zero();
    Vec3<double> b = Vec3<double>::Zero();
    int number = 0;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        const Point& center = wheel.wheel.center;
        const double dx = c * center[0] - s * center[1], dy = s * center[0] + c * center[1];
        const Vec3<double> row(1, dx, dy);
        A += row * row.transpose();
        b +=
            row * (surface->height(x + dx, y + dy) - (n[0] * dx + n[1] * dy) / n[2] + surface->post(number++, 0).value);
    });
    const Vec3<double> plane = A.inverse() * b;                        // height above the foot: p0 + p1 dx + p2 dy
    if (!plane.allFinite()) return {n, foot + surface->height(x, y)};  // wheels in one line
    return {Vec3<double>(-plane[1], -plane[2], 1).normalized(), foot + plane[0]};
}

}  // namespace hamilcar
