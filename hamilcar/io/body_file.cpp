// An inertia is checked by what every mass distribution obeys: principal moments are sums A = b + c, B = a + c,
// C = a + b of integrals a, b, c >= 0, hence none is negative and none exceeds the sum of the other two.
#include "hamilcar/io/vehicle_tables.hpp"

#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/math/convert.hpp"
#include "hamilcar/math/eigen.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace hamilcar::io {

namespace {

constexpr double rounding = 1e-9;  // allowed violation, relative to the largest moment: a flat disc is at the limit

Mat3<double> inertia_matrix(const BodyDescription& body) {
    const auto& [xx, yy, zz] = body.inertia;
    const auto& [xy, yz, xz] = body.products;
    Mat3<double> matrix;
    matrix << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return matrix;
}

// Principal moments, ascending.
Vec3<double> principal_moments(const Mat3<double>& inertia) {
    return Eigen::SelfAdjointEigenSolver<Mat3<double>>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
}

bool obeys_triangle(const Vec3<double>& moments) {
    return moments[2] <= (moments[0] + moments[1]) * (1 + rounding);
}

// The wheel's spin inertia lies about its own axis: where an upright wheel would do, it is the tilt that somebody mistyped.
std::string tilt_at_fault(const Mat3<double>& resting, const WheelDescription& wheel) {
    const Vec3<double> left = Vec3<double>::UnitY();
    if (!obeys_triangle(principal_moments(resting + wheel.spin_inertia * left * left.transpose()))) return "";
    const double tilt = std::acos(std::clamp(wheel.spin_axis[1], -1.0, 1.0)) / units::degree;
    return ", which it would not be were the wheel upright: with camber_deg and toe_in_deg (or spin_axis) its axis is "
           "tilted by " +
           number_text(tilt) + " deg";
}

void check_inertia(const TableReader& table, const BodyDescription& body, const WheelDescription& wheel) {
    const Vec3<double> axis = vec3(wheel.spin_axis);
    const Mat3<double> resting = inertia_matrix(body), whole = resting + wheel.spin_inertia * axis * axis.transpose();
    const Vec3<double> min = principal_moments(resting), moments = principal_moments(whole);
    table.expect(min[0] >= -rounding * min[2], "inertia_kg_m2",
                 "no principal moment below zero (here " + number_text(min[0]) + ")");
    table.expect(obeys_triangle(moments), "inertia_kg_m2",
                 "no principal moment above the sum of the other two (here " + number_text(moments[0]) + ", " +
                     number_text(moments[1]) + ", " + number_text(moments[2]) + ")" + tilt_at_fault(resting, wheel));
}

}  // namespace

BodyDescription read_body(const TableReader& table, const WheelDescription& wheel) {
    const BodyDescription body{.mass = table.number("mass_kg", positive),
                               .center_of_mass = table.array<3>("center_of_mass_m"),
                               .inertia = table.array<3>("inertia_kg_m2"),
                               .products = table.array<3>("products_kg_m2", Point{})};
    if (!table.is_recording()) check_inertia(table, body, wheel);
    return body;
}

bool has_room_for(const BodyDescription& body, const std::vector<std::pair<double, Point>>& rotors) {
    Mat3<double> rest = inertia_matrix(body);
    for (const auto& [inertia, axis] : rotors) rest -= inertia * vec3(axis) * vec3(axis).transpose();
    const Vec3<double> moments = principal_moments(rest);
    return moments[0] > 0 && obeys_triangle(moments);
}

}  // namespace hamilcar::io
