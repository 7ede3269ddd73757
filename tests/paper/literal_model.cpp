// The constants of the paper's car from the hardpoints of a vehicle description.
#include <stdexcept>

#include "paper/literal.hpp"
#include "support/hardpoints.hpp"

namespace hamilcar::paper {
namespace {

using test::MacPhersonPoints;
using test::SemiTrailingArmPoints;

Vector3 vector(const Point& p) {
    return {p[0], p[1], p[2]};
}

Body make_body(const BodyDescription& description) {
    Body body;
    body.m = description.mass;
    body.J.diagonal() = vector(description.inertia);
    body.J(0, 1) = body.J(1, 0) = description.products[0];
    body.J(1, 2) = body.J(2, 1) = description.products[1];
    body.J(0, 2) = body.J(2, 0) = description.products[2];
    body.center = vector(description.center_of_mass);
    return body;
}

Strut make_strut(const MacPhersonPoints& points, const Vector3& chassis, const Vector3& spindle) {
    const Vector3 T = vector(points.strut_top), S = vector(points.slide_point), C = vector(points.ball_joint);
    const Vector3 A1 = vector(points.arm_front), A2 = vector(points.arm_rear);
    const Vector3 R = vector(points.rack_end), Q = vector(points.tie_rod_outer);
    Strut strut;
    strut.s_12_1 = T - chassis;
    strut.s_21_1 = S - spindle;
    strut.h_21 = (T - S).normalized();
    strut.q4_design = (T - S).norm();
    strut.u_2 = (A2 - A1).normalized();
    const Vector3 A = A1 + strut.u_2 * strut.u_2.dot(C - A1);
    strut.s_12_2 = A - chassis;
    strut.s_21_2 = C - spindle;
    strut.c_2 = points.arm_length.value_or((C - A).norm());
    strut.s_12_3 = R - chassis;
    strut.s_21_3 = Q - spindle;
    strut.u_1 = vector(points.rack_axis);
    strut.c_3 = points.tie_rod_length.value_or((Q - R).norm());
    return strut;
}

// u_41 = -(pin axis toward +y), so that omega_4 = omega_1 - u_41 q9' lifts the wheel for q9' > 0. At design both bodies
// are parallel and q9 = 0, hence C_14 = C_41: any right-handed frame with u_41 for its third axis.
Arm make_arm(const SemiTrailingArmPoints& points, const Vector3& chassis, const Vector3& arm_center) {
    const Vector3 inner = vector(points.inner_bush), outer = vector(points.outer_bush);
    const Vector3 along = (outer - inner).normalized();
    const Vector3 u_41 = along.y() > 0 ? Vector3(-along) : along;
    Arm arm;
    arm.C_14.col(2) = u_41;
    arm.C_14.col(0) = u_41.unitOrthogonal();
    arm.C_14.col(1) = u_41.cross(arm.C_14.col(0));
    arm.C_41 = arm.C_14;
    arm.s_14 = inner - chassis;
    arm.s_41 = inner - arm_center;
    return arm;
}

}  // namespace

LiteralCar::LiteralCar(const VehicleDescription& car, double alpha) : gravity_(car.gravity), alpha_(alpha) {
    // Bodies 2 to 5: the paper starts on the right.
    constexpr std::array<std::size_t, 4> suspension_of_body{1, 0, 3, 2};
    bodies_[0] = make_body(car.chassis);
    for (std::size_t i = 0; i < 4; ++i) {
        const SuspensionDescription& suspension = car.suspensions.at(suspension_of_body[i]);
        bodies_[i + 1] = make_body(suspension.bodies.at(0).body);
        bodies_[i + 1].e = vector(suspension.wheels.at(0).wheel.spin_axis);
        if (i < 2) {
            struts_[i] = make_strut(test::strut_points(suspension), body(1).center, bodies_[i + 1].center);
        } else {
            arms_[i - 2] = make_arm(test::arm_points(suspension), body(1).center, bodies_[i + 1].center);
        }
    }
}

Coordinates LiteralCar::design_position() const {
    Coordinates q;
    for (int i = 0; i < 3; ++i) q(11 + i) = body(1).center[i];
    q(4) = strut(2).q4_design;
    q(8) = strut(3).q4_design;
    return q;
}

Coordinates LiteralCar::assemble(Coordinates q) const {
    for (int iteration = 0; iteration < 30; ++iteration) {
        const Matrix Phi_q = this->Phi_q(q);
        const Matrix Phi_w = Phi_q(Eigen::all, {0, 1, 2, 4, 5, 6});
        const Vector step = Phi_w.partialPivLu().solve(Phi(q));
        for (std::size_t i = 0; i < dependent.size(); ++i) q(dependent[i]) -= step[static_cast<Eigen::Index>(i)];
        if (step.norm() < 1e-14) return q;
    }
    throw std::runtime_error("the linkage does not assemble at these strut lengths and this rack displacement");
}

Coordinates LiteralCar::moved(Coordinates q, const Vector& qdot, double time) const {
    for (std::size_t i = 0; i < 16; ++i) q(coordinate_of_row[i]) += qdot[static_cast<Eigen::Index>(i)] * time;
    q(17) += q.q17_dot * time;
    return q;
}

}  // namespace hamilcar::paper
