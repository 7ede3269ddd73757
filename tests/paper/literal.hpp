// The paper's own matrices, (1)-(28), (37)-(47), (54)-(71) and A.1-A.5, with the slips of docs/theory/errata.md
// corrected: dense, in inertial axes, Bryant angles, about the earth origin. An oracle for the production form.
//
// Bodies: 1 chassis, 2 front right spindle, 3 front left spindle, 4 rear right arm, 5 rear left arm. The frame of a
// body has its origin at the center of mass and is parallel to the vehicle frame at design: M is block diagonal.
// Coordinates: q1..q3 rotation and q4 strut length of body 2; q5..q7 and q8 of body 3; q9, q10 angles of the arms,
// jounce positive; q11..q13 the chassis center of mass r_1 in the ground frame; q14..q16 its Bryant angles; q17 rack.
//     qdot (16)  q11..q16 | q1 q2 q3 q4 | q5 q6 q7 q8 | q9 | q10                                             // (18)
//     a    (10)  q11..q16 | q4 q8 q9 q10, that is Z | V;      W (6)  q1 q2 q3 q5 q6 q7
// State-space ("hatted") vectors: linear part first, then angular about the earth origin, body 1 to 5: 30 rows.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "hamilcar/description/vehicle.hpp"
#include "paper/literal_rotation.hpp"

namespace hamilcar::paper {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

struct Coordinates {
    std::array<double, 17> q{};  // q[i - 1] is the paper's q_i [m, rad]
    double q17_dot = 0;          // rate of the rack [m/s]

    double operator()(int i) const { return q[static_cast<std::size_t>(i - 1)]; }
    double& operator()(int i) { return q[static_cast<std::size_t>(i - 1)]; }
};

// Spin momenta p_s = I_s (e.omega + spin) of the wheels on bodies 2, 3, 4, 5 [kg m^2/s].
using Rotors = std::array<double, 4>;

struct Pose {
    Matrix3 A;  // from body axes to inertial axes
    Vector3 r;  // center of mass [m]
};

struct Twist {
    Vector3 r_dot;  // of the center of mass [m/s]
    Vector3 omega;  // [rad/s]
};

// Constants of a body, in its own axes.
struct Body {
    double m = 0;
    Matrix3 J = Matrix3::Zero();
    Vector3 e = Vector3::Zero();       // spin axis of the wheel it carries
    Vector3 center = Vector3::Zero();  // center of mass in the vehicle frame at design
};

// Constants of Fig. 3, each in the axes of the body it is fixed in; joints 1 strut, 2 revolute-spherical, 3 distance.
struct Strut {
    Vector3 s_12_1, s_21_1, h_21;  // strut top, slide point, slide direction
    Vector3 s_12_2, s_21_2, u_2;   // foot on the control arm axis, ball joint, control arm axis (on the chassis)
    Vector3 s_12_3, s_21_3, u_1;   // rack end, tie rod outer end, rack axis (on the chassis)
    double c_2 = 0, c_3 = 0;       // control arm and tie rod lengths
    double q4_design = 0;
};

// Constants of Fig. 4; the pin axis u_41 is the third column of C_14 and of C_41.
struct Arm {
    Vector3 s_14, s_41;
    Matrix3 C_14, C_41;
};

// What A.3 is made of for one spindle, in inertial axes; the same fields hold the time derivatives.
struct CutJoints {
    Matrix3 A_D;       // A_2 D_2
    Vector3 h;         // h_21
    Vector3 u_2, u_1;  // control arm axis, rack axis
    Vector3 d_2, d_3;  // (22), (24)
    Vector3 p_2, p_3;  // from the strut top to the ball joint, to the tie rod outer end
};

class LiteralCar {
public:
    // Suspensions ordered front_left, front_right, rear_left, rear_right; alpha [1/s] is the stabilization gain of (27).
    explicit LiteralCar(const VehicleDescription& car, double alpha = 0);

    Coordinates design_position() const;
    Coordinates assemble(Coordinates q) const;  // W from Phi = 0 by Newton-Raphson, V and q17 kept
    Coordinates moved(Coordinates q, const Vector& qdot, double time) const;  // q + qdot time, the rack included

    // Section 2. B_j is the block of body j (6 x 6, 4, 4, 1, 1).
    std::array<Pose, 5> poses(const Coordinates& q) const;                        // (1), (3)-(8)
    std::array<Twist, 5> twists(const Coordinates& q, const Vector& qdot) const;  // (9), (12), (13), (15), (16)
    Matrix B_j(int body, const Coordinates& q) const;                             // A.2
    Matrix B_j_dot(int body, const Coordinates& q, const Vector& qdot) const;
    Matrix B(const Coordinates& q) const;  // 30 x 16, (18)
    Matrix B_dot(const Coordinates& q, const Vector& qdot) const;

    // Section 3. Rows of Phi as in (25); columns of Phi_q are q1 q2 q3 q4 | q5 q6 q7 q8.
    Vector Phi(const Coordinates& q) const;    // 6, (25)
    Matrix Phi_q(const Coordinates& q) const;  // 6 x 8, A.3
    Matrix Phi_q_dot(const Coordinates& q, const Vector& qdot) const;
    Vector Phi_t(const Coordinates& q) const;                      // 6, (28)
    Matrix H(const Coordinates& q) const;                          // 6 x 4, (39)
    Vector X(const Coordinates& q) const;                          // 6, (39)
    Matrix H_dot(const Coordinates& q, const Vector& qdot) const;  // 6 x 4, (47)
    Matrix H_underlined(const Coordinates& q) const;               // 16 x 10, (41)
    Vector X_underlined(const Coordinates& q) const;               // 16, (41)
    Vector qdot(const Coordinates& q, const Vector& adot) const;   // 16, (40)
    Matrix BH(const Coordinates& q) const;                         // 30 x 10, (43)
    Vector BX(const Coordinates& q) const;                         // 30, (43)

    // Section 4.
    Matrix Mhat(const Coordinates& q) const;                                             // 30 x 30, DI^T M DI
    Matrix M_star(const Coordinates& q) const;                                           // 16 x 16, A.4
    Matrix M_star_star(const Coordinates& q) const;                                      // 10 x 10, A.5
    Vector X_star_star(const Coordinates& q) const;                                      // 10, A.5
    Vector P_a(const Coordinates& q, const Vector& adot, const Rotors& p_s = {}) const;  // (57)
    Vector adot(const Coordinates& q, const Vector& P_a, const Rotors& p_s = {}) const;  // (58)

    // Section 5. DI turns a state-space vector into velocities of the centers of mass: the inverse of (10).
    Matrix DI(const Coordinates& q) const;  // 30 x 30
    Matrix DI_dot(const Coordinates& q, const Vector& qdot) const;
    Matrix M(const Coordinates& q) const;                                  // 30 x 30, (62)
    Vector M_dot_Y(const Coordinates& q, const Vector& Y) const;           // 30, (62)
    Vector rotor_momentum(const Coordinates& q, const Rotors& p_s) const;  // 30, (0; e p_s) per body
    Matrix DI_BH_dot(const Coordinates& q, const Vector& adot) const;      // 30 x 10, in (71)
    Vector P_a_dot(const Coordinates& q, const Vector& adot, const Vector& Qhat, const Rotors& p_s = {}) const;  // (71)
    Vector gravity(const Coordinates& q) const;  // Qhat of the weights, (55)

    const Body& body(int j) const { return bodies_[static_cast<std::size_t>(j - 1)]; }

private:
    CutJoints cut_joints(int body, const Coordinates& q) const;
    CutJoints cut_joints_dot(int body, const Coordinates& q, const Vector& qdot) const;
    const Strut& strut(int body) const { return struts_[static_cast<std::size_t>(body - 2)]; }
    const Arm& arm(int body) const { return arms_[static_cast<std::size_t>(body - 4)]; }

    std::array<Body, 5> bodies_;
    std::array<Strut, 2> struts_;
    std::array<Arm, 2> arms_;
    double gravity_ = 0;
    double alpha_ = 0;
};

// Where body j's joint coordinates stand in qdot of (18), and how many they are.
constexpr std::array<int, 5> column_of_body{0, 6, 10, 14, 15};
constexpr std::array<int, 5> columns_of_body{6, 4, 4, 1, 1};

// The paper's index of the coordinate in each row of qdot (18).
constexpr std::array<int, 16> coordinate_of_row{11, 12, 13, 14, 15, 16, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};

// The paper's indices of the independent coordinates a and of the dependent coordinates W.
constexpr std::array<int, 10> independent{11, 12, 13, 14, 15, 16, 4, 8, 9, 10};
constexpr std::array<int, 6> dependent{1, 2, 3, 5, 6, 7};

}  // namespace hamilcar::paper
