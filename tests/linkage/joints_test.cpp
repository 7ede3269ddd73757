// What makes a tree joint a joint, whatever its kind: the identity at design, columns that are the motion of its pose, and
// rates that are the rates of those columns. A new joint is one line at the end of this file.
#include <gtest/gtest.h>

#include <limits>

#include "hamilcar/linkage/tree_joints.hpp"
#include "linkage/motion.hpp"

namespace hamilcar {
namespace {

constexpr double untouched = -12345.0;
constexpr double exact = 1e-15;          // one or two roundings of numbers below one
constexpr double by_difference = 1e-10;  // fourth-order differences at a step of 1e-3, entries of order one
constexpr std::array times{0.0, 0.7, 1.9};
using Columns = Matrix<double, 6, 8>;

// A motion that visits coordinates to both sides of design, every coordinate with another rhythm.
template <std::size_t n>
std::array<double, n> coordinates_at(double t, std::array<double, n> design) {
    for (std::size_t i = 0; i < n; ++i) design[i] += 0.6 * std::sin((0.8 + 0.3 * i) * t + 0.4 + i);
    return design;
}
template <std::size_t n>
std::array<double, n> rates_at(double t) {
    std::array<double, n> rate;
    for (std::size_t i = 0; i < n; ++i) rate[i] = 0.6 * (0.8 + 0.3 * i) * std::cos((0.8 + 0.3 * i) * t + 0.4 + i);
    return rate;
}

template <class Joint>
using DesignOf = std::array<double, static_cast<std::size_t>(Joint::coordinates)>;

// What a joint hangs on: the chassis itself, or another joint in motion.
struct OnChassis {
    static constexpr int first = 0;
    ChassisFrame<double> parent(double) const { return {}; }
    Pose<double> pose(double) const { return {Mat3<double>::Identity(), Vec3<double>::Zero()}; }
    AtRest<double> motion(double) const { return {}; }
    Spatial<double> velocity(double) const { return Spatial<double>::Zero(); }
};

template <class Lead>
struct OnJoint {
    static constexpr int first = Lead::coordinates;
    Lead lead;
    DesignOf<Lead> design;
    Pose<double> pose(double t) const {
        Columns ignored;
        return lead.place(ChassisFrame<double>{}, coordinates_at(t + 0.5, design).data(), ignored, 0);
    }
    Pose<double> parent(double t) const { return pose(t); }
    Spatial<double> velocity(double t) const {
        return test::motion_of([&](double at) { return pose(at); }, t);
    }
    Spatial<double> motion(double t) const { return velocity(t); }
};

struct Placed {
    Pose<double> pose;
    Columns B = Columns::Constant(untouched);
};
template <class Carrier, class Joint>
Placed place(const Carrier& carrier, const Joint& joint, double t, const DesignOf<Joint>& q) {
    Placed out;
    out.pose = joint.place(carrier.parent(t), q.data(), out.B, Carrier::first);
    return out;
}

template <class Carrier, class Joint>
void check_design_pose(const Carrier& carrier, const Joint& joint, const DesignOf<Joint>& design) {
    for (const double t : times) {
        EXPECT_LE(test::difference(place(carrier, joint, t, design).pose, carrier.pose(t)), 2 * exact);
    }
}

// Coordinate by coordinate with the carrier held.
template <class Carrier, class Joint>
void check_columns(const Carrier& carrier, const Joint& joint, const DesignOf<Joint>& design) {
    for (const double t : times) {
        const auto q = coordinates_at(t, design);
        const auto at = place(carrier, joint, t, q);
        for (std::size_t i = 0; i < q.size(); ++i) {
            const auto moved = [&](double value) {
                auto varied = q;
                varied[i] = value;
                return place(carrier, joint, t, varied).pose;
            };
            const Spatial<double> expected = test::motion_of(moved, q[i]);
            EXPECT_LE((at.B.col(Carrier::first + i) - expected).norm(), by_difference) << "coordinate " << i;
            EXPECT_GE(expected.norm(), 0.9) << "a unit rate must be seen";
        }
        for (int i = 0; i < at.B.cols(); ++i) {
            const bool own = i >= Carrier::first && i < Carrier::first + Joint::coordinates;
            EXPECT_EQ((at.B.col(i).array() == untouched).all(), !own) << "column " << i;
        }
    }
}

// Everything in motion: the child's motion and the rates of the joint's columns.
template <class Carrier, class Joint>
void check_carry(const Carrier& carrier, const Joint& joint, const DesignOf<Joint>& design) {
    constexpr int n = Joint::coordinates;
    const auto placed_at = [&](double t) { return place(carrier, joint, t, coordinates_at(t, design)); };
    for (const double t : times) {
        const auto rate = rates_at<n>(t);
        Columns B_rate = Columns::Constant(untouched);
        const Spatial<double> child =
            joint.carry(carrier.motion(t), placed_at(t).B, rate.data(), Carrier::first, B_rate);
        const Spatial<double> expected = test::motion_of([&](double at) { return placed_at(at).pose; }, t);
        EXPECT_LE((child - expected).norm(), by_difference);
        const auto own_columns = [&](double at) {
            return Matrix<double, 6, n>(placed_at(at).B.template middleCols<n>(Carrier::first));
        };
        const Matrix<double, 6, n> columns_rate = test::derivative(own_columns, t);
        EXPECT_LE((B_rate.template middleCols<n>(Carrier::first) - columns_rate).norm(), 10 * by_difference);
        for (int i = 0; i < B_rate.cols(); ++i) {
            const bool own = i >= Carrier::first && i < Carrier::first + n;
            EXPECT_EQ((B_rate.col(i).array() == untouched).all(), !own) << "column " << i;
        }
    }
}

template <class Carrier, class Joint>
void check_on(const char* place_of_joint, const Carrier& carrier, const Joint& joint, const DesignOf<Joint>& design) {
    SCOPED_TRACE(std::string(Joint::name) + " " + place_of_joint);
    check_design_pose(carrier, joint, design);
    check_columns(carrier, joint, design);
    check_carry(carrier, joint, design);
}

const Vec3<double> slanted = Vec3<double>(0.3, -0.8, 0.5).normalized();

// All laws of a tree joint, alone and behind every other kind.
template <class Joint>
void check_joint(const Joint& joint, const DesignOf<Joint>& design) {
    const Vec3<double> somewhere(-0.4, 0.2, 0.7);
    check_on("on the chassis", OnChassis{}, joint, design);
    check_on("behind a revolute", OnJoint<Revolute<double>>{{somewhere, slanted}, {0}}, joint, design);
    check_on("behind a prismatic", OnJoint<Prismatic<double>>{{slanted, 0.3}, {0.3}}, joint, design);
    check_on("behind a spherical", OnJoint<BryantSpherical<double>>{{somewhere}, {0, 0, 0}}, joint, design);
}

TEST(TreeJoint, Revolute) {
    check_joint(Revolute<double>{{0.1, 0.5, -0.3}, slanted}, {0});
}
TEST(TreeJoint, Prismatic) {
    check_joint(Prismatic<double>{slanted, 0.53}, {0.53});
}
TEST(TreeJoint, BryantSpherical) {
    check_joint(BryantSpherical<double>{{-0.1, 0.5, 0.8}}, {0, 0, 0});
}

}  // namespace
}  // namespace hamilcar
